#include "render/frame_stepper.hpp"

#include <algorithm>

namespace tidemark::render {

PassPreview::PassPreview(Renderer& renderer, size_t pass, const FrameInputs& inputs)
    : renderer_(&renderer, Reset{true}), pass_(pass), inputs_(inputs) {
    renderer.draw_before(pass, inputs);
}

PassPreview::PassPreview(Again, Renderer& renderer, const FrameInputs& inputs)
    : renderer_(&renderer, Reset{false}), pass_(renderer.shown_index()), inputs_(inputs) {}

PassPreview PassPreview::again(Renderer& renderer, const FrameInputs& inputs) {
    return {Again(), renderer, inputs};
}

void PassPreview::Reset::operator()(Renderer* renderer) const {
    if (needed && renderer->plan().feedback)
        renderer->reset();
}

Extent PassPreview::extent() const {
    return pass().kind == scene::PassKind::cubemap ? Extent{k_cube_side, k_cube_side} : renderer_->extent();
}

void PassPreview::draw(const gl::Program& program, const gl::RenderTarget& into, int face) const {
    renderer_->draw_substitute(pass_, program, inputs_, into, face);
}

FrameSteps FrameStepper::draw(int frame, const MayDraw& may_draw) {
    return step(frame + 1, frame, may_draw);
}

FrameSteps FrameStepper::lead_to(int frame, const MayDraw& may_draw) {
    return step(frame, frame, may_draw);
}

PassPreview FrameStepper::preview(int frame, size_t pass, const MayDraw& may_draw) {
    lead_to(frame, may_draw);
    next_.reset();
    return {renderer_, pass, inputs_of(states_(frame))};
}

/// Draws the frames before `end`; `last` is the frame that the caller needs.
FrameSteps FrameStepper::step(int end, int last, const MayDraw& may_draw) {
    if (!renderer_.plan().feedback) {
        next_ = last;
    } else if (!next_ || *next_ > last) {
        renderer_.reset();
        next_ = std::min(first_, last);
    }
    FrameSteps steps;
    const size_t before = renderer_.passes_drawn();
    for (; *next_ < end; ++*next_) {
        steps.complete = !may_draw || may_draw(*next_, last);
        if (!steps.complete)
            break;
        renderer_.draw(inputs_of(states_(*next_)));
        ++steps.frames;
    }
    steps.passes = renderer_.passes_drawn() - before;
    return steps;
}

} // namespace tidemark::render
