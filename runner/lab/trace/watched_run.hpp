// A shader that watches itself, drawn for one pixel or for a whole picture in place of a pass, and what it
// wrote down. A context must be current.
#pragma once

#include "base/result.hpp"
#include "glsl/instrument/watch.hpp"
#include "lab/trace/stand_in.hpp"
#include "render/renderer.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace tidemark::lab {

/// Column and row from the bottom; of a cubemap pass, on that face.
struct PixelPlace {
    int x = 0;
    int y = 0;
    int face = 0;

    bool operator==(const PixelPlace&) const = default;
};

/// Four floats as bits.
using PixelBits = std::array<uint32_t, 4>;
bool is_finite(const PixelBits& bits);
PixelBits bits_at(const image::Image& image, PixelPlace pixel);

struct WatchReading {
    PixelBits colour{};
    std::vector<uint32_t> words; ///< glsl::WatchLayout

    bool arrived() const { return words[glsl::WatchLayout::k_arrived] != 0; }
    glsl::NodeId hit() const { return words[glsl::WatchLayout::k_hit]; }
};

/// The text of a pass in the plan as it was linked, read to its tree. `as_written`: without the zeros that
/// variables begin with on ShaderToy's site, and here.
Result<std::unique_ptr<const glsl::ParsedText>> read_text(const render::Renderer& renderer, size_t pass,
                                                          bool as_written = false);

/// The same of a pass that was linked in that dialect.
Result<std::unique_ptr<const glsl::ParsedText>> read_text(const scene::Scene& scene, const scene::Pass& pass,
                                                          glsl::Dialect dialect, bool as_written);

/// The whole triangle is drawn and all but one pixel cut off, so that derivatives and everything else are as
/// in the picture. Fails (ErrorCode::load) with the driver's words when it refuses the text.
Result<WatchReading> read_pixel(const PassPreview& preview, const glsl::Watch& watch, PixelPlace pixel);

/// The first hit of each pixel (WatchRequest::map_width is the picture's).
Result<std::vector<glsl::NodeId>> read_map(const PassPreview& preview, const glsl::Watch& watch, int face);

} // namespace tidemark::lab
