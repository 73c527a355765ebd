// The cuts of a scene's texts, drawn: what a texture's level changes. And texts that do one line twice.
#include "gl_test.hpp"
#include "lab/instrumented_pass.hpp"
#include "lab/simplify.hpp"
#include "shader/lens_text.hpp"
#include "support/scene_of.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::lab::cut_places_gl_test {

constexpr Extent k_extent{64, 36};
const Goal k_any_error{Measure::rmse, 1.0, {}};

/// Channel 0 reads noise with mipmaps, channel 1 without.
scene::Scene image_of(const std::string& body) {
    scene::Scene scene = scene_of(
        "void mainImage(out vec4 c, in vec2 p) {\n    vec2 uv = p / iResolution.xy;\n" + body + "\n}\n");
    scene.passes[0].channels[1].sampling.mipmaps = scene::Mipmaps::none;
    return scene;
}

std::vector<glsl::Cut> levels_of(const scene::Scene& scene) {
    auto found = find_cuts(scene, default_views(), k_extent, [] { return true; });
    EXPECT_TRUE(found) << found.error().message;
    std::erase_if(found->cuts,
                  [](const glsl::Cut& cut) { return cut.change.reason.find("level") == std::string::npos; });
    std::ranges::sort(found->cuts, {}, [](const glsl::Cut& cut) { return cut.change.reason; });
    return found->cuts;
}

/// RMSE of each, by level.
std::vector<double> errors_of(const scene::Scene& scene) {
    auto bench = CutBench::create(scene, k_extent, default_views(), 1);
    EXPECT_TRUE(bench) << bench.error().message;
    std::vector<double> errors;
    for (const glsl::Cut& cut : levels_of(scene)) {
        const auto trial = bench->try_cuts(std::span(&cut.change, 1), bench->own(), k_any_error);
        EXPECT_TRUE(trial) << cut.change.reason;
        errors.push_back(trial ? trial->error : -1);
    }
    return errors;
}

TEST(CutPlaces, fixed_level_0_is_exact_for_magnification) {
    const auto errors = errors_of(image_of("c = texture(iChannel0, uv * 0.05);"));
    ASSERT_EQ(errors.size(), 4U);
    EXPECT_EQ(errors[0], 0) << "magnified: level 0 anyway";
    EXPECT_GT(errors[1], 0.001);
    EXPECT_LT(errors[1], errors[3]);
}

TEST(CutPlaces, a_coarser_level_is_nearer_where_texels_are_smaller_than_pixels) {
    const auto errors = errors_of(image_of("c = texture(iChannel0, uv * vec2(1.0, 0.5625));"));
    ASSERT_EQ(errors.size(), 4U);
    EXPECT_LT(errors[2], 0.001) << "4 texels a pixel";
    EXPECT_GT(errors[0], 10 * errors[2]);
}

TEST(CutPlaces, textures_without_mipmaps_have_no_level_cuts) {
    EXPECT_TRUE(levels_of(image_of("c = texture(iChannel1, uv);")).empty());
}

/// Rotations, a light and a knob's power, in functions that a march calls.
const char* const k_march = R"(
#define R(a) mat2(cos(a), sin(a), -sin(a), cos(a))
#define T (iTime * 0.7)
#iUniform float sharpness = 3.0 in { 1.0, 9.0 }
vec3 light() { return normalize(vec3(cos(iTime), 1.0, sin(iTime))); }
float map(vec3 p) {
    float wave = 0.5 + 0.5 * sin(T);
    p.xz *= R(T);
    p.xy *= R(-wave);
    return length(max(abs(p) - vec3(0.5, 0.3, wave), 0.0)) - 0.1 * pow(wave, sharpness);
}
void mainImage(out vec4 c, in vec2 p) {
    vec3 d = normalize(vec3((2.0 * p - iResolution.xy) / iResolution.y, 1.5)), o = vec3(0.0, 0.0, -3.0);
    float t = 0.0;
    for (int i = 0; i < 40; ++i)
        t += map(o + t * d);
    vec2 e = vec2(0.001, 0.0);
    vec3 q = o + t * d, n = vec3(map(q + e.xyy), map(q + e.yxy), map(q + e.yyx)) - map(q);
    c = vec4(t < 9.0 ? vec3(0.5 + 0.5 * dot(normalize(n), light())) : d, 1.0);
}
)";

TEST(CutPlaces, hoisted_expressions_keep_the_picture) {
    const scene::Scene scene = scene_of(k_march);
    auto found = find_cuts(scene, default_views(), k_extent, [] { return true; });
    ASSERT_TRUE(found);
    std::erase_if(found->cuts, [](const glsl::Cut& cut) {
        return cut.change.reason.find("once per pixel") == std::string::npos;
    });
    ASSERT_EQ(found->cuts.size(), 1U);
    auto bench = CutBench::create(scene, k_extent, default_views(), 1);
    ASSERT_TRUE(bench);
    const auto trial = bench->try_cuts(std::span(&found->cuts[0].change, 1), bench->own(), k_any_error);
    ASSERT_TRUE(trial) << "the driver refuses it";
    EXPECT_LT(trial->error, 1e-3) << "drivers may round differently";
}

/// A march with a limit that has a name, an ambient loop, a texture, terms and factors.
const char* const k_many_cuts = R"(
const float k_near = 0.001;
#define STEPS 40
const int k_count = 4;
float weights[k_count];
float map(vec3 p) { return length(p) - 1.0 + 0.1 * sin(5.0 * p.x) * sin(5.0 * p.y) + 0.02 * sin(20.0 * p.z); }
void mainImage(out vec4 c, in vec2 p) {
    for (int i = 0; i < k_count; ++i)
        weights[i] = exp(-float(i)) * cos(iTime * sin(float(i)));
    vec3 d = normalize(vec3((2.0 * p - iResolution.xy) / iResolution.y, 1.5)), o = vec3(0.0, 0.0, -3.0);
    float t = 0.0;
    for (int i = 0; i < STEPS; ++i) {
        float h = map(o + t * d);
        if (h < k_near || t > 10.0) break;
        t += h;
    }
    vec3 q = o + t * d;
    float dark = 0.0;
    for (int i = 1; i < 6; ++i)
        dark += weights[i % 4] * max(0.0, 0.1 * float(i) - map(q - 0.1 * float(i) * d));
    c = vec4(t > 10.0 ? d : 0.5 + 0.3 * sin(3.0 * q) - 0.2 * dark, 1.0) + 0.1 * texture(iChannel0, q.xy);
}
)";

TEST(CutSwitches, show_the_error_of_each_cut_alone) {
    const scene::Scene scene = scene_of(k_many_cuts);
    const auto keep_going = [] { return true; };
    const auto found = find_cuts(scene, default_views(), k_extent, keep_going);
    ASSERT_TRUE(found);
    auto bench = CutBench::create(scene, k_extent, default_views(), 0);
    ASSERT_TRUE(bench);
    std::vector<size_t> which;
    for (size_t i = 0; i < found->cuts.size(); ++i)
        if (!found->cuts[i].switched.empty())
            which.push_back(i);
    EXPECT_GT(which.size(), 40U);
    auto switches = CutSwitches::create(scene, k_extent, found->cuts, which, keep_going);
    ASSERT_TRUE(switches);
    EXPECT_GE(switches->which().size() + 2, which.size()) << "only the size of an array stays constant";
    ASSERT_TRUE(bench->take_as_reference(*switches, Goal{Measure::rmse, 1e-3, {}}));
    for (const size_t i : switches->which()) {
        const auto error = bench->error_of_switched(*switches, std::span(&i, 1), k_any_error);
        const auto trial = bench->try_cuts(std::span(&found->cuts[i].change, 1), bench->own(), k_any_error);
        ASSERT_TRUE(trial) << found->cuts[i].change.reason;
        ASSERT_TRUE(error) << found->cuts[i].change.reason;
        EXPECT_NEAR(*error, trial->error, 2e-3 + 0.02 * trial->error) << found->cuts[i].change.reason;
    }
}

TEST(CutSwitches, make_several_cuts_together_and_none_again) {
    const scene::Scene scene = scene_of("void mainImage(out vec4 c, in vec2 p) {\n"
                                        "    c = vec4(0.0, 0.0, 0.0, 1.0);\n"
                                        "    c.x += 0.25 * exp(sin(0.0 * p.x));\n"
                                        "    c.y += 0.5 * exp(sin(0.0 * p.x));\n}\n");
    auto found = find_cuts(scene, default_views(), k_extent, [] { return true; });
    ASSERT_TRUE(found);
    std::erase_if(found->cuts, [](const glsl::Cut& cut) {
        return cut.change.reason.find("leaves out `c.") == std::string::npos;
    });
    ASSERT_EQ(found->cuts.size(), 2U);
    auto bench = CutBench::create(scene, k_extent, default_views(), 0);
    ASSERT_TRUE(bench);
    auto switches = CutSwitches::create(scene, k_extent, found->cuts, {0, 1}, [] { return true; });
    ASSERT_TRUE(switches);
    ASSERT_TRUE(bench->take_as_reference(*switches, k_any_error));
    const auto error = [&](std::vector<size_t> cuts) {
        return bench->error_of_switched(*switches, cuts, k_any_error).value_or(-1);
    };
    EXPECT_NEAR(error({0}) + error({1}), 0.75 / std::sqrt(3.0), 1e-4) << "RMSE over three channels";
    EXPECT_NEAR(error({0, 1}), std::sqrt((0.25 * 0.25 + 0.5 * 0.5) / 3), 1e-4);
    EXPECT_EQ(error({}), 0);
}

/// Operations of each kind: floats, vectors, whole numbers, conditions, matrices, calls, compound
/// assignments.
constexpr const char* k_many_lines = R"(struct Hit { float d; vec3 n; };
float f(vec3 p) { return length(p) - 1.0 / (1.0 + dot(p, p)); }
Hit g(vec3 p) { return Hit(f(p) * 0.5, normalize(p + 0.1)); }
void mainImage(out vec4 c, in vec2 p) {
    vec2 q = (2.0 * p - iResolution.xy) / iResolution.y;
    vec3 ro = vec3(q, 0.3) * mat3(cos(q.x), sin(q.x), 0.0, -sin(q.x), cos(q.x), 0.0, 0.0, 0.0, 1.0);
    float t = 0.0, s[2];
    s[1] = sin(q.x) * 3.0;
    int n = int(p.x) % 7 + (int(p.y) & 3);
    for (int i = 0; i < 8 && t < 9.0; ++i) {
        t += 0.25 * f(ro + t * vec3(0.6, 0.0, 0.8)) + 0.01 * float(i);
        ro.xy *= mat2(0.8, 0.6, -0.6, 0.8);
    }
    bool far = t * 1.5 > 2.0 || q.x * q.y > 0.5;
    vec3 k = far ? g(ro * 2.0).n * 0.5 + 0.5 : mix(vec3(0.1), ro, clamp(t * 0.3, 0.0, 1.0));
    c = vec4(k * fract(s[1] + float(n) * 0.37), g(ro).d * 2.0);
}
)";

class LineTwice : public render::RenderTest {};

TEST_F(LineTwice, KeepsThePicture) {
    render::Renderer drawing = renderer(std::string(k_many_lines), {32, 16});
    const auto text = read_text(drawing, 0);
    ASSERT_TRUE(text);
    const glsl::TreeFacts facts = glsl::find_facts(**text);
    const auto counted = glsl::count_operations(**text, facts, glsl::WorkAnswer::sites);
    ASSERT_TRUE(counted);
    const PassPreview preview(drawing, 0, {});
    const auto bytes = [&](const std::string& made) {
        auto stand_in = StandIn::link(preview, made, "a text");
        if (!stand_in) {
            ADD_FAILURE() << to_string(stand_in.error()) << "\n" << made;
            return std::vector<int>{};
        }
        stand_in->draw(preview);
        std::vector<int> shown; // drivers may add in another order, so the last digits of floats may differ
        const image::Image picture = stand_in->picture();
        for (const float sample : picture.f32())
            shown.push_back(int(std::lround(255.0f * std::clamp(sample, 0.0f, 1.0f))));
        return shown;
    };
    /// Samples that differ by more than a level: another CPU's code may round the last digit otherwise, and
    /// `fract` makes a jump of it.
    const auto unlike = [](const std::vector<int>& a, const std::vector<int>& b) {
        EXPECT_EQ(a.size(), b.size());
        size_t count = 0;
        for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
            count += std::abs(a[i] - b[i]) > 1;
        return count;
    };
    const auto plain = bytes(glsl::do_no_line_twice(**text));
    ASSERT_EQ(plain.size(), 32u * 16 * 4);
    const std::string file = (*text)->spelled((*text)->tree()[glsl::find_main_image(**text)].word).file;
    std::vector<int> lines;
    for (int line = 1; line <= 17; ++line)
        if (const auto twice = glsl::do_line_twice(**text, facts, *counted, {file, line})) {
            lines.push_back(line);
            EXPECT_LE(unlike(bytes(twice->text), plain), 5u) << "line " << line;
            EXPECT_LE(unlike(bytes(twice->control), plain), 5u) << "control of line " << line;
        }
    EXPECT_EQ(lines, (std::vector{2, 3, 5, 6, 8, 9, 11, 12, 14, 15, 16}));
}

} // namespace tidemark::lab::cut_places_gl_test
