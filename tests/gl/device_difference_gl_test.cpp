// Two devices that differ in a known way: the second one draws a text in which that is written out.
#include "gl_test.hpp"
#include "lab/device_difference.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace tidemark::lab::device_difference_gl_test {

constexpr Extent k_extent{64, 36};

class DeviceDifferenceTest : public render::RenderTest {
protected:
    /// The difference of the picture of `there` from that of `here`, explained by varying `here`.
    DeviceDifference difference(const std::string& here, const std::string& there,
                                OtherDevice other = OtherDevice::unknown) const {
        const FrameState state = state_at(2, k_extent);
        ProbeBench first(scene_of(here), {}), second(scene_of(there), {});
        return difference(first, second, state, other);
    }

    /// A scene whose Buffer A reads its own last frame, which Image shows. `buffer` sets `c` from `last`.
    scene::Scene with_feedback(const std::string& folder, const std::string& before,
                               const std::string& buffer) const {
        std::filesystem::create_directory(path_of(folder));
        put(folder + "/buffer_a.glsl", "#iChannel0 \"self\"\n" + before +
                                           "\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                                           "vec4 last = texelFetch(iChannel0, ivec2(p), 0);\n" +
                                           buffer + "\n}\n");
        const auto image = put(folder + "/image.glsl",
                               "#iChannel0 \"buffer_a.glsl\"\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                               "c = fract(texelFetch(iChannel0, ivec2(p), 0));\n}\n");
        const auto scene = scene::load_scene(image.parent_path());
        EXPECT_TRUE(scene) << to_string(scene.error());
        return scene.value_or(scene::Scene{});
    }

    static DeviceDifference difference(ProbeBench& first, ProbeBench& second, const FrameState& state,
                                       OtherDevice other, const SeeCauses& see = {}) {
        const auto left = draw_frame(first, state), right = draw_frame(second, state);
        if (!left || !right) {
            ADD_FAILURE() << "a text does not compile";
            return {};
        }
        auto found = compare_devices(left->passes.back().picture, right->passes.back().picture);
        EXPECT_TRUE(found);
        const auto explained = explain(*found, first, state, *right, other, see);
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

const std::string k_swiftshader_sine =
    "float other(float x) {\nprecise float t = x * -0.159154937 + 0.25, z = 0.25 - abs(t - "
    "roundEven(t)), s = z * z;\n"
    "precise float r = ((74.4388885 * s - 41.1693687) * s + 6.28230858) * z;\nreturn r;\n}";

/// Two lines carry the difference, each in one half of the picture, with sines between them that do not show.
TEST_F(DeviceDifferenceTest, LinesThatCarryItTogetherAreNamed) {
    const std::string rest =
        "\nfloat a(float x) { return 1e-4 * sin(x); }\n"
        "float b(float x) { return 1e-4 * sin(x + 1.0); }\n"
        "float d(float x) { return 1e-4 * sin(x + 2.0); }\n"
        "float e(float x) { return 1e-4 * sin(x + 3.0); }\n"
        "float right(vec2 p) { return fract(OTHER(dot(p, vec2(39.346, 11.135))) * 4375854.53); }\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "c = vec4(p.x < 32.0 ? hash(floor(p)) : right(floor(p)), a(p.x) + b(p.y), d(p.x) + e(p.y), "
        "1.0);\n}\n";
    const auto found = difference("#define OTHER sin\n" + k_sine_hash + rest,
                                  k_swiftshader_sine + "\n#define OTHER other\n" + k_sine_hash + rest,
                                  OtherDevice::swiftshader);
    ASSERT_EQ(found.causes.size(), 1u);
    std::vector<int> lines;
    for (const SourceLocation& where : found.causes[0].places)
        lines.push_back(where.line);
    EXPECT_EQ(lines, (std::vector{2, 7}));
}

TEST_F(DeviceDifferenceTest, SwiftShadersSinesAreReproduced) {
    const auto found = difference("#define OTHER sin\n" + k_sine_hash + k_image,
                                  k_swiftshader_sine + "\n#define OTHER other\n" + k_sine_hash + k_image,
                                  OtherDevice::swiftshader);
    EXPECT_GT(found.differing, 300u);
    ASSERT_EQ(found.causes.size(), 1u);
    EXPECT_EQ(found.causes[0].name, "sine");
    EXPECT_TRUE(found.causes[0].reproduced);
    ASSERT_EQ(found.causes[0].places.size(), 1u);
    EXPECT_EQ(found.causes[0].places[0].line, 2);
    EXPECT_EQ(found.explained, 1.0);
}

/// Each pixel needs the other sine and the other remainder. Lines 7 to 9 have sines and remainders that do
/// not show.
TEST_F(DeviceDifferenceTest, EachOfTwoCausesIsFoundWithItsLine) {
    const std::string rest =
        "\nint low(vec2 p) {\n return OTHER_REST(int(p.x) - 80, 7); }\n"
        "float a(float x) { return 1e-4 * sin(x); }\n"
        "float b(float x) { return 1e-4 * float(int(x) % 5); }\n"
        "float d(float x) { return 1e-4 * sin(x + 2.0); }\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "c = vec4(fract(hash(floor(p)) + 0.13 * float(low(p))), a(p.x) + b(p.y), d(p.x), "
        "1.0);\n}\n";
    const std::string here =
        "#define OTHER sin\n#define OTHER_REST(a, b) ((a) % (b))\n\n" + k_sine_hash + rest;
    const std::string there =
        k_swiftshader_sine +
        "\n#define OTHER other\nint OTHER_REST(int a, int b) { return b - 1 - (-1 - a) % b; }\n" +
        k_sine_hash + rest;
    const auto found = difference(here, there, OtherDevice::swiftshader);
    EXPECT_GT(found.differing, 1500u);
    EXPECT_GT(found.explained, k_explained_share);
    std::set<std::pair<std::string, int>> lines;
    for (const DeviceCause& cause : found.causes)
        for (const SourceLocation& where : cause.places)
            lines.insert({cause.name, where.line});
    EXPECT_EQ(lines, (std::set<std::pair<std::string, int>>{{"sine", 4}, {"undefined", 2}}));
}

/// llvmpipe computes any number for a quotient by a zero that it knows; no function of this text matters.
TEST_F(DeviceDifferenceTest, AQuotientByAKnownZeroIsFoundWithItsLine) {
    const auto text = [](const char* quotient) {
        return std::string("float soft = 0.0;\nfloat edge(float d) {\n") +
               "float at = d * 0.5;\nreturn clamp(0.5 - " + quotient + ", 0.0, 1.0);\n}\n" +
               "void mainImage(out vec4 c, in vec2 p) {\n"
               "float d = length(p - 16.3) - 9.7;\nc = vec4(edge(d), fract(d), 0.2, 1.0);\n}\n";
    };
    const auto found =
        difference(text("at / soft"), text("(at < 0.0 ? -1e9 : 1e9)"), OtherDevice::swiftshader);
    EXPECT_GT(found.differing, 100u) << "this driver's quotients are infinite, too";
    ASSERT_EQ(found.causes.size(), 1u);
    EXPECT_EQ(found.causes[0].name, "undefined");
    ASSERT_EQ(found.causes[0].places.size(), 1u);
    EXPECT_EQ(found.causes[0].places[0].line, 4);
    EXPECT_EQ(found.explained, 1.0);
}

/// A buffer has floats, whose mipmaps are the same on both devices, but SwiftShader chooses between them by
/// another logarithm: for steps of 1.1892 texels level 0.25, as exactly, where llvmpipe takes 0.207.
TEST_F(DeviceDifferenceTest, MipmapsOfABufferAreChosenAsBySwiftShader) {
    const auto scene_with = [&](const std::string& folder, const std::string& look_up) {
        std::filesystem::create_directory(path_of(folder));
        put(folder + "/buffer_a.glsl", "void mainImage(out vec4 c, in vec2 p) {\nivec2 i = ivec2(p);\nc = "
                                       "vec4(i.x * 7 + i.y * 5 & 8, i.x * 3 & "
                                       "4, 0, 8) / 8.0;\n}\n");
        const auto image =
            put(folder + "/image.glsl",
                "#iChannel0 \"buffer_a.glsl\"\n#iChannel0::MinFilter \"LinearMipMapLinear\"\n"
                "void mainImage(out vec4 c, in vec2 p) {\nvec2 uv = 1.189207115 * p / iResolution.xy;\nc = " +
                    look_up + ";\n}\n");
        const auto scene = scene::load_scene(image.parent_path());
        EXPECT_TRUE(scene) << to_string(scene.error());
        return scene.value_or(scene::Scene{});
    };
    ProbeBench first(scene_with("here", "texture(iChannel0, uv)"), {}),
        second(scene_with("there", "mix(textureLod(iChannel0, uv, 0.0), textureLod(iChannel0, uv, 1.0), "
                                   "0.25)"),
               {});
    const auto found = difference(first, second, state_at(2, k_extent), OtherDevice::swiftshader);
    EXPECT_GT(found.differing, 300u) << "this driver has the same logarithm";
    ASSERT_EQ(found.causes.size(), 1u);
    EXPECT_EQ(found.causes[0].says, "SwiftShader's choice of the mipmap");
    EXPECT_EQ(found.explained, 1.0);
}

/// Another sine moves the same pixels, but does not draw what SwiftShader draws.
TEST_F(DeviceDifferenceTest, AnotherSineIsNotTakenForSwiftShaders) {
    const auto found =
        difference("#define OTHER sin\n" + k_sine_hash + k_image,
                   "#define OTHER(x) sin(x + 1.0)\n" + k_sine_hash + k_image, OtherDevice::swiftshader);
    EXPECT_LT(found.explained, 0.2);
}

/// A count of frames and a third, which no byte and no half float holds.
TEST_F(DeviceDifferenceTest, ThePreviousFrameIsReadInFloats) {
    ProbeBench bench(with_feedback("count", "", "c = vec4(last.x + 1.0, 1.0 / 3.0, -last.x, 1e-20);"), {});
    const auto frame = draw_frame(bench, state_at(2, k_extent));
    ASSERT_TRUE(frame) << to_string(frame.error());
    const auto colour = [](const std::vector<PassPicture>& passes) {
        const auto samples = picture_of(passes, "Buffer A")->f32();
        return std::vector<float>(samples.end() - 4, samples.end());
    };
    // Nine frames are drawn: that of the state and eight before it.
    EXPECT_EQ(colour(frame->passes), (std::vector<float>{9, 1.0f / 3, -8, 1e-20f}));
    EXPECT_EQ(colour(frame->before), (std::vector<float>{8, 1.0f / 3, -7, 1e-20f}));
    const auto renderer = bench.renderer(state_at(2, k_extent));
    ASSERT_TRUE(renderer);
    EXPECT_EQ((*renderer)->passes_drawn(), 2u * 9) << "each frame is drawn once, in two passes";
}

TEST_F(DeviceDifferenceTest, AStillSceneHasNoPreviousFrame) {
    ProbeBench bench(scene_of("float hash(vec2 p) { return 0.2; }" + std::string(k_image)), {});
    const auto frame = draw_frame(bench, state_at(2, k_extent));
    ASSERT_TRUE(frame) << to_string(frame.error());
    EXPECT_EQ(frame->passes.size(), 1u);
    EXPECT_TRUE(frame->before.empty());
}

/// Each frame amplifies the one before it, so that the two buffers have nothing in common any more.
const std::string k_amplified = "c = fract(37.7 * last + hash(p));";

TEST_F(DeviceDifferenceTest, FeedbackIsExplainedFromTheOtherDevicesPreviousFrame) {
    ProbeBench first(with_feedback("here", "#define OTHER sin\n" + k_sine_hash, k_amplified), {}),
        second(
            with_feedback("there", k_swiftshader_sine + "\n#define OTHER other\n" + k_sine_hash, k_amplified),
            {});
    const auto found = difference(first, second, state_at(2, k_extent), OtherDevice::swiftshader);
    EXPECT_GT(found.differing, 1500u);
    ASSERT_FALSE(found.causes.empty());
    EXPECT_EQ(found.causes[0].name, "sine");
    EXPECT_EQ(found.causes[0].pass, "Buffer A");
    EXPECT_TRUE(found.causes[0].reproduced);
    ASSERT_EQ(found.causes[0].places.size(), 1u);
    EXPECT_EQ(found.causes[0].places[0].line, 3);
    EXPECT_EQ(found.explained, 1.0);
}

/// Frame 114 draws noise, which the others keep: frame 120 draws the other device's frame 119 alike.
TEST_F(DeviceDifferenceTest, AnEarlierFrameHasTheCauseOfALaterDifference) {
    const std::string kept = "c = iFrame == 114 ? vec4(hash(p)) : last;";
    ProbeBench first(with_feedback("here", "#define OTHER sin\n" + k_sine_hash, kept), {}),
        second(with_feedback("there", k_swiftshader_sine + "\n#define OTHER other\n" + k_sine_hash, kept),
               {});
    const FrameState state = state_at(2, k_extent);
    const auto later = difference(first, second, state, OtherDevice::swiftshader);
    EXPECT_GT(later.differing, 1500u);
    EXPECT_TRUE(later.begins_earlier);
    EXPECT_EQ(later.explained, 0.0);
    first.start_at(112);
    second.start_at(112);
    const auto found = difference(first, second, state.at_frame(114), OtherDevice::swiftshader);
    EXPECT_FALSE(found.begins_earlier);
    EXPECT_EQ(found.explained, 1.0);
    ASSERT_FALSE(found.causes.empty());
    EXPECT_EQ(found.causes[0].name, "sine");
}

/// The same amplification, but of a difference that no model makes.
/// Lines take long: they must not take the time from passes that are not yet explained.
TEST_F(DeviceDifferenceTest, LinesAreSearchedWhenAllPassesAreExplained) {
    const auto scene = [&](const std::string& folder, const std::string& before) {
        std::filesystem::create_directory(path_of(folder));
        put(folder + "/buffer_a.glsl", before + k_sine_hash + k_image);
        const auto image =
            put(folder + "/image.glsl", "#iChannel0 \"buffer_a.glsl\"\n" + before + k_sine_hash +
                                            "\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                                            "c = fract(texelFetch(iChannel0, ivec2(p), 0) + "
                                            "hash(p.yx));\n}\n");
        return scene::load_scene(image.parent_path()).value_or(scene::Scene{});
    };
    ProbeBench first(scene("here", "#define OTHER sin\n"), {}),
        second(scene("there", k_swiftshader_sine + "\n#define OTHER other\n"), {});
    std::vector<size_t> seen, with_lines; // causes of each report
    const auto found = difference(
        first, second, state_at(2, k_extent), OtherDevice::swiftshader, [&](const DeviceDifference& so_far) {
            seen.push_back(so_far.causes.size());
            with_lines.push_back(
                std::ranges::count_if(so_far.causes, [](const auto& c) { return !c.places.empty(); }));
        });
    EXPECT_EQ(seen, (std::vector<size_t>{1, 2}));
    EXPECT_EQ(with_lines, (std::vector<size_t>{0, 0}));
    ASSERT_EQ(found.causes.size(), 2u);
    EXPECT_EQ(found.causes[0].pass, "Buffer A");
    ASSERT_EQ(found.causes[0].places.size(), 1u);
    EXPECT_EQ(found.causes[0].places[0].line, 2);
    ASSERT_EQ(found.causes[1].places.size(), 1u);
    EXPECT_EQ(found.causes[1].places[0].line, 3);
}

TEST_F(DeviceDifferenceTest, AnUnknownDifferenceInFeedbackStaysUnexplained) {
    const std::string hash = "#define OTHER sin\n" + k_sine_hash;
    ProbeBench first(with_feedback("here", hash, k_amplified), {}),
        second(with_feedback("there", hash, k_amplified + "\nc.x = fract(c.x + 0.25);"), {});
    EXPECT_LT(difference(first, second, state_at(2, k_extent), OtherDevice::swiftshader).explained, 0.1);
    ProbeBench eighths(with_feedback("eighths", "", "c = fract(last + 0.125);"), {}),
        more(with_feedback("more", "", "c = fract(last + 0.375);"), {});
    const auto found = difference(eighths, more, state_at(2, k_extent), OtherDevice::unknown);
    EXPECT_EQ(found.differing, k_extent.pixels());
    EXPECT_EQ(found.explained, 0.0);
}

/// A hash of a dot product, which the other device sums from the first component on, as zink does. Each
/// driver has an order of its own, so one of the two texts differs.
TEST_F(DeviceDifferenceTest, TheOrderOfADotProductIsFoundWithItsLine) {
    const auto text = [](const char* dot) {
        return std::string("float hash(vec2 p) {\n") +
               "vec3 a = vec3(0.1 + 0.013 * p.x, 0.7 + 0.017 * p.y, 0.0013 * p.x * p.y), b = a.zxy;\n" +
               "float d = " + dot + ";\nreturn fract(d * 43758.5);\n}" + k_image;
    };
    const std::string own = text("dot(a, b)");
    const std::pair<std::string, std::string> orders[] = {
        {"dot products summed from the first component on", text("(a.x * b.x + a.y * b.y) + a.z * b.z")},
        {"dot products summed from the last component on", text("(a.z * b.z + a.y * b.y) + a.x * b.x")}};
    size_t differing = 0;
    for (const auto& [says, other] : orders) {
        const auto found = difference(own, other, OtherDevice::same_functions);
        if (found.differing == 0)
            continue;
        ++differing;
        EXPECT_GT(found.differing, 100u);
        ASSERT_EQ(found.causes.size(), 1u);
        EXPECT_EQ(found.causes[0].says, says);
        EXPECT_TRUE(found.causes[0].reproduced);
        ASSERT_EQ(found.causes[0].places.size(), 1u);
        EXPECT_EQ(found.causes[0].places[0].line, 3);
    }
    EXPECT_GE(differing, 1u);
}

/// A sine that differs moves these pixels, but no sine is tried for a device whose sines are the same.
TEST_F(DeviceDifferenceTest, ADeviceWithTheSameFunctionsHasNoOtherSine) {
    const std::string smaller =
        "float other(float x) { float r = sin(x); return uintBitsToFloat(floatBitsToUint(r) - 1u); }";
    const auto found =
        difference("#define OTHER sin\n" + k_sine_hash + k_image,
                   smaller + "\n#define OTHER other\n" + k_sine_hash + k_image, OtherDevice::same_functions);
    EXPECT_GT(found.differing, 300u);
    for (const DeviceCause& cause : found.causes)
        EXPECT_EQ(cause.name, "rounding");
}

TEST_F(DeviceDifferenceTest, TheTestOfFunctionsDrawsTenFiniteRows) {
    FrameState state = state_at(2, k_functions_extent);
    ProbeBench bench(scene_of(std::string(k_functions_test)), {});
    const auto frame = draw_frame(bench, state);
    ASSERT_TRUE(frame) << to_string(frame.error());
    const image::Image& picture = frame->passes[0].picture;
    std::set<float> numbers;
    for (size_t pixel = 0; pixel < k_functions_extent.pixels(); ++pixel) {
        EXPECT_TRUE(std::isfinite(picture.f32()[4 * pixel])) << pixel;
        numbers.insert(picture.f32()[4 * pixel]);
    }
    EXPECT_GT(numbers.size(), 600u);
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
