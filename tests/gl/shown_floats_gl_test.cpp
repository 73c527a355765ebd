// The floats that Image wrote, from a renderer that keeps Image in bytes.
#include "gl_test.hpp"
#include "render/buffer_views.hpp"

#include <cstring>

namespace tidemark::render::shown_floats_gl_test {

constexpr Extent k_extent{33, 17};
constexpr const char* k_text = R"(
void mainImage(out vec4 c, in vec2 p) {
    c = vec4(sin(p.x * 12.0) * 3.0, fwidth(p.x * p.y), p.x > 20.0 ? sqrt(-p.y) : iTime, 1.0);
}
)";

class ShownFloatsTest : public RenderTest {
protected:
    /// The rows of a part, in the bits that it is compared by.
    static std::vector<uint32_t> bits_of(const std::vector<float>& values) {
        std::vector<uint32_t> bits(values.size());
        std::memcpy(bits.data(), values.data(), values.size() * sizeof(float));
        return bits;
    }
};

TEST_F(ShownFloatsTest, equal_those_of_a_float_target) {
    const FrameInputs inputs = inputs_of_frame(7, 60);
    Renderer bytes = renderer(k_text, k_extent, image::SampleType::u8);
    Renderer floats = renderer(k_text, k_extent, image::SampleType::f32);
    bytes.draw(inputs);
    floats.draw(inputs);
    const image::Image before = bytes.read_back();
    ShownFloats shown;
    for (const Rectangle part : {Rectangle{5, 3, {15, 9}}, {0, 0, k_extent}, {32, 16, {1, 1}}})
        EXPECT_EQ(bits_of(gl::read_part(shown.draw(bytes, inputs, part), 0, part)),
                  bits_of(gl::read_part(floats.target().texture, 0, part)));
    EXPECT_EQ(bytes.read_back().bytes, before.bytes) << "the frame on show stays as it is";
}

TEST_F(ShownFloatsTest, work_with_feedback) {
    const std::string text = "#iChannel0 \"self\"\nvoid mainImage(out vec4 c, in vec2 p) { "
                             "c = texelFetch(iChannel0, ivec2(p), 0) * 0.7 + p.x; }\n";
    Renderer bytes = renderer(text, k_extent, image::SampleType::u8);
    Renderer floats = renderer(text, k_extent, image::SampleType::f32);
    for (int frame = 0; frame < 3; ++frame) {
        bytes.draw(inputs_of_frame(frame, 60));
        floats.draw(inputs_of_frame(frame, 60));
    }
    constexpr Rectangle k_part{4, 2, {3, 3}};
    ShownFloats shown;
    EXPECT_EQ(bits_of(gl::read_part(shown.draw(bytes, inputs_of_frame(2, 60), k_part), 0, k_part)),
              bits_of(gl::read_part(floats.target().texture, 0, k_part)));
}

TEST_F(ShownFloatsTest, are_bytes_for_discarded_pixels) {
    Renderer bytes =
        renderer("void mainImage(out vec4 c, in vec2 p) { if (p.x < 3.0) discard; c = vec4(p, 0.0, 1.0); }\n",
                 k_extent, image::SampleType::u8);
    bytes.draw({});
    ShownFloats shown;
    EXPECT_EQ(shown.draw(bytes, {}, {0, 0, {1, 1}}).id(), bytes.target().texture.id());
}

} // namespace tidemark::render::shown_floats_gl_test
