#include "render/buffer_views.hpp"

#include "render/gl_context.hpp"
#include "shader/shader_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

namespace tidemark::render {
namespace {

/// In front of each text: its version.
constexpr std::string_view k_desktop_line = "#version 450 core\n";
constexpr std::string_view k_es_lines = R"(#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler3D;
precision highp samplerCube;
)";

/// Neighbours in the cross share an edge of the cube, seen from its centre.
constexpr const char* k_cube_text = R"(uniform samplerCube picture;
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

constexpr const char* k_volume_text = R"(uniform sampler3D picture;
uniform int slice;
out vec4 colour;
void main() {
    colour = texelFetch(picture, ivec3(ivec2(gl_FragCoord.xy), slice), 0);
}
)";

/// Tests the bits, because optimisers may assume that floats are finite.
constexpr const char* k_text = R"(uniform sampler2D picture;
uniform vec2 extent; // of the window
out vec4 colour;
void main() {
    ivec2 size = textureSize(picture, 0);
    vec4 value = texelFetch(picture, min(ivec2(gl_FragCoord.xy / extent * vec2(size)), size - 1), 0);
    uvec4 magnitude = floatBitsToUint(value) & 0x7fffffffu;
    if (any(greaterThan(magnitude, uvec4(0x7f800000u))))
        colour = vec4(1.0, 0.0, 1.0, 1.0);
    else if (any(equal(magnitude, uvec4(0x7f800000u))))
        colour = vec4(0.0, 1.0, 0.0, 1.0);
    else if (any(lessThan(value, vec4(0.0))))
        colour = vec4(0.0, 0.0, 1.0, 1.0);
    else
        discard;
}
)";

/// `seen` returns the displayed value of a pixel. The second channel is -1 to show one channel, both are -1
/// to show colours.
constexpr const char* k_seen_text = R"(uniform sampler2D picture;
uniform ivec2 channels;
vec3 seen(ivec2 place) {
    vec4 value = texelFetch(picture, place, 0);
    if (channels.x < 0)
        return value.rgb;
    return vec3(channels.y < 0 ? value[channels.x] : value[channels.x] - value[channels.y]);
}
bvec3 finite(vec3 value) {
    return lessThan(floatBitsToUint(value) & 0x7fffffffu, uvec3(0x7f800000u));
}
)";

/// Differences go from blue over light grey to red (K. Moreland: Diverging color maps for scientific
/// visualization, 2009), interpolated linearly.
constexpr const char* k_look_text = R"(
uniform float scale;
out vec4 colour;
const vec3 k_below = vec3(59.0, 76.0, 192.0) / 255.0, k_zero = vec3(221.0) / 255.0;
const vec3 k_above = vec3(180.0, 4.0, 38.0) / 255.0;
void main() {
    vec3 value = seen(ivec2(gl_FragCoord.xy));
    uvec3 magnitude = floatBitsToUint(value) & 0x7fffffffu;
    if (any(greaterThan(magnitude, uvec3(0x7f800000u))))
        colour = vec4(1.0, 0.0, 1.0, 1.0);
    else if (!all(finite(value)))
        colour = vec4(0.0, 1.0, 0.0, 1.0);
    else if (channels.y < 0)
        colour = vec4(value * scale, 1.0);
    else
        colour = vec4(mix(k_zero, value.x < 0.0 ? k_below : k_above, min(abs(value.x * scale), 1.0)), 1.0);
}
)";

constexpr int k_look_block = 8;

/// Finds the largest finite magnitude in a block of k_look_block pixels a side, here 8.
constexpr const char* k_largest_text = R"(
out vec4 colour;
void main() {
    ivec2 corner = ivec2(gl_FragCoord.xy) * 8, size = textureSize(picture, 0);
    float largest = 0.0;
    for (int y = corner.y; y < min(corner.y + 8, size.y); ++y)
        for (int x = corner.x; x < min(corner.x + 8, size.x); ++x) {
            vec3 value = seen(ivec2(x, y));
            value = mix(vec3(0.0), abs(value), finite(value));
            largest = max(largest, max(value.x, max(value.y, value.z)));
        }
    colour = vec4(largest);
}
)";

/// Makes room for a picture of that size, or keeps the existing target if it fits.
bool fit(std::optional<gl::RenderTarget>& target, Extent extent, GLenum format) {
    if (!target || target->extent() != extent)
        target = gl::make_render_target(gl::make_texture(extent, format, 1));
    return target.has_value();
}

void choose(const FilterProgram& program, const Look& look) {
    program.set("channels",
                {double(look.channel.value_or(-1)), double(look.channel ? look.less.value_or(-1) : -1)});
}

void draw_into(const gl::RenderTarget& target, const FilterProgram& program, const gl::Texture& picture) {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer.id());
    program.draw(picture, target.extent());
}

} // namespace

Result<FilterProgram> FilterProgram::create(const char* what, const char* text) {
    const bool es = gl::is_es();
    auto program =
        gl::Program::link(glsl::vertex_shader(es ? glsl::Version::es_300 : glsl::Version::core_450),
                          std::string(es ? k_es_lines : k_desktop_line) + text);
    if (!program)
        return fail(ErrorCode::load, fmt::format("the driver does not compile tidemark's shader for {}: {}",
                                                 what, program.error()));
    return FilterProgram(*std::move(program));
}

FilterProgram::FilterProgram(gl::Program program)
    : program_(std::move(program)), no_vertices_(gl::make_vertex_array()),
      nearest_(gl::make_sampler(GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE)) {}

void FilterProgram::set(const char* uniform, std::initializer_list<double> values) const {
    if (const gl::Uniform* found = program_.reflection().find(uniform))
        gl::set_uniform(program_, *found, std::span(values.begin(), values.size()));
}

void FilterProgram::draw(const gl::Texture& picture, Extent extent) const {
    glViewport(0, 0, extent.width, extent.height);
    glUseProgram(program_.id());
    glBindSampler(0, nearest_.id());
    gl::bind_texture(0, picture);
    glBindVertexArray(no_vertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

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
    if (!fit(target_, extent, volume ? GL_RGBA32F : GL_RGBA16F))
        return nullptr;
    program_.set("side", {double(side)});
    program_.set("slice", {double(std::clamp(slice, 0, picture.depth - 1))});
    draw_into(*target_, program_, picture);
    return &target_->texture;
}

Result<NumberMarks> NumberMarks::create() {
    return FilterProgram::create("the marks", k_text).map([](FilterProgram program) {
        return NumberMarks(std::move(program));
    });
}

void NumberMarks::draw(const gl::Texture& picture, Extent window) const {
    program_.set("extent", {double(window.width), double(window.height)});
    program_.draw(picture, window);
}

Result<PictureLook> PictureLook::create() {
    auto look = TRY(FilterProgram::create("the exposure", (std::string(k_seen_text) + k_look_text).c_str()));
    auto largest =
        TRY(FilterProgram::create("the exposure", (std::string(k_seen_text) + k_largest_text).c_str()));
    return PictureLook(std::move(look), std::move(largest));
}

/// Returns the exposure at which the largest magnitude is 1; `look.stops` when all is zero.
double PictureLook::automatic_stops(const gl::Texture& picture, const Look& look) {
    const auto blocks = [](int length) { return (length + k_look_block - 1) / k_look_block; };
    size_t count = 0;
    const auto last = [&]() -> const gl::Texture& {
        return count == 0 ? picture : reduced_[count - 1].texture;
    };
    while (count == 0 || last().extent.pixels() > 1) {
        const Extent extent{blocks(last().extent.width), blocks(last().extent.height)};
        reduced_.resize(std::max(reduced_.size(), count + 1));
        if (reduced_[count].extent() != extent) {
            auto made = gl::make_render_target(gl::make_texture(extent, GL_RGBA32F, 1));
            if (!made)
                return look.stops;
            reduced_[count] = *std::move(made);
        }
        choose(largest_, count == 0 ? look : Look{.channel = 0});
        draw_into(reduced_[count], largest_, last());
        ++count;
    }
    const float largest = gl::read_part(last(), 0, {0, 0, {1, 1}})[0];
    return largest > 0 ? -std::log2(double(largest)) : look.stops;
}

const gl::Texture* PictureLook::draw(const gl::Texture& picture, const Look& look) {
    if (!fit(target_, picture.extent, GL_RGBA8))
        return nullptr;
    constexpr double k_farthest = 126; // a larger factor could be infinite: 0 would be NaN
    stops_ =
        std::clamp(look.automatic ? automatic_stops(picture, look) : look.stops, -k_farthest, k_farthest);
    choose(look_, look);
    look_.set("scale", {std::exp2(stops_)});
    draw_into(*target_, look_, picture);
    return &target_->texture;
}

const gl::Texture& ShownFloats::draw(const Renderer& renderer, const FrameInputs& inputs,
                                     const Rectangle& part) {
    const gl::Texture& shown = renderer.target().texture;
    if (shown.internal_format != GL_RGBA8 || !has_target(renderer))
        return shown;
    const gl::Scissor only(part);
    renderer.draw_again(inputs, *target_);
    return target_->texture;
}

/// Makes a target of the picture's size, so that gl_FragCoord stays the same.
bool ShownFloats::has_target(const Renderer& renderer) {
    if (!can_draw_again_)
        can_draw_again_ = renderer.can_draw_again();
    return *can_draw_again_ && fit(target_, renderer.extent(), GL_RGBA32F);
}

} // namespace tidemark::render
