#include "fields/knob_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::fields {

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

double KnobReader::not_negative(std::string_view name) {
    const double found = number(name);
    if (!(found >= 0) && !error_)
        error_ = Error{ErrorCode::load,
                       fmt::format("the reference knows no '{}' below 0, and it is {}: its bounds would not "
                                   "hold",
                                   name, found),
                       {}};
    return found;
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

} // namespace tidemark::fields
