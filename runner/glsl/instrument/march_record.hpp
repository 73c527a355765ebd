// Instruments a text so that it records, while mainImage runs, the first marching loop that a pixel enters,
// and returns the record through a generated mainHit (glsl/hit.hpp). Text in, text out; the picture stays the
// original's, bit by bit.
#pragma once

#include "glsl/instrument/march_nodes.hpp"

#include <span>
#include <string_view>

namespace tidemark::glsl {

/// Name of the float knob that selects the answer of the generated mainHit.
inline constexpr std::string_view k_record_knob = "tidemark_record";
enum class RecordAnswer {
    hit,     ///< as in glsl/hit.hpp: x is -1 if the test did not hold at the end
    picture, ///< the colour of mainImage
    march,   ///< place on the ray, number of tested distances, the last distance, its threshold
    fall,    ///< steepest fall of the distance between two samples, per unit of the way, and its place
};

/// Instruments `text`, which is Common and the pass as their authors wrote them. Returns an error if
/// something is not certain or if the text discards pixels.
Result<text::MappedText> record_marches(const ParsedText& text, const TreeFacts& facts,
                                        std::span<const MarchLines> marches);

} // namespace tidemark::glsl
