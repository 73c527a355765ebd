// Draws one of Tidemark's texts in place of a pass, into a picture of its own. A context must be current.
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

} // namespace tidemark::lab
