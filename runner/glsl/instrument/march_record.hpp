// A text that records, while its mainImage runs, what the first of its marching loops that a pixel enters
// did, and hands that out through a mainHit of ours (glsl/hit.hpp). Text in, text out; its picture is to be
// the plain text's, bit by bit.
#pragma once

#include "glsl/instrument/march_nodes.hpp"

#include <span>
#include <string_view>

namespace tidemark::glsl {

/// A knob, float, that says what our mainHit answers with.
inline constexpr std::string_view k_record_knob = "tidemark_record";
enum class RecordAnswer {
    hit,     ///< as glsl/hit.hpp has it: x -1 where the test did not hold at the end
    picture, ///< the colour of mainImage
    march,   ///< place on the ray, distances that were tested, the last of them, its threshold
    fall,    ///< the most that the distance falls by between two samples, a unit of the way; its place
};

/// `text` is Common and the pass as their authors wrote them. What is not certain is an error, never a
/// guess; so is a text that discards pixels.
Result<text::MappedText> record_marches(const ParsedText& text, const TreeFacts& facts,
                                        std::span<const MarchLines> marches);

} // namespace tidemark::glsl
