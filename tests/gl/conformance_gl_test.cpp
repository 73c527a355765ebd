// Every folder of tests/cases/conformance is a test: a scene, and the pixels that ShaderToy's rules make of
// it, worked out without a GPU. Its README says how to add one.
#include "gl_test.hpp"
#include "lab/device_check.hpp"

#include <gmock/gmock.h>

namespace tidemark::render::conformance_gl_test {

const fs::path k_cases = fs::path(TIDEMARK_SOURCE_DIR) / "tests/cases/conformance";

std::vector<std::string> case_names() {
    std::vector<std::string> names;
    for (const fs::path& project : lab::conformance_projects(k_cases))
        names.push_back(project.filename().string());
    return names;
}

class Conformance : public testing::TestWithParam<std::string> {
protected:
    /// Size and samples are the case's.
    static void expect_pixels_of_the_convention(const RenderOptions& options) {
        const fs::path project = k_cases / GetParam();
        const auto drawn = lab::conforms(project, options);
        EXPECT_TRUE(drawn) << to_string(drawn.error());
        EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
    }
};

TEST_P(Conformance, pixels_match_the_convention) {
    expect_pixels_of_the_convention({});
}

TEST_P(Conformance, pixels_match_in_double_precision) {
    expect_pixels_of_the_convention({.precision = glsl::Precision::promoted});
}

TEST_P(Conformance, pixels_match_without_omissions) {
    expect_pixels_of_the_convention({.extras = {.passes = true,
                                                .channels = true,
                                                .mipmaps = true,
                                                .second_textures = true,
                                                .uniforms = true,
                                                .unchanged = true}});
}

TEST_P(Conformance, pixels_match_without_unreachable_code) {
    expect_pixels_of_the_convention({.specialise = glsl::Specialise::unreachable});
}

INSTANTIATE_TEST_SUITE_P(cases, Conformance, testing::ValuesIn(case_names()),
                         [](const auto& chosen) { return chosen.param; });

/// The judgement itself can fail.
class WrongExpectation : public RenderTest {};

TEST_F(WrongExpectation, the_wrong_pixel_is_named) {
    const fs::path project =
        put("scene.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }").parent_path();
    const auto judged = [&](const std::string& expected) {
        put("expected.json", R"({"convention": "", "size": [2, 2], )" + expected + "}");
        const auto drawn = lab::conforms(project);
        return drawn ? "" : to_string(drawn.error());
    };
    EXPECT_EQ(judged(R"("frames": [{"everywhere": [255, 255, 255]}])"), "");
    EXPECT_THAT(judged(R"("frames": [{"pixels": [[1, 0, [255, 254, 255]]]}])"),
                testing::HasSubstr("pixel 1,0 channel 1 is 255, not 254 (in frame 0)"));
    EXPECT_THAT(judged(R"("frames": [{"frame": "x"}])"), testing::HasSubstr("expected.json"));
    EXPECT_THAT(judged(R"("frames": [])"), testing::HasSubstr("states no expected pixels or sound"));
}

} // namespace tidemark::render::conformance_gl_test
