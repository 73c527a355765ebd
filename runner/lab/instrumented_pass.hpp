// Instrumented texts drawn in place of a pass: the buffer they write, drawing them, reading pixels, loops
// that the driver cuts.
//
// A buffer of 32-bit words that instrumented texts write (shader/watch.hpp,
// shader/domain_watch.hpp). A context must be current.
#pragma once

#include "base/error.hpp"
#include "media/image.hpp"
#include "render/frame_stepper.hpp"
#include "render/gl_textures.hpp"
#include "render/renderer.hpp"
#include "shader/variation.hpp"
#include "shader/watch.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

class ShaderWords {
public:
    /// Creates `count` zeros and binds them for the instrumented texts.
    explicit ShaderWords(size_t count);

    /// Returns what the draws so far have written.
    std::vector<uint32_t> read() const;

private:
    gl::BufferHandle buffer_;
    size_t count_;
};

// Draws one of Tidemark's texts in place of a pass, into a picture of its own. A context must be current.

using render::PassPreview;

class StandIn {
public:
    /// Links the text. Fails (ErrorCode::load) with the driver's message, which names the text by `what`,
    /// such as "the watched text". `extent` is the picture's size; none: that of the pass.
    static Result<StandIn> link(const PassPreview& preview, const std::string& text, std::string_view what,
                                std::optional<Extent> extent = {});

    /// Sets a uniform of the text; does nothing if the driver removed it.
    void set(const std::string& uniform, double value);

    /// Draws the text. It does not clear the picture first.
    void draw(const PassPreview& preview, int face = 0) const;
    /// Clears the picture and draws it with the pass's own program.
    void draw_own(const PassPreview& preview) const;
    /// Reads the picture back, RGBA floats.
    image::Image picture() const;
    const gl::RenderTarget& target() const { return target_; }

private:
    StandIn(gl::Program program, gl::RenderTarget target)
        : program_(std::move(program)), target_(std::move(target)) {}

    gl::Program program_;
    gl::RenderTarget target_;
};

/// Draws a pass with its own program and reads the picture back, RGBA floats.
Result<image::Image> draw_own(const PassPreview& preview, Extent extent);

/// Pictures of a varied text: unchanged, and in each mode.
struct VariedPictures {
    image::Image plain;
    std::vector<image::Image> others;
};
/// Fails if the driver refuses the text.
Result<VariedPictures> draw_varied(const PassPreview& preview, const glsl::Variation& varied,
                                   std::span<const glsl::VariationMode> modes);

// Draws an instrumented text in place of a pass, for one pixel or for the whole picture, and reads what it
// recorded. A context must be current.

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

// Finds loops that the driver cuts: llvmpipe ends all loops of a pixel after 65,535 iterations together,
// without a message. A context must be current.

/// Iterations that any known driver lets a pixel's loops have.
inline constexpr double k_safe_iterations = 65'535;

/// Returns whether the loops' heads allow a pixel of the plan's passes more iterations than that. True for a
/// text that cannot be analysed.
bool may_exceed_safe_iterations(const render::Renderer& renderer);
/// Does the same for a scene whose passes are compiled in the dialects of `like`.
bool may_exceed_safe_iterations(const scene::Scene& scene, const render::Renderer& like);

/// Returns after how many iterations the device ends the loops of a pixel; nullopt: not within twice
/// k_safe_iterations.
Result<std::optional<double>> loop_limit();

/// How a loop ended in any pixel of a picture.
struct LoopEnd {
    SourceLocation where{};
    std::string text{};       ///< of the whole loop, after macro expansion
    bool cut = false;         ///< the driver ended it
    bool counted_out = false; ///< its counter ended it, not what it computes
};

/// Draws the pass with instruments; with `sampled` only 24 blocks of 8x8 pixels, evenly spread.
Result<std::vector<LoopEnd>> loop_ends(const PassPreview& preview, bool sampled);

/// Returns where the driver cut a loop of the passes that the frame draws; empty if it cut none.
Result<std::vector<SourceLocation>> cut_loops(render::Renderer& renderer, const render::FrameInputs& inputs,
                                              bool sampled);

/// For example "the driver ends a pixel's loops after 65535 iterations together: the loop at a.glsl:5 is
/// cut".
std::string to_string(const std::vector<SourceLocation>& cut, double limit);

} // namespace tidemark::lab
