// Traces the values of a pass for one pixel, line by line: the pass as a function in SSA form, evaluated on
// the CPU in float, in double along the same path, and in stochastic arithmetic, which gives the digits of
// each value that rounding leaves correct. The device's colour of the same pixel is included.
#pragma once

#include "base/result.hpp"
#include "lab/pixel/traced_line.hpp"
#include "render/renderer.hpp"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace tidemark::lab {

using Colour = std::array<double, 4>;

struct PixelTrace {
    enum class End { complete, discarded, too_long } end = End::complete;
    Colour in_float{}, in_double{}, digits{}; ///< of the pass's output
    Colour on_device{};
    /// a texture was read at its base level, although the device chooses the mipmap level
    bool at_base_level = false;
    uint64_t operations = 0;
    std::vector<TracedLine> lines{}; ///< lines that ran, in the order of the compiled text
    std::optional<AuthorLine> asked{}; ///< the requested line
    std::vector<LineInCall> calls{}; ///< values of the requested line, in order of execution
};

struct PixelRequest {
    glm::ivec2 pixel{0}; ///< from the bottom left
    /// keeps the values of this line; without a file name, of mainImage's file
    std::optional<SourceLocation> line{};
    /// nullopt: keeps the first and last few iterations, and those with an event
    std::optional<TurnRange> turns{};
    uint64_t seed = 1; ///< of the stochastic arithmetic
};

/// Traces a pixel of the shown pass, in the frame that the renderer has drawn (in floats) from those inputs.
/// Fails if the text, or an operation that the pixel reaches, is not supported, and if the line has no code.
Result<PixelTrace> trace_pixel(const render::Renderer& renderer, const render::FrameInputs& inputs,
                               const PixelRequest& request);

/// Returns whether the colour in float equals the device's, up to rounding.
bool is_as_drawn(const PixelTrace& trace);

} // namespace tidemark::lab
