#include "cli/view/stepping_there.hpp"

#include "cli/view/wall_clock.hpp"

#include <algorithm>
#include <utility>

namespace tidemark::cli {

using render::FrameInParts;
using Way = render::FramePace::Way;

SteppingThere::SteppingThere(render::Renderer& renderer, render::FramePace& pace, render::PartSize& size,
                             render::FrameStates states, int frame, double seconds)
    : renderer_(renderer), pace_(pace), size_(size), stepper_(renderer, std::move(states)),
      seconds_(seconds), where_{0, frame} {
    stepper_.draw_by([this](const render::FrameInputs& inputs) { return draw(inputs); });
}

bool SteppingThere::advance(double seconds) {
    until_ = now_seconds() + seconds;
    bool first = true;
    const auto may_draw = [&](int frame, int) {
        if (!std::exchange(first, false) && now_seconds() >= until_)
            return false;
        where_.frame = frame;
        return true;
    };
    return stepper_.draw(where_.last, may_draw).complete;
}

bool SteppingThere::draw(const render::FrameInputs& inputs) {
    const Extent extent = renderer_.extent();
    if (!frame_ && pace_.way(extent) == Way::whole) {
        draw_whole(inputs);
        return true;
    }
    if (!frame_)
        frame_.emplace(renderer_, inputs, size_, now_seconds);
    const auto whole = frame_->draw_for(std::max(0.0, until_ - now_seconds()));
    if (whole && !*whole)
        return false;
    double took = 0;
    for (const FrameInParts::PassSeconds& pass : frame_->seconds())
        took += pass.seconds;
    frame_.reset();
    if (whole)
        pace_.took(extent, Way::in_parts, took);
    else // not enough memory for parts
        draw_whole(inputs);
    return true;
}

void SteppingThere::draw_whole(const render::FrameInputs& inputs) {
    const double begun = now_seconds();
    renderer_.draw(inputs);
    glFinish(); // else some drivers queue much more work than there is time for
    pace_.took(renderer_.extent(), Way::whole, now_seconds() - begun);
}

std::optional<FrameInParts::UnderWay> SteppingThere::give_up() {
    return frame_ ? FrameInParts::give_up(std::move(*frame_)) : std::nullopt;
}

} // namespace tidemark::cli
