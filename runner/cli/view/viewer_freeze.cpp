// A picture that stays on show while the scene and its time go on.
#include "cli/console.hpp"
#include "cli/view/viewer.hpp"
#include "gl/blit.hpp"

#include <utility>

namespace tidemark::cli {

void Viewer::toggle_freeze() {
    if (!has_frame())
        return;
    stale_overlay_ = true;
    if (std::exchange(frozen_, std::nullopt))
        return;
    auto target = gl::copy_in_bytes(stage_->renderer().target());
    if (!target)
        return say("the driver has no memory for a picture that stays");
    frozen_.emplace(Frozen{*std::move(target), read_picture(), moment()});
}

const gl::RenderTarget* Viewer::target_on_show() const {
    if (frozen_)
        return &frozen_->target;
    return stage_ ? &stage_->renderer().target() : nullptr;
}

} // namespace tidemark::cli
