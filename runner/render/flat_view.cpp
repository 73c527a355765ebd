#include "render/flat_view.hpp"

#include <algorithm>
#include <utility>

namespace tidemark::render {
namespace {

/// Neighbours in the cross share an edge of the cube, seen from its centre.
constexpr const char* k_cube_text = R"(#version 450 core
layout(binding = 0) uniform samplerCube picture;
uniform float side;
out vec4 colour;
void main() {
    ivec2 cell = ivec2(gl_FragCoord.xy / side);
    vec2 p = (gl_FragCoord.xy - vec2(cell) * side) / side * 2.0 - 1.0;
    vec3 direction;
    if (cell.y == 1)
        direction = cell.x == 0 ? vec3(-1.0, p.y, p.x) : cell.x == 1 ? vec3(p, 1.0)
                  : cell.x == 2 ? vec3(1.0, p.y, -p.x) : vec3(-p.x, p.y, -1.0);
    else if (cell.x == 1)
        direction = cell.y == 2 ? vec3(p.x, 1.0, -p.y) : vec3(p.x, -1.0, p.y);
    else
        discard;
    colour = textureLod(picture, direction, 0.0);
}
)";

constexpr const char* k_volume_text = R"(#version 450 core
layout(binding = 0) uniform sampler3D picture;
uniform int slice;
out vec4 colour;
void main() {
    colour = texelFetch(picture, ivec3(ivec2(gl_FragCoord.xy), slice), 0);
}
)";

} // namespace

Result<FlatView> FlatView::create(const gl::Texture& picture) {
    const char* const text = picture.target == GL_TEXTURE_3D ? k_volume_text : k_cube_text;
    return FilterProgram::create("the flat view", text).map([](FilterProgram program) {
        return FlatView(std::move(program));
    });
}

const gl::Texture* FlatView::draw(const gl::Texture& picture, int slice, int most_of_a_side) {
    const bool volume = picture.target == GL_TEXTURE_3D;
    const int side = std::min(picture.extent.width, most_of_a_side);
    const Extent extent = volume ? picture.extent : Extent{4 * side, 3 * side};
    if (!target_ || target_->extent() != extent)
        target_ = gl::make_render_target(gl::make_texture(extent, volume ? GL_RGBA32F : GL_RGBA16F, 1));
    if (!target_)
        return nullptr;
    program_.set("side", {double(side)});
    program_.set("slice", {double(std::clamp(slice, 0, picture.depth - 1))});
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target_->framebuffer.id());
    program_.draw(picture, extent);
    return &target_->texture;
}

} // namespace tidemark::render
