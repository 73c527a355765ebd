// Directives of a text: read or refused with a place, and blanked out without moving a line.
#include "fuzz.hpp"
#include "scene/directives.hpp"

#include <algorithm>
#include <cmath>
#include <string>

using namespace tidemark;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    text::MappedText text;
    text.append(text_of(data, size), "a.glsl", 1);
    const std::string before = text.text();
    const auto directives = scene::take_directives(text);
    if (!directives) {
        REQUIRE(text.text() == before);
        REQUIRE(directives.error().diagnostics.size() >= 1);
        for (const Diagnostic& diagnostic : directives.error().diagnostics)
            REQUIRE(diagnostic.where.file == "a.glsl" && diagnostic.where.line >= 1);
        return 0;
    }
    REQUIRE(std::count(before.begin(), before.end(), '\n') ==
            std::count(text.text().begin(), text.text().end(), '\n'));
    for (const scene::Knob& knob : directives->knobs) {
        const scene::KnobTypeInfo& type = scene::info(knob.type);
        REQUIRE(!knob.name.empty());
        for (size_t i = 0; i < knob.value.size(); ++i) {
            REQUIRE(std::isfinite(knob.value[i]));
            REQUIRE(i < size_t(type.components) || knob.value[i] == 0);
            REQUIRE(!type.whole || double(int(knob.value[i])) == knob.value[i]);
            REQUIRE(!knob.range || knob.range->low[i] <= knob.range->high[i]);
        }
    }
    for (const scene::Channel& channel : directives->channels)
        if (const auto* picture = std::get_if<scene::Picture>(&channel.input))
            REQUIRE(!picture->file.empty());
    return 0;
}
