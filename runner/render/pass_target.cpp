#include "render/pass_target.hpp"

#include "base/try.hpp"
#include "gl/capabilities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

namespace tidemark::render {

Result<void> check_size(Extent extent) {
    const int limit = gl::query_capabilities().largest_target;
    if (std::max(extent.width, extent.height) <= limit)
        return {};
    return fail(ErrorCode::usage, fmt::format("--size {}x{}: this driver draws at most {} pixels on a side",
                                              extent.width, extent.height, limit));
}

Result<PassTarget> PassTarget::create(Extent extent, GLenum internal_format, const TargetPlan& plan) {
    TRY(check_size(extent));
    PassTarget target;
    target.plan_ = plan;
    for (int i = 0; i < (plan.two_textures ? 2 : 1); ++i) {
        auto surface =
            gl::make_render_target(gl::make_texture(extent, internal_format, plan.mipmaps ? 0 : 1));
        if (!surface)
            return fail(
                ErrorCode::no_memory,
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
            return fail(ErrorCode::no_memory, "this driver has no memory for a cubemap pass");
        target.surfaces_.push_back(*std::move(surface));
    }
    return target;
}

void PassTarget::flip() {
    spare_.reset();
    latest_ = next_index();
    ++edition_;
    gl::make_mipmaps(latest().texture);
}

std::optional<gl::RenderTarget> PassTarget::make_apart(bool keeps) {
    const gl::Texture& like = next().texture;
    const bool cube = like.target == GL_TEXTURE_CUBE_MAP;
    auto apart = std::exchange(spare_, std::nullopt);
    if (!apart)
        apart = gl::make_render_target(
            cube ? gl::make_cube_texture(like.extent.width, like.internal_format, like.levels)
                 : gl::make_texture(like.extent, like.internal_format, like.levels));
    if (apart && keeps)
        gl::copy_overlap(next(), *apart);
    return apart;
}

void PassTarget::take_over(gl::RenderTarget& apart) {
    std::swap(surfaces_[next_index()], apart);
    latest_ = next_index();
    ++edition_;
}

void PassTarget::take_back(gl::RenderTarget& apart) {
    latest_ = next_index();
    std::swap(surfaces_[next_index()], apart);
    --edition_;
}

void PassTarget::clear() {
    for (const gl::RenderTarget& surface : surfaces_)
        gl::clear(surface);
    ++edition_;
}

std::vector<TextureFloats> PassTarget::carried() const {
    std::vector<TextureFloats> textures;
    for (int i = 0; i < plan_.carried; ++i)
        textures.push_back(gl::read_level((i == 0 ? latest() : next()).texture, 0));
    return textures;
}

bool PassTarget::can_restore(const std::vector<TextureFloats>& carried) const {
    const gl::Texture& texture = latest().texture;
    const size_t floats = texture.extent.pixels() * size_t(texture.depth) * 4;
    return carried.size() == size_t(plan_.carried) &&
           std::ranges::all_of(carried, [&](const TextureFloats& t) { return t.size() == floats; });
}

void PassTarget::restore(const std::vector<TextureFloats>& carried) {
    for (size_t i = 0; i < carried.size(); ++i) {
        const gl::Texture& texture = (i == 0 ? latest() : next()).texture;
        const auto bytes = std::as_bytes(std::span(carried[i]));
        const size_t layer = bytes.size() / size_t(texture.depth);
        for (int face = 0; face < texture.depth; ++face)
            gl::upload(texture, face, GL_RGBA, GL_FLOAT, bytes.subspan(size_t(face) * layer, layer));
        gl::make_mipmaps(texture);
    }
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
    return bytes + (spare_ ? gl::bytes_of(spare_->texture) : 0);
}

Result<PassTarget> PassTarget::resized(Extent extent) const {
    auto fresh = create(extent, internal_format(), plan_);
    if (fresh)
        fresh->continue_from(*this);
    return fresh;
}

} // namespace tidemark::render
