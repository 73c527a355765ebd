// Draws an instrumented text in place of a pass, for one pixel or for the whole picture, and reads what it
// recorded. A context must be current.
#pragma once

#include "base/result.hpp"
#include "glsl/instrument/watch.hpp"
#include "lab/trace/stand_in.hpp"
#include "render/renderer.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace tidemark::lab {

/// A pixel: column and row from the bottom, and the face of a cubemap pass.
struct PixelPlace {
    int x = 0;
    int y = 0;
    int face = 0;

    bool operator==(const PixelPlace&) const = default;
};

/// The bits of a pixel's four floats.
using PixelBits = std::array<uint32_t, 4>;
bool is_finite(const PixelBits& bits);
PixelBits bits_at(const image::Image& image, PixelPlace pixel);

struct WatchReading {
    PixelBits colour{};
    std::vector<uint32_t> words; ///< glsl::WatchLayout

    bool arrived() const { return words[glsl::WatchLayout::k_arrived] != 0; }
    glsl::NodeId hit() const { return words[glsl::WatchLayout::k_hit]; }
};

/// Parses the text of a pass in the plan as it was linked. `as_written`: without the zeros that variables are
/// initialised with, here and on ShaderToy's site.
Result<std::unique_ptr<const glsl::ParsedText>> read_text(const render::Renderer& renderer, size_t pass,
                                                          bool as_written = false);

/// Does the same for a pass that was linked in that dialect.
Result<std::unique_ptr<const glsl::ParsedText>> read_text(const scene::Scene& scene, const scene::Pass& pass,
                                                          glsl::Dialect dialect, bool as_written);

/// Draws the whole triangle with all other pixels cut off, so that derivatives are as in the picture. Fails
/// (ErrorCode::load) with the driver's message if it refuses the text.
Result<WatchReading> read_pixel(const PassPreview& preview, const glsl::Watch& watch, PixelPlace pixel);

/// Returns the first hit of each pixel. WatchRequest::map_width must be the picture's width.
Result<std::vector<glsl::NodeId>> read_map(const PassPreview& preview, const glsl::Watch& watch, int face);

} // namespace tidemark::lab
