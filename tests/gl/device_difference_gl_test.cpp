// Two devices that differ in a known way: the second one draws a text in which that is written out.
#include "gl_test.hpp"
#include "lab/device_difference.hpp"

namespace tidemark::lab::device_difference_gl_test {

constexpr Extent k_extent{64, 36};

class DeviceDifferenceTest : public render::RenderTest {
protected:
    /// What `there` draws beside `here`, explained by varying `here`.
    DeviceDifference difference(const std::string& here, const std::string& there,
                                OtherDevice other = OtherDevice::unknown) const {
        const FrameState state = state_at(2, k_extent);
        ProbeBench first(scene_of(here), {}), second(scene_of(there), {});
        const auto left = first.passes(state), right = second.passes(state);
        if (!left || !right) {
            ADD_FAILURE() << "a text does not compile";
            return {};
        }
        auto found = compare_devices(left->back().picture, right->back().picture);
        EXPECT_TRUE(found);
        const auto explained = explain(*found, first, state, *right, other);
        EXPECT_TRUE(explained) << to_string(explained.error());
        return *found;
    }
};

const std::string k_sine_hash =
    "float hash(vec2 p) { return fract(OTHER(dot(p, vec2(12.9898, 78.233))) * 4375854.53); }";
constexpr const char* k_image = "\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                                "float x = p.x / iResolution.x;\n"
                                "c = vec4(hash(floor(p)), x, 0.0, 1.0);\n}\n";

TEST_F(DeviceDifferenceTest, ADifferentSineIsFoundWithItsLine) {
    const std::string smaller =
        "float other(float x) { float r = sin(x); return uintBitsToFloat(floatBitsToUint(r) - 1u); }";
    const auto found = difference("#define OTHER sin\n" + k_sine_hash + k_image,
                                  smaller + "\n#define OTHER other\n" + k_sine_hash + k_image);
    EXPECT_GT(found.differing, 300u);
    ASSERT_FALSE(found.causes.empty());
    EXPECT_EQ(found.causes[0].name, "sine");
    EXPECT_TRUE(found.causes[0].reproduced);
    ASSERT_EQ(found.causes[0].places.size(), 1u);
    EXPECT_EQ(found.causes[0].places[0].line, 2);
    EXPECT_EQ(found.explained, 1.0);
}

TEST_F(DeviceDifferenceTest, SwiftShadersSinesAreReproduced) {
    const std::string theirs =
        "float other(float x) {\nprecise float t = x * -0.159154937 + 0.25, z = 0.25 - abs(t - "
        "roundEven(t)), s = z * z;\n"
        "precise float r = ((74.4388885 * s - 41.1693687) * s + 6.28230858) * z;\nreturn r;\n}";
    const auto found =
        difference("#define OTHER sin\n" + k_sine_hash + k_image,
                   theirs + "\n#define OTHER other\n" + k_sine_hash + k_image, OtherDevice::swiftshader);
    EXPECT_GT(found.differing, 300u);
    ASSERT_EQ(found.causes.size(), 1u);
    EXPECT_EQ(found.causes[0].name, "sine");
    EXPECT_TRUE(found.causes[0].reproduced);
    ASSERT_EQ(found.causes[0].places.size(), 1u);
    EXPECT_EQ(found.causes[0].places[0].line, 2);
    EXPECT_EQ(found.explained, 1.0);
}

/// Another sine moves the same pixels, but does not draw what SwiftShader draws.
TEST_F(DeviceDifferenceTest, AnotherSineIsNotTakenForSwiftShaders) {
    const auto found =
        difference("#define OTHER sin\n" + k_sine_hash + k_image,
                   "#define OTHER(x) sin(x + 1.0)\n" + k_sine_hash + k_image, OtherDevice::swiftshader);
    EXPECT_LT(found.explained, 0.2);
}

TEST_F(DeviceDifferenceTest, AnUndefinedPowerIsFoundWithItsLine) {
    const auto text = [](const char* power) {
        return std::string("float hash(vec2 p) { return 0.2; }\n") +
               "void mainImage(out vec4 c, in vec2 p) {\n" +
               "float x = p.x / iResolution.x - 0.5;\nfloat y = " + power + ";\n" +
               "c = vec4(y > 0.01 ? 1.0 : 0.0, 0.5, 0.5, 1.0);\n}\n";
    };
    const auto found = difference(text("pow(x, 2.0)"), text("x < 0.0 ? 1.0 : x * x"));
    ASSERT_FALSE(found.causes.empty());
    EXPECT_EQ(found.causes[0].name, "undefined");
    ASSERT_FALSE(found.causes[0].places.empty());
    EXPECT_EQ(found.causes[0].places[0].line, 4);
    EXPECT_GE(found.explained, k_explained_share);
}

TEST_F(DeviceDifferenceTest, ADifferenceWithoutAModelStaysUnexplained) {
    const std::string plain = "float hash(vec2 p) { return 0.2; }";
    const auto found = difference(plain + k_image, "float hash(vec2 p) { return p.x < 20.0 ? 0.8 : 0.2; }" +
                                                       std::string(k_image));
    EXPECT_EQ(found.differing, 20u * 36u);
    EXPECT_TRUE(found.causes.empty());
    EXPECT_EQ(found.explained, 0.0);
}

TEST_F(DeviceDifferenceTest, EqualPicturesHaveNoDifference) {
    const std::string text = "float hash(vec2 p) { return 0.2; }" + std::string(k_image);
    const auto found = difference(text, text);
    EXPECT_TRUE(found.equal);
    EXPECT_EQ(found.differing, 0u);
    EXPECT_TRUE(found.causes.empty());
}

} // namespace tidemark::lab::device_difference_gl_test
