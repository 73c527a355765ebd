#include "render/number_marks.hpp"

#include <utility>

namespace tidemark::render {
namespace {

/// Tests the bits, because optimisers may assume that floats are finite.
constexpr const char* k_text = R"(#version 450 core
layout(binding = 0) uniform sampler2D picture;
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

} // namespace

Result<NumberMarks> NumberMarks::create() {
    return FilterProgram::create("the marks", k_text).map([](FilterProgram program) {
        return NumberMarks(std::move(program));
    });
}

void NumberMarks::draw(const gl::Texture& picture, Extent window) const {
    program_.set("extent", {double(window.width), double(window.height)});
    program_.draw(picture, window);
}

} // namespace tidemark::render
