#include "lab/fields/knob_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::lab {

scene::KnobValue KnobReader::value(std::string_view name) {
    const auto knob = std::ranges::find(knobs_, name, &scene::Knob::name);
    if (knob != knobs_.end())
        return knob->value;
    if (!error_)
        error_ = Error{ErrorCode::load,
                       fmt::format("the scene has no knob '{}', which its reference needs: declare it with "
                                   "#iUniform as the scene in shaders/ does",
                                   name),
                       {}};
    return {};
}

glm::dvec2 KnobReader::pair(std::string_view name) {
    const scene::KnobValue v = value(name);
    return {float(v[0]), float(v[1])};
}

glm::dvec3 KnobReader::triple(std::string_view name) {
    const scene::KnobValue v = value(name);
    return {float(v[0]), float(v[1]), float(v[2])};
}

glm::dvec4 KnobReader::quadruple(std::string_view name) {
    const scene::KnobValue v = value(name);
    return {float(v[0]), float(v[1]), float(v[2]), float(v[3])};
}

} // namespace tidemark::lab
