// A buffer that is drawn at half its width and height: ShaderToy gives every buffer the picture's size, so it
// is drawn into a quarter of that, and whoever reads it looks there.
#pragma once

#include "glsl/cut/cuts.hpp"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// A sampler of the buffer in question. It has no mipmaps and does not mirror.
struct BufferSampler {
    std::string_view name;
    bool repeats = false; ///< else it clamps
};

/// A pass of the scene, and by which samplers it reads that buffer.
struct BufferReader {
    const ParsedText& text;
    const TreeFacts& facts;
    std::vector<BufferSampler> samplers;
};

/// The buffer is `passes[buffer]`, and must not read itself. Nothing where it is read by other means than
/// look-ups, where it asks for its pixel by gl_FragCoord, and where a file that would be changed is another
/// pass's, too.
std::optional<Cut> half_size(std::span<const BufferReader> passes, size_t buffer, const WorkEstimate& work);

} // namespace tidemark::glsl
