#include "render/pass_preview.hpp"

#include "render/renderer.hpp"

namespace tidemark::render {

PassPreview::PassPreview(Renderer& renderer, size_t pass, const FrameInputs& inputs)
    : renderer_(&renderer), pass_(pass), inputs_(inputs) {
    renderer.draw_before(pass, inputs);
}

void PassPreview::Reset::operator()(Renderer* renderer) const {
    if (renderer->plan().feedback)
        renderer->reset();
}

const scene::Scene& PassPreview::scene() const {
    return renderer_->scene();
}

const scene::Pass& PassPreview::pass() const {
    return scene().passes[pass_];
}

const gl::Program& PassPreview::program() const {
    return renderer_->program(pass_);
}

const glsl::Dialect& PassPreview::dialect() const {
    return renderer_->dialect(pass_);
}

Extent PassPreview::extent() const {
    return pass().kind == scene::PassKind::cubemap ? Extent{k_cube_side, k_cube_side} : renderer_->extent();
}

void PassPreview::draw(const gl::Program& program, const gl::RenderTarget& into, int face) const {
    renderer_->draw_substitute(pass_, program, inputs_, into, face);
}

} // namespace tidemark::render
