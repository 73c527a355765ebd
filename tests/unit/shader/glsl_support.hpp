// Helpers of the tests of GLSL text: scenes that exist in memory only.
#pragma once

#include "shader/parsed_text.hpp"
#include "shader/shader_source.hpp"
#include "support/scene_of.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace tidemark::glsl {

/// Returns the text that the driver gets.
inline ShaderSource source_of(std::string_view text) {
    const scene::Scene scene = scene_of(text);
    return assemble(scene, scene.image());
}

/// As if it stood in that file.
inline std::unique_ptr<const ParsedText> parsed(const std::string& text, const char* file = "a.glsl") {
    text::MappedText source;
    source.append(text, file, 1);
    return *ParsedText::read(std::move(source), {});
}

/// How often `piece` stands in `text`.
inline int count(std::string_view text, std::string_view piece) {
    int found = 0;
    for (size_t at = text.find(piece); at != text.npos; at = text.find(piece, at + piece.size()))
        ++found;
    return found;
}

/// The number of the line on which `piece` first stands, counted from 1.
inline int line_of(const ShaderSource& source, std::string_view piece) {
    const size_t at = source.text().find(piece);
    return at == std::string::npos ? 0 : 1 + count(std::string_view(source.text()).substr(0, at), "\n");
}

} // namespace tidemark::glsl
