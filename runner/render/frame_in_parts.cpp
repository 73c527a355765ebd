#include "render/frame_in_parts.hpp"

#include "base/supervision.hpp"
#include "render/renderer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tidemark::render {

FrameInParts::FrameInParts(Renderer& renderer, FrameInputs inputs, PartSize& size, Clock clock)
    : renderer_(&renderer), inputs_(std::move(inputs)), size_(&size), clock_(std::move(clock)) {
    begin();
}

void FrameInParts::begin() {
    renderer_->textures_.update(inputs_);
    changes_ = renderer_->changes_;
    std::vector<PassArea> areas;
    for (const PlannedPass& planned : renderer_->plan().passes)
        if (!renderer_->is_tiled(planned.pass))
            areas.push_back({planned.pass, renderer_->target_of(planned.pass).extent(),
                             renderer_->faces_of(planned.pass)});
    cursor_ = PartCursor(std::move(areas));
    whole_.clear();
    drawing_.reset();
    under_way_.reset();
    seconds_.clear();
}

Result<bool> FrameInParts::draw_for(double seconds) {
    const Doing drawing(fmt::format("drawing a frame of '{}'", renderer_->scene().file.string()));
    if (renderer_->changes_ != changes_)
        begin();
    const double until = clock_() + seconds;
    for (Apart& apart : whole_) // later passes read them
        exchange(apart, &PassTarget::take_over);
    auto complete = draw_until(until);
    if (complete && *complete) {
        keep_whole();
        return true;
    }
    for (Apart& apart : whole_)
        exchange(apart, &PassTarget::take_back);
    return complete;
}

Result<bool> FrameInParts::draw_until(double until) {
    do {
        if (under_way_) {
            if (!under_way_->end.wait(std::max(0.0, until - clock_())))
                return false;
            finish_part();
        }
        const auto ahead = cursor_.ahead();
        if (!ahead)
            return true;
        if (!drawing_)
            TRY(begin_pass(ahead->pass));
        if (drawing_)
            draw_part(*ahead);
    } while (clock_() < until);
    return false;
}

Result<void> FrameInParts::begin_pass(size_t pass) {
    auto reads = renderer_->changed_inputs(pass, inputs_);
    if (!reads) {
        cursor_.leave_out();
        return {};
    }
    auto surface = renderer_->passes_[pass].target.make_apart(renderer_->compiled_[pass].linked.discards);
    if (!surface)
        return fail(ErrorCode::load, fmt::format("this driver has no memory to draw {} in parts: frames are "
                                                 "drawn whole, and the window may freeze meanwhile",
                                                 renderer_->scene().passes[pass].name));
    drawing_.emplace(Apart{pass, *std::move(surface), *std::move(reads)});
    seconds_.push_back({pass, 0});
    return {};
}

void FrameInParts::draw_part(const Part& ahead) {
    const Part part = *cursor_.take(size_->pixels(ahead));
    const double begun = clock_();
    const gl::Scissor only(part.area);
    renderer_->prepare(part.pass, drawing_->reads.uniforms);
    renderer_->draw_face(part.pass, part.face, drawing_->surface);
    under_way_.emplace(UnderWay{part, begun});
}

void FrameInParts::finish_part() {
    const double took = clock_() - under_way_->begun;
    size_->drew(under_way_->part, drawing_->surface.extent(), took * 1000);
    seconds_.back().seconds += took;
    under_way_.reset();
    if (cursor_.begins_pass()) // the cursor has left the pass
        finish_pass();
}

void FrameInParts::finish_pass() {
    gl::make_mipmaps(drawing_->surface.texture);
    exchange(*drawing_, &PassTarget::take_over);
    Renderer::DrawnPass& pass = renderer_->passes_[drawing_->pass];
    pass.drawn.drew(std::move(drawing_->reads), pass.target.generation());
    whole_.push_back(*std::exchange(drawing_, std::nullopt));
}

/// Exchanges the picture of the pass, and the inputs it was drawn from, with those drawn apart.
void FrameInParts::exchange(Apart& apart, void (PassTarget::*surfaces)(gl::RenderTarget&)) {
    Renderer::DrawnPass& pass = renderer_->passes_[apart.pass];
    (pass.target.*surfaces)(apart.surface);
    std::swap(pass.drawn, apart.drawn);
}

void FrameInParts::keep_whole() {
    renderer_->passes_drawn_ += whole_.size();
    renderer_->draws_in_frame_ = 0;
    for (Apart& apart : whole_) {
        renderer_->draws_in_frame_ += size_t(renderer_->faces_of(apart.pass));
        renderer_->passes_[apart.pass].target.keep_apart(std::move(apart.surface));
    }
    changes_ = ++renderer_->changes_;
    whole_.clear();
}

} // namespace tidemark::render
