// Specialising: no line moves, and what could be followed still can be.
#include "fuzz.hpp"
#include "shader/parsed_text.hpp"
#include "shader/specialise.hpp"

#include <algorithm>

using namespace tidemark;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::vector<scene::Knob> knobs = {
        {.name = "foam", .type = scene::KnobType::float1, .initial = {}, .value = {0.5}},
        {.name = "count", .type = scene::KnobType::int1, .initial = {}, .value = {3}},
        {.name = "wind", .type = scene::KnobType::vec2, .initial = {}, .value = {1, -2}}};
    text::MappedText source;
    source.append_generated("uniform float foam, iTime; uniform int count; uniform vec2 wind;\n");
    source.append(text_of(data, size), "a.glsl", 1);
    const bool followed = glsl::ParsedText::read(source, {}, false).has_value();
    for (const auto how :
         {glsl::Specialise::unreachable, glsl::Specialise::invariant_uniforms, glsl::Specialise::constants}) {
        const glsl::Specialised result = glsl::specialise(source, knobs, how);
        REQUIRE(result.left_out.anything() ? followed : result.source.text() == source.text());
        REQUIRE(std::count(source.text().begin(), source.text().end(), '\n') ==
                std::count(result.source.text().begin(), result.source.text().end(), '\n'));
        REQUIRE(!followed || glsl::ParsedText::read(result.source, {}, false));
    }
    return 0;
}
