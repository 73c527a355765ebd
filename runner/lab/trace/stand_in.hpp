// A text of ours drawn in the place of a pass, into a picture of its own. A context must be current.
#pragma once

#include "base/result.hpp"
#include "gl/render_target.hpp"
#include "image/image.hpp"
#include "render/renderer.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::lab {

/// One moment of a scene: everything before `pass` in the frame is drawn, and nothing after.
struct Moment {
    const render::Renderer& renderer;
    size_t pass;
    const render::FrameInputs& inputs;
};

/// The size of what the moment's pass draws.
Extent extent_of(const Moment& moment);

class StandIn {
public:
    /// Fails (ErrorCode::load) with the driver's words when it refuses the text, of which `what` says what it
    /// is: "the watched text". `extent` is that of its picture; none: the pass's own.
    static Result<StandIn> link(const Moment& moment, const std::string& text, std::string_view what,
                                std::optional<Extent> extent = {});

    /// A uniform of the text; one that the driver left out is nothing.
    void set(const std::string& uniform, double value);

    void draw(const Moment& moment, int face = 0) const;
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
