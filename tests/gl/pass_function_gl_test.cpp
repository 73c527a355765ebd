// A pass evaluated on the CPU gives the colours that the device draws, to a rounding; and what is proved of
// its rays is what is known of them.
#include "gl_test.hpp"
#include "lab/march_hits.hpp"
#include "lab/pass_function.hpp"
#include "support/scene_of.hpp"

#include <cmath>

namespace tidemark::lab::pass_function_gl_test {

constexpr Extent k_extent{24, 14};
constexpr float k_rounding = 4e-4f; ///< of asin, which drivers approximate

scene::Scene image_of(const std::string& body) {
    return scene_of("void mainImage(out vec4 c, in vec2 p) {\n    vec2 uv = p / iResolution.xy;\n" + body +
                    "\n}\n");
}

const render::FrameInputs k_inputs = render::inputs_of_frame(180, 60);

render::Renderer renderer_of(const scene::Scene& scene) {
    auto renderer = render::Renderer::create(scene, {.extent = k_extent, .samples = image::SampleType::f32});
    EXPECT_TRUE(renderer) << renderer.error().message;
    return *std::move(renderer);
}

void expect_the_devices_colours(const scene::Scene& scene, float rounding = k_rounding) {
    render::Renderer renderer = renderer_of(scene);
    renderer.draw(k_inputs);
    const image::Image drawn = renderer.read_floats(0);
    const auto function = PassFunction::create(scene, scene.passes[0]);
    ASSERT_TRUE(function) << function.error().message;
    const proof::TextureSet textures = textures_of(renderer, 0);
    proof::FloatEvaluator frame = function->frame(renderer, 0, k_inputs);
    frame.textures = proof::textures_in<proof::Point<float>>(textures);
    for (int y = 0; y < k_extent.height; ++y)
        for (int x = 0; x < k_extent.width; ++x) {
            proof::FloatEvaluator evaluator = frame;
            function->move_to(evaluator, {x, y});
            proof::Decisions none(0);
            ASSERT_EQ(evaluator.run(none, [](uint32_t) { return true; }), proof::Ended::left);
            const proof::Variable& color = *function->function().find("tidemark_color");
            const auto expected = render::floats_at(drawn, x, y);
            for (uint32_t i = 0; i < 3; ++i)
                ASSERT_NEAR(evaluator.memory()[color.first + i].real, expected[i],
                            rounding * std::max(1.0f, std::abs(expected[i])))
                    << "component " << i << " at " << x << ", " << y << " of\n"
                    << scene.passes[0].text.text();
        }
}

TEST(PassFunction, has_the_devices_colours) {
    for (const char* body : {
             "c = vec4(uv, sin(iTime) + cos(uv.x) + tan(uv.y) + atan(uv.x, uv.y - 0.5), 1.0);",
             "c = vec4(pow(uv.x, 1.7), exp(uv.y) + log(1.0 + uv.x), sqrt(uv.x) * inversesqrt(0.1 + uv.y), "
             "1.0);",
             "c = vec4(mod(p.x, 3.0) - fract(p.y * 0.3), sign(uv.x - 0.5) * floor(p.x / 3.0), ceil(uv.y * "
             "4.0), 1.0);",
             "c = vec4(mix(uv.x, uv.y, 0.3), smoothstep(0.2, 0.8, uv.x), step(0.4, uv.y) + clamp(p.x, 2.0, "
             "9.0), 1.0);",
             "vec3 a = vec3(uv, 0.4), b = vec3(0.2, uv.yx);\n"
             "c = vec4(cross(a, b) + reflect(a, normalize(b)) + dot(a, b) + length(a) - distance(a, b), "
             "1.0);",
             "c = vec4(refract(normalize(vec3(uv, -1.0)), vec3(0.0, 0.0, 1.0), 0.7)\n"
             "    + faceforward(vec3(uv, 1.0), vec3(0.1), vec3(uv.y - 0.5)), 1.0);",
             "mat2 m = mat2(uv.x, 0.3, -0.7, 1.0 + uv.y); mat3 n = mat3(1.0, uv.x, 0.2, 0.0, 2.0, uv.y, 0.5, "
             "0.1, 3.0);\n"
             "c = vec4(m * uv + uv * m, determinant(m), 1.0) + vec4(inverse(n) * vec3(uv, 1.0) + "
             "transpose(n)[1], 0.0);",
             "mat3x2 m = mat3x2(uv, uv.yx, 0.5, 0.25); c = vec4(m * vec3(1.0, 2.0, 3.0), (outerProduct(uv, "
             "uv.yx) * uv).x, 1.0);",
             "float a[5] = float[5](0.1, 0.2, 0.3, 0.4, 0.5); int i = int(p.x) % 5; a[i] += 1.0;\n"
             "c = vec4(a[i], a[(i + 2) % 5], a[4], 1.0);",
             "int n = int(p.x) - 7; uint u = uint(p.y) * 2654435761u;\n"
             "c = vec4(float(n / 3 + n % 4 + (n << 2) + abs(n)), float((u >> 16) ^ (u & 255u)) / 65536.0, "
             "float(~n | 3), 1.0);",
             "float sum = 0.0; for (int i = 0; i < 20; ++i) { if (i == int(p.x)) continue; if (sum > 3.0) "
             "break;\n"
             "sum += uv.y * float(i); } c = vec4(sum, 0.0, 0.0, 1.0);",
             "float v; switch (int(p.x) % 4) { case 0: v = 0.1; break; case 1: v = 0.2; case 2: v = 0.7; "
             "break;\n"
             "default: v = uv.y; } c = vec4(v, v > 0.5 ? uv : uv.yx, 1.0);",
             "vec4 v = vec4(uv, 0.3, 0.4); v.zx += 1.0; v[int(p.x) % 4] = 2.0; c = v.wzyx + v[int(p.y) % 4];",
             "c = vec4(lessThan(uv, vec2(0.5)), any(greaterThan(uv, vec2(0.9))), 1.0);",
             "c = vec4(uintBitsToFloat((floatBitsToUint(1.0 + uv.x) & 0x7ffffff0u)), round(uv.x * 5.0), "
             "trunc(p.y / 3.0), 1.0);",
             "float whole; float part = modf(p.x * 0.37, whole); c = vec4(part, whole, isnan(part) ? 1.0 : "
             "0.5, 1.0);",
             "c = vec4(sinh(uv.x), cosh(uv.y) - tanh(uv.x), asin(uv.x) + acos(uv.y), 1.0);",
             "c = texelFetch(iChannel0, ivec2(p) - 3, 1) + vec4(textureSize(iChannel0, 1), 0.0, 1.0);",
             "c = texelFetch(iChannel0, ivec2(p * 1.7), 0) + textureLod(iChannel0, (floor(p) + 0.5) / 256.0, "
             "0.0);",
             "c = vec4(iResolution.xy / 100.0, iTimeDelta + float(iFrame) + iDate.w / 1e5, 1.0) + iMouse / "
             "100.0;",
         })
        expect_the_devices_colours(image_of(body));
}

/// Within what weights of 8 bits make of texels that differ by 1.
TEST(PassFunction, filters_textures_as_the_device) {
    const scene::Scene scene =
        image_of("c = textureLod(iChannel0, p / 61.7, 0.0) + textureLod(iChannel0, uv * 0.31, 2.5)\n"
                 "    + textureGrad(iChannel0, uv, vec2(0.004, 0.0), vec2(0.0, 0.02));");
    expect_the_devices_colours(scene, 3.0f / 256);
}

TEST(PassFunction, evaluates_functions_structs_and_globals) {
    expect_the_devices_colours(
        scene_of("struct Hit { float t; vec3 n; };\n"
                 "const vec3 k_up[2] = vec3[2](vec3(0.0, 1.0, 0.0), vec3(1.0, 0.0, 0.0));\n"
                 "float count = 1.0;\n"
                 "bool find(inout float t, out Hit hit) {\n"
                 "    count += 1.0; hit.t = t; hit.n = k_up[int(t * 4.0) % 2]; t *= 2.0;\n"
                 "    if (t > 1.0) return true;\n    hit.n.z = count; return false; }\n"
                 "void mainImage(out vec4 c, in vec2 p) {\n"
                 "    float t = p.x / iResolution.x; Hit hit; bool found = find(t, hit);\n"
                 "    c = vec4(hit.n + hit.t, 1.0) * (found ? 1.0 : t) + count; }\n"));
}

RayCounts counts_of(const std::string& march) {
    const scene::Scene scene =
        scene_of("float map(vec3 p) { return length(p - vec3(0.0, 0.0, 4.0)) - 1.0; }\n"
                 "void mainImage(out vec4 c, in vec2 f) {\n"
                 "    vec3 rd = normalize(vec3(2.0 * f / iResolution.xy - 1.0, 2.0));\n"
                 "    float t = 0.0;\n" +
                 march + "\n    c = vec4(t); }\n");
    render::Renderer renderer = renderer_of(scene);
    const auto function = PassFunction::create(scene, scene.passes[0]);
    EXPECT_TRUE(function);
    RayCounts counts;
    proof::FloatEvaluator pixel = function->frame(renderer, 0, k_inputs);
    for (int y = 0; y < k_extent.height; ++y)
        for (int x = 0; x < k_extent.width; ++x) {
            function->move_to(pixel, {x, y});
            if (const auto ray = prove_ray(*function, pixel, {}, {x, y}, 2000))
                counts.add(*ray);
        }
    EXPECT_EQ(counts.rays, size_t(k_extent.width * k_extent.height));
    EXPECT_EQ(counts.contradicted, 0u);
    return counts;
}

TEST(ProvedHits, agree_with_a_correct_march_and_detect_wrong_marches) {
    const RayCounts right = counts_of(
        "for (int i = 0; i < 99; ++i) { float d = map(rd * t); if (d < 1e-3 || t > 9.0) break; t += d; }");
    EXPECT_GT(right.decided(), right.rays * 9 / 10);
    EXPECT_EQ(right.agree, right.decided());
    const RayCounts long_steps = counts_of("for (int i = 0; i < 99; ++i) { float d = map(rd * t); if (d < "
                                           "1e-3 || t > 9.0) break; t += max(d, 0.4); }");
    EXPECT_GT(long_steps.step_over, 0u);
    const RayCounts few_steps = counts_of(
        "for (int i = 0; i < 3; ++i) { float d = map(rd * t); if (d < 1e-3 || t > 9.0) break; t += d; }");
    EXPECT_GT(few_steps.miss, 0u);
    EXPECT_EQ(few_steps.went_past, 0u);
    EXPECT_FALSE(few_steps.steps_too_long());
    const RayCounts leaps = counts_of("for (int i = 0; i < 99; ++i) { float d = map(rd * t); if (d < 1e-3 || "
                                      "t > 9.0) break; t += 4.0 * d; }");
    EXPECT_GT(leaps.went_past, leaps.rays / 10);
    EXPECT_TRUE(leaps.steps_too_long());
}

TEST(ProvedHits, include_the_refinement_after_fixed_steps) {
    const std::string march =
        "float before = 0.0; for (; t < 9.0; t += 0.2) { if (map(rd * t) < 1e-3) break; "
        "before = t; }";
    const RayCounts late = counts_of(march);
    EXPECT_GT(late.step_over, late.rays / 10);
    EXPECT_EQ(late.within_last_step, late.step_over);
    const RayCounts back = counts_of(march + " t = 0.5 * (before + t);");
    EXPECT_EQ(back.step_over, 0u);
    EXPECT_EQ(back.rays, late.rays);
}

/// A surface of that height, which reads the noise texture.
RayCounts counts_over(const std::string& height) {
    const scene::Scene scene = scene_of(
        "float map(vec3 p) { return 0.4 * (4.0 - p.z - " + height +
        "); }\n"
        "void mainImage(out vec4 c, in vec2 f) {\n"
        "    vec3 rd = normalize(vec3(2.0 * f / iResolution.xy - 1.0, 2.0));\n    float t = 0.0;\n"
        "    for (int i = 0; i < 99; ++i) { float d = map(rd * t); if (d < 1e-3 || t > 9.0) break; t += d; "
        "}\n"
        "    c = vec4(t); }\n");
    render::Renderer renderer = renderer_of(scene);
    renderer.draw(k_inputs);
    const auto function = PassFunction::create(scene, scene.passes[0]);
    EXPECT_TRUE(function);
    const proof::TextureSet textures = textures_of(renderer, 0);
    proof::FloatEvaluator pixel = function->frame(renderer, 0, k_inputs);
    RayCounts counts;
    for (int y = 0; y < k_extent.height; ++y)
        for (int x = 0; x < k_extent.width; ++x) {
            function->move_to(pixel, {x, y});
            if (const auto ray = prove_ray(*function, pixel, textures, {x, y}, 2000))
                counts.add(*ray);
        }
    EXPECT_EQ(counts.agree, counts.decided());
    EXPECT_EQ(counts.contradicted, 0u);
    return counts;
}

/// Only the texels tell where the surface is.
TEST(ProvedHits, find_a_surface_stored_in_a_texture) {
    const RayCounts counts = counts_over("textureLod(iChannel0, p.xy / 64.0, 0.0).x");
    EXPECT_GT(counts.decided(), counts.rays * 95 / 100);
    EXPECT_EQ(counts.at_base_level, 0u);
}

/// Low waves are proved whatever mipmap the device chooses, high ones for the base level alone.
TEST(ProvedHits, hold_for_every_mipmap_level) {
    const RayCounts low = counts_over("0.002 * texture(iChannel0, p.xy / 64.0).x");
    EXPECT_GT(low.decided(), low.rays * 95 / 100);
    EXPECT_EQ(low.at_base_level, 0u);
    const RayCounts high = counts_over("texture(iChannel0, p.xy / 64.0).x");
    EXPECT_GT(high.decided(), high.rays * 95 / 100);
    EXPECT_GT(high.at_base_level, high.rays / 2);
}

TEST(PassFunction, errors_have_the_authors_lines) {
    const scene::Scene scene = scene_of("\nvoid mainImage(out vec4 c, in vec2 p) {\n    c = nothing;\n}\n");
    const auto refused = PassFunction::create(scene, scene.passes[0]);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "a.glsl:3: error: 'nothing' : undeclared identifier ");
}

} // namespace tidemark::lab::pass_function_gl_test
