#include "render/pass_target.hpp"

#include "gl/capabilities.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::render {

Result<PassTarget> PassTarget::create(Extent extent, GLenum internal_format, const TargetPlan& plan) {
    const int limit = gl::query_capabilities().largest_target;
    if (std::max(extent.width, extent.height) > limit)
        return fail(ErrorCode::usage,
                    fmt::format("--size {}x{}: this driver draws at most {} pixels on a side", extent.width,
                                extent.height, limit));
    PassTarget target;
    target.plan_ = plan;
    for (int i = 0; i < (plan.two_textures ? 2 : 1); ++i) {
        auto surface =
            gl::make_render_target(gl::make_texture(extent, internal_format, plan.mipmaps ? 0 : 1));
        if (!surface)
            return fail(
                ErrorCode::usage,
                fmt::format("--size {}x{}: this driver has no memory for such a picture; give a smaller one",
                            extent.width, extent.height));
        target.surfaces_.push_back(*std::move(surface));
    }
    return target;
}

Result<PassTarget> PassTarget::create_cube(const TargetPlan& plan) {
    PassTarget target;
    target.plan_ = plan;
    for (int i = 0; i < (plan.two_textures ? 2 : 1); ++i) {
        auto surface =
            gl::make_render_target(gl::make_cube_texture(k_cube_side, GL_RGBA16F, plan.mipmaps ? 0 : 1));
        if (!surface)
            return fail(ErrorCode::load, "this driver has no memory for a cubemap pass");
        target.surfaces_.push_back(*std::move(surface));
    }
    return target;
}

void PassTarget::flip() {
    latest_ = next_index();
    ++edition_;
    gl::make_mipmaps(latest().texture);
}

void PassTarget::clear() {
    for (const gl::RenderTarget& surface : surfaces_)
        gl::clear(surface);
    ++edition_;
}

void PassTarget::continue_from(const PassTarget& other) {
    gl::copy_overlap(other.latest(), latest());
    gl::make_mipmaps(latest().texture);
    edition_ = other.edition_ + 1;
}

size_t PassTarget::bytes() const {
    size_t bytes = 0;
    for (const gl::RenderTarget& surface : surfaces_)
        bytes += gl::bytes_of(surface.texture);
    return bytes;
}

Result<PassTarget> PassTarget::resized(Extent extent) const {
    auto fresh = create(extent, internal_format(), plan_);
    if (fresh)
        fresh->continue_from(*this);
    return fresh;
}

} // namespace tidemark::render
