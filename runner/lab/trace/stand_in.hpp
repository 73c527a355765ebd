// A text of ours drawn in the place of a pass, into a picture of its own. A context must be current.
#pragma once

#include "base/result.hpp"
#include "gl/render_target.hpp"
#include "image/image.hpp"
#include "render/pass_preview.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::lab {

using render::PassPreview;

class StandIn {
public:
    /// Fails (ErrorCode::load) with the driver's words when it refuses the text, of which `what` says what it
    /// is: "the watched text". `extent` is that of its picture; none: the pass's own.
    static Result<StandIn> link(const PassPreview& preview, const std::string& text, std::string_view what,
                                std::optional<Extent> extent = {});

    /// A uniform of the text; one that the driver left out is nothing.
    void set(const std::string& uniform, double value);

    void draw(const PassPreview& preview, int face = 0) const;
    /// The same by the pass's own program.
    void draw_own(const PassPreview& preview) const;
    /// The floats that it holds.
    image::Image picture() const;
    const gl::RenderTarget& target() const { return target_; }

private:
    StandIn(gl::Program program, gl::RenderTarget target)
        : program_(std::move(program)), target_(std::move(target)) {}

    gl::Program program_;
    gl::RenderTarget target_;
};

} // namespace tidemark::lab
