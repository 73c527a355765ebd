#include "lab/own_numbers.hpp"

#include "glsl/overrides.hpp"

namespace tidemark::lab {

std::vector<scene::Setting> own_numbers(const scene::Scene& scene) {
    const bool bare = scene.image().bare_file;
    std::vector<scene::Setting> numbers;
    for (const glsl::NamedText& definition : glsl::plain_numbers(scene))
        if (!bare || definition.file == scene.file.string())
            numbers.push_back({definition.name, definition.text});
    for (const scene::Knob& knob : scene.knobs)
        numbers.push_back({knob.name, scene::to_string(knob)});
    return numbers;
}

} // namespace tidemark::lab
