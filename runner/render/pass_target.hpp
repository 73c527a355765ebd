// The textures that keep a pass's output from frame to frame.
#pragma once

#include "base/result.hpp"
#include "gl/render_target.hpp"
#include "render/buffer_state.hpp"
#include "render/frame_plan.hpp"
#include "render/last_drawing.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace tidemark::render {

/// The side of a cubemap pass's faces, as on ShaderToy.
inline constexpr int k_cube_side = 1024;

/// Fails (ErrorCode::usage) if the driver of the current context cannot draw a picture of that size.
Result<void> check_size(Extent extent);

/// One texture, or two that alternate when a pass reads itself. They start as zeros.
class PassTarget {
public:
    PassTarget() = default;
    /// Fails when the driver cannot have targets of that size (ErrorCode::usage), or has no memory for them
    /// (ErrorCode::no_memory).
    static Result<PassTarget> create(Extent extent, GLenum internal_format, const TargetPlan& plan);
    static Result<PassTarget> create_cube(const TargetPlan& plan);

    /// Returns the last complete picture.
    const gl::RenderTarget& latest() const { return surfaces_[latest_]; }
    /// Returns the surface to draw into; `flip` makes it the latest.
    const gl::RenderTarget& next() const { return surfaces_[next_index()]; }
    /// Makes `next` the latest picture, for later passes of the frame, and computes its mipmaps. Frees the
    /// surface of `keep_apart`.
    void flip();

    /// Returns a surface for drawing the next picture while the current ones stay unchanged; nothing when the
    /// driver has no memory for it. `keeps`: some pixels are discarded, so it starts as a copy of `next`.
    std::optional<gl::RenderTarget> make_apart(bool keeps);
    /// Keeps the surface left by `take_over` for the next `make_apart`, so that frames drawn in parts need no
    /// further memory.
    void keep_apart(gl::RenderTarget spare) { spare_ = std::move(spare); }
    /// Exchanges `apart`, which has its mipmaps, with the surface of `next` and makes it the latest.
    void take_over(gl::RenderTarget& apart);
    /// Undoes `take_over`, in `apart` too.
    void take_back(gl::RenderTarget& apart);

    void clear();
    size_t bytes() const;
    GLenum internal_format() const { return latest().texture.internal_format; }
    /// Returns the generation of the picture in `latest`.
    Generation generation() const { return edition_; }
    /// Returns the textures that the next frame reads.
    std::vector<TextureFloats> carried() const;
    /// Returns whether `carried` comes from a target like this one.
    bool can_restore(const std::vector<TextureFloats>& carried) const;
    /// Restores the textures that `carried` returned.
    void restore(const std::vector<TextureFloats>& carried);
    /// Copies the overlap with the latest picture of `other`, which must have the same format.
    void continue_from(const PassTarget& other);
    /// Returns a target of another size with the overlap of the old picture in its bottom left corner.
    Result<PassTarget> resized(Extent extent) const;

private:
    size_t next_index() const { return surfaces_.size() - 1 - latest_; }

    std::vector<gl::RenderTarget> surfaces_;
    std::optional<gl::RenderTarget> spare_; ///< of the same kind; see `keep_apart`
    size_t latest_ = 0;
    Generation edition_ = 0;
    TargetPlan plan_;
};

} // namespace tidemark::render
