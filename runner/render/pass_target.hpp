// Where the output of a pass is kept from frame to frame.
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

/// One texture, or two that take turns when a pass reads itself. Both start as zeros.
/// Fails (ErrorCode::usage) where the driver of the current context draws no picture of that size.
Result<void> check_size(Extent extent);

class PassTarget {
public:
    PassTarget() = default;
    /// Fails when the driver cannot have targets of that size (ErrorCode::usage), or has no memory for them
    /// (ErrorCode::no_memory).
    static Result<PassTarget> create(Extent extent, GLenum internal_format, const TargetPlan& plan);
    static Result<PassTarget> create_cube(const TargetPlan& plan);

    /// What was drawn last, whole.
    const gl::RenderTarget& latest() const { return surfaces_[latest_]; }
    /// What is to be drawn into; becomes the latest by `flip`.
    const gl::RenderTarget& next() const { return surfaces_[next_index()]; }
    /// At once after drawing, so that passes later in the frame see it. Makes the mipmaps. What was kept to
    /// draw apart goes: pictures are drawn whole.
    void flip();

    /// A surface to draw all of the next picture into while all of its own stay as they are; where pixels are
    /// discarded (`keeps`) it begins as `next` is. Nothing where the driver has no memory for it.
    std::optional<gl::RenderTarget> make_apart(bool keeps);
    /// What `take_over` left is not wanted back: the next picture apart is drawn into it, so that a frame of
    /// many that are drawn in parts asks for no memory.
    void keep_apart(gl::RenderTarget spare) { spare_ = std::move(spare); }
    /// `apart`, with its mipmaps, becomes the latest and takes the place of `next`, whose surface it gets.
    void take_over(gl::RenderTarget& apart);
    /// All is again as it was before `take_over`, `apart` too.
    void take_back(gl::RenderTarget& apart);

    void clear();
    size_t bytes() const;
    GLenum internal_format() const { return latest().texture.internal_format; }
    /// Of the picture in `latest`.
    Generation generation() const { return edition_; }
    /// Those of its textures that the next frame sees.
    std::vector<TextureFloats> carried() const;
    /// Whether that is of a target like this one.
    bool can_restore(const std::vector<TextureFloats>& carried) const;
    /// What `carried` gave is there again.
    void restore(const std::vector<TextureFloats>& carried);
    /// Shows what `other` shows, as far as it reaches; of the same format.
    void continue_from(const PassTarget& other);
    /// A target of another size with the overlap of the old picture in its bottom left corner.
    Result<PassTarget> resized(Extent extent) const;

private:
    size_t next_index() const { return surfaces_.size() - 1 - latest_; }

    std::vector<gl::RenderTarget> surfaces_;
    std::optional<gl::RenderTarget> spare_; ///< like them
    size_t latest_ = 0;
    Generation edition_ = 0;
    TargetPlan plan_;
};

} // namespace tidemark::render
