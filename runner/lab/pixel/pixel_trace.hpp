// What a pass computes for one pixel, line by line: the pass as a function in SSA form, evaluated on the CPU
// in float, in double on the same way through the text, and in stochastic arithmetic, which tells how many
// digits rounding leaves of each value. The device has drawn the same pixel: its colour stands beside.
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
    Colour in_float{}, in_double{}, digits{}; ///< of what the pass writes
    Colour on_device{};
    bool at_base_level = false; ///< a texture was read there whose mipmap the device chooses
    uint64_t operations = 0;
    std::vector<TracedLine> lines{};   ///< those that ran, in the order of the text that was compiled
    std::optional<AuthorLine> asked{}; ///< the line that was asked for
    std::vector<LineInCall> calls{};   ///< its values, in order of execution
};

struct PixelRequest {
    glm::ivec2 pixel{0};                  ///< from the bottom left
    std::optional<SourceLocation> line{}; ///< whose values are kept; without a file: in that of mainImage
    std::optional<TurnRange> turns{};     ///< none: the first and the last few, and where something happens
    uint64_t seed = 1;                    ///< of stochastic arithmetic
};

/// Of the shown pass, in the frame that the renderer has drawn (in floats) from those inputs. Fails where its
/// text cannot be followed, where the pixel comes to what is not, and where the line has no code.
Result<PixelTrace> trace_pixel(const render::Renderer& renderer, const render::FrameInputs& inputs,
                               const PixelRequest& request);

/// Whether the colour in float is the device's, but for what rounding explains.
bool is_as_drawn(const PixelTrace& trace);

} // namespace tidemark::lab
