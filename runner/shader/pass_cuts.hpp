// Proposes drawing a buffer at half its width and height. ShaderToy gives every buffer the picture's size, so
// the buffer is drawn into one quarter of that, and passes that read it look there.
#pragma once

#include "shader/cuts.hpp"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// A sampler of the buffer. It has no mipmaps and does not mirror.
struct BufferSampler {
    std::string_view name;
    bool repeats = false; ///< otherwise it clamps
};

/// A pass of the scene, and the samplers with which it reads the buffer.
struct BufferReader {
    const ParsedText& text;
    const TreeFacts& facts;
    std::vector<BufferSampler> samplers;
};

/// Returns the cut for `passes[buffer]`, which must not read itself. Returns nothing if the buffer is read by
/// other means than look-ups, if it uses gl_FragCoord, or if the cut would change a file that another pass
/// shares.
std::optional<Cut> half_size(std::span<const BufferReader> passes, size_t buffer, const WorkEstimate& work);

// Moves expressions that have one value for the whole frame out of loops and calls into global variables that
// mainImage computes first. A text can do no better: ShaderToy has no place that runs once per frame.

/// Returns one cut with all such expressions of mainImage's file, or nothing if there are none. The language
/// guarantees the same values; a driver may round differently.
std::optional<Cut> once_a_pixel(const ParsedText& text, const TreeFacts& facts, const WorkEstimate& work);

} // namespace tidemark::glsl
