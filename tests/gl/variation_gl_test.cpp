// Sums with one rounding, and from the other end: the numbers that a driver makes of the rewritten text.
#include "gl_test.hpp"
#include "lab/instrumented_pass.hpp"
#include "shader/variation.hpp"

#include <cmath>

namespace tidemark::lab::variation_gl_test {

using glsl::Variation;
using Vary = Variation (*)(const glsl::ParsedText& text, const glsl::TreeFacts& facts);

class VariationTest : public render::RenderTest {
protected:
    /// The first `count` pixels of a scene that puts each expression into one, in the given mode.
    std::vector<float> varied(Vary vary, int mode, const std::vector<std::string>& expressions,
                              const std::string& before) const {
        render::Renderer drawing = renderer(telling(expressions, before), {64, 1});
        const auto text = read_text(drawing, 0);
        EXPECT_TRUE(text) << to_string(text.error());
        const Variation made = vary(**text, glsl::find_facts(**text));
        const PassPreview preview(drawing, 0, {});
        auto stand_in = StandIn::link(preview, made.text, "a variation");
        if (!stand_in) {
            ADD_FAILURE() << to_string(stand_in.error()) << "\n" << made.text;
            return std::vector<float>(expressions.size());
        }
        stand_in->set(made.mode_uniform, mode);
        stand_in->draw(preview);
        return reds(stand_in->picture(), expressions.size());
    }
};

/// Numbers that no compiler knows: made of iFrame, which is 0.
constexpr const char* k_numbers = "#define A (1.1 + float(iFrame))\n#define B (1.3 + float(iFrame))\n"
                                  "#define C (-1.43 - float(iFrame))\n";

TEST_F(VariationTest, AProductLosesNothingOnItsWayIntoASum) {
    const float a = 1.1f, b = 1.3f, c = -1.43f, ab = a * b;
    const std::vector<std::string> expressions = {
        "A * B + C",
        "C + A * B",
        "A * A - A * A",
        "C - A * B",
        "A * B - C",
        "(vec2(A) * B + C).y",
        "(C - vec3(A) * B).z",
        "(vec4(C) + B * vec4(A)).w",
        "(mat2(A) * vec2(B) + C).x",
        "float(3 * iFrame + 2) * A + C",
    };
    const std::vector<float> rounded = varied(glsl::vary_contraction, 0, expressions, k_numbers);
    const std::vector<float> whole = varied(glsl::vary_contraction, 1, expressions, k_numbers);
    const float once = std::fma(a, b, c);
    ASSERT_NE(once, ab + c) << "numbers for which it matters";
    const float error = std::fma(a, a, -(a * a));
    ASSERT_NE(error, 0.0f);
    EXPECT_EQ(rounded, (std::vector<float>{ab + c, ab + c, 0.0f, c - ab, ab - c, ab + c, c - ab, ab + c,
                                           ab + c, 2.0f * a + c}));
    EXPECT_EQ(whole, (std::vector<float>{once, once, error, std::fma(-a, b, c), std::fma(a, b, -c), once,
                                         std::fma(-a, b, c), once, ab + c, std::fma(2.0f, a, c)}));
}

TEST_F(VariationTest, ASumIsAddedUpFromItsOtherEnd) {
    const float a = 1.1f, b = 1.3f, c = -1.43f;
    const std::vector<float> found =
        varied(glsl::vary_order, 0, {"A + B + C", "A - B - C + A", "(vec2(A) - B + C).y"}, k_numbers);
    ASSERT_NE((a + b) + c, a + (b + c));
    EXPECT_EQ(found, (std::vector<float>{a + (b + c), a - (b + (c - a)), a - (b - c)}));
}

} // namespace tidemark::lab::variation_gl_test
