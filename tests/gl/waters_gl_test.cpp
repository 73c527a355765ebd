// The scenes of shaders/ against their mathematics in double: fields, hits of every solver, Newton's steps.
#include "base/measurement.hpp"
#include "fields/certified_march.hpp"
#include "fields/knob_reader.hpp"
#include "fields/value_noise.hpp"
#include "media/picture_file.hpp"
#include "scene/load_scene.hpp"
#include "scene/scene.hpp"
#include "waters.hpp"

#include <cmath>

namespace tidemark::render::waters_gl_test {

/// Returns march_field as a fraction of the reference's value at this place of the ray.
double scaled(const Water& water, const fields::Reference& reference, const scene::Scene& scene,
              const fields::Ray& ray, double t) {
    if (std::string_view(water.scene) == "gerstner_waves") // over the bound of its slope
        return reference.field.sample(ray.at(t), ray.direction).clearance;
    const auto step_scale = std::ranges::find(scene.knobs, "step_scale", &scene::Knob::name);
    return float(step_scale->value[0]) * reference.field.value(ray.at(t));
}

TEST_F(Waters, FieldsEqualTheReferencesAtAnyTime) {
    for (const Water& water : k_waters) {
        const scene::Scene scene = asked(
            water.scene, "look(p); c = vec4(march_field(1.0), march_field(9.0), march_field(40.0), 1.0);");
        Renderer drawing = renderer(scene, k_small);
        for (const double time : {0.0, 10.0, 1000.1, 100000.1, 1000000.3}) {
            const FrameInputs inputs = at(time, 30, 15);
            const image::Image image = frame(drawing, inputs);
            const fields::Reference truth = reference(scene, water, inputs, k_small);
            double worst = 0;
            for (int y = 0; y < k_small.height; y += 3)
                for (int x = 0; x < k_small.width; x += 3) {
                    const fields::Ray ray = truth.ray({x + 0.5, y + 0.5});
                    const Floats4 found = floats_at(image, x, y);
                    size_t i = 0;
                    for (const double t : {1.0, 9.0, 40.0})
                        worst = std::max(worst, std::abs(found[i++] - scaled(water, truth, scene, ray, t)));
                }
            EXPECT_LT(worst, 3e-5) << water.scene << " at " << time;
        }
    }
}

/// The wave of stylized_waves at a place, computed from the baked texture with its formulas in double.
struct StylizedWave {
    double phase = 0, mask = 0, height = 0;
};
StylizedWave stylized_wave(const scene::Scene& scene, const image::Image& ramps, const glm::dvec4& baked,
                           const glm::dvec2& at, double time) {
    fields::KnobReader knobs(scene.knobs);
    const auto smoothstep = [](double low, double high, double x) {
        const double s = std::clamp((x - low) / (high - low), 0.0, 1.0);
        return s * s * (3.0 - 2.0 * s);
    };
    constexpr double k_circle = 30.0;
    const double bent =
        knobs.number("bend") * (fields::value_noise(fields::IntegerLattice{}, 0.13 * at + 7.3) - 0.5);
    const double path = baked.x - knobs.number("coast_delay") * std::exp(-0.8 * baked.z);
    const double turns = path / knobs.number("wave_length") + time / knobs.number("wave_speed") + bent;
    StylizedWave wave;
    wave.phase = turns - std::floor(turns);
    const double grown = smoothstep(knobs.number("shallow_water"), knobs.number("deep_water"), baked.z);
    wave.mask = std::clamp(baked.y, 0.0, 1.0) * glm::mix(1.0, knobs.number("offshore_height"), grown) *
                glm::mix(1.0, knobs.number("swash"), smoothstep(-0.9, 0.15, baked.w)) *
                (1.0 - smoothstep(k_circle, 2.5 * k_circle, glm::length(at)));
    const double column = wave.phase * ramps.extent.width - 0.5;
    const auto ramp = [&](double i) {
        const int wrapped = (int(i) + ramps.extent.width) % ramps.extent.width;
        return double(ramps.f32()[size_t(wrapped) * size_t(ramps.channels)]);
    };
    const double first = std::floor(column);
    wave.height =
        knobs.number("wave_height") * wave.mask * glm::mix(ramp(first), ramp(first + 1), column - first);
    return wave;
}

TEST_F(Waters, StylizedWavesMatchTheirFormulasInDouble) {
    const scene::Scene scene =
        asked("stylized_waves", "vec2 at = 1.25 * (p - vec2(32.0, 18.0));\n"
                                "vec4 field = vec4(0.375 * p.x, 0.03125 * p.y, 0.125 * p.x, "
                                "0.5 - 0.0625 * p.y);\n"
                                "turns = fract_of_product(1.0 / wave_speed, seconds());\n"
                                "c = vec4(phase_of(field, at), wave_mask(field, at), "
                                "water_height(field, at), 1.0);");
    const auto ramps = image::read_picture(k_shaders / "../textures/wave_ramps.png");
    ASSERT_TRUE(ramps) << to_string(ramps.error());
    Renderer drawing = renderer(scene, k_small);
    for (const double time : {0.0, 10.0, 1000.1, 1000000.3}) {
        const image::Image image = frame(drawing, at(time, 0, 0));
        double phase = 0, mask = 0, height = 0;
        for (int y = 0; y < k_small.height; ++y)
            for (int x = 0; x < k_small.width; ++x) {
                const glm::dvec2 p(x + 0.5, y + 0.5);
                const StylizedWave truth = stylized_wave(
                    scene, *ramps, {0.375 * p.x, 0.03125 * p.y, 0.125 * p.x, 0.5 - 0.0625 * p.y},
                    1.25 * (p - glm::dvec2(32, 18)), time);
                const Floats4 found = floats_at(image, x, y);
                phase = std::max(phase, 0.5 - std::abs(std::abs(found[0] - truth.phase) - 0.5));
                mask = std::max(mask, std::abs(found[1] - truth.mask));
                height = std::max(height, std::abs(found[2] - truth.height));
            }
        EXPECT_LT(phase, 3e-6) << "at " << time;
        EXPECT_LT(mask, 1e-6) << "at " << time;
        EXPECT_LT(height, 3e-4) << "at " << time;
    }
}

TEST_F(Waters, SineHashEqualsTheReferenceOnTheDevicesLattice) {
    const Water& water = k_waters[0];
    const std::string hash = (k_shaders / "lib/hash.glsl").string();
    const auto lattice_scene = scene::load_scene(
        put("lattice.glsl", "#define INTEGER_HASH 0\n#include \"" + hash +
                                "\"\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                                "c = scatter(vec4(floor(p.x) + 1024.0 * floor(p.y) - 262144.0)); }\n"),
        {.media = {}, .allow_outside = true});
    ASSERT_TRUE(lattice_scene);
    Renderer lattice_drawing = renderer(*lattice_scene, {1024, 512});
    const image::Image values = frame(lattice_drawing);
    fields::SineLattice lattice{-262144, std::vector<float>(1024 * 512)};
    for (size_t i = 0; i < lattice.values.size(); ++i)
        lattice.values[i] = values.f32()[4 * i];

    scene::Scene scene =
        asked(water.scene, "look(p); c = vec4(march_field(1.0), march_field(9.0), march_field(20.0), 1.0);");
    define(scene, "INTEGER_HASH=0");
    Renderer drawing = renderer(scene, k_small);
    const FrameInputs inputs = at(10, 30, 15);
    const image::Image image = frame(drawing, inputs);
    const fields::Reference truth = reference(scene, water, inputs, k_small, lattice);
    double worst = 0;
    for (int y = 0; y < k_small.height; y += 3)
        for (int x = 0; x < k_small.width; x += 3) {
            const fields::Ray ray = truth.ray({x + 0.5, y + 0.5});
            size_t i = 0;
            for (const double t : {1.0, 9.0, 20.0})
                worst = std::max(worst,
                                 std::abs(floats_at(image, x, y)[i++] - scaled(water, truth, scene, ray, t)));
        }
    EXPECT_LT(worst, 3e-5);
}

struct Judged {
    int hits = 0;
    double wrong = 0;  ///< share of the pixels: another surface, or a miss
    double median = 0; ///< error of distance where both hit
};

Judged judge(const image::Image& image, const fields::Reference& truth) {
    std::vector<double> errors;
    Judged judged;
    int wrong = 0;
    for (int y = 0; y < k_small.height; ++y)
        for (int x = 0; x < k_small.width; ++x) {
            const double found = floats_at(image, x, y)[0];
            const double t =
                fields::certified_march(truth.field, truth.ray({x + 0.5, y + 0.5}), truth.range).distance;
            judged.hits += t >= 0;
            if ((t < 0) != (found < 0))
                ++wrong;
            else if (t >= 0) {
                errors.push_back(std::abs(found - t));
                wrong += errors.back() > 0.1 + t / k_small.height;
            }
        }
    judged.wrong = double(wrong) / (k_small.width * k_small.height);
    judged.median = lab::median(std::move(errors));
    return judged;
}

TEST_F(Waters, DefaultSolversHitWhereACertifiedMarchHits) {
    for (const Water& water : k_waters) {
        const scene::Scene scene = asked(water.scene, "mainHit(c, p);");
        Renderer drawing = renderer(scene, k_small);
        for (const FrameInputs& inputs : {at(10, 0, 0), at(1, 32, 19), at(60, 48, 14)}) {
            const Judged judged = judge(frame(drawing, inputs), reference(scene, water, inputs, k_small));
            EXPECT_LE(judged.wrong, water.wrong) << water.scene << " at " << inputs.time;
            EXPECT_LT(judged.median, 1e-4) << water.scene << " at " << inputs.time;
            EXPECT_GT(judged.hits, 100);
        }
    }
}

TEST_F(Waters, EverySolverFindsTheSameWater) {
    const Water& water = k_waters[0];
    const FrameInputs inputs = at(10, 48, 14);
    // Safe ones and ones that are not: what they may get wrong, and how near they come.
    const std::tuple<const char*, double, double> solvers[] = {
        {"MARCH_SPHERE", 0.01, 1e-3},     {"MARCH_ENHANCED", 0.01, 2e-3}, {"MARCH_AUTO", 0.01, 2e-3},
        {"MARCH_CERTIFIED", 0.001, 3e-5}, {"MARCH_BRACKET", 0.004, 3e-5}, {"MARCH_FIXED", 0.02, 3e-5},
        {"MARCH_SEGMENT", 0.004, 2e-3}};
    for (const auto& [solver, wrong, median] : solvers) {
        scene::Scene scene = asked(water.scene, "mainHit(c, p);");
        define(scene, std::string("SOLVER=") + solver);
        define(scene, "MAX_STEPS=2048");
        ASSERT_TRUE(scene::override_knob(scene, "step_scale=0.5"));
        Renderer drawing = renderer(scene, k_small);
        const Judged judged = judge(frame(drawing, inputs), reference(scene, water, inputs, k_small));
        EXPECT_LE(judged.wrong, wrong) << solver;
        EXPECT_LT(judged.median, median) << solver;
    }
}

TEST_F(Waters, CertifiedStepsNeverEndBelowTheSurface) {
    for (const Water& water : k_waters) {
        scene::Scene scene = asked(water.scene, "mainHit(c, p); c.g = c.b;");
        define(scene, "SOLVER=MARCH_CERTIFIED");
        define(scene, "MAX_STEPS=4096");
        Renderer drawing = renderer(scene, k_small);
        const image::Image image = frame(drawing, at(10, 48, 16));
        for (int y = 0; y < k_small.height; ++y)
            for (int x = 0; x < k_small.width; ++x)
                ASSERT_GE(floats_at(image, x, y)[1], -2e-5) << water.scene << ' ' << x << ' ' << y;
    }
}

/// Over all pixels and 24 places of each ray: the least that the field has above what a solver's own proof
/// says, which sets `reach`, how far it goes, and gives the line above which the field is to be.
constexpr const char* k_proof = R"(
    look(p);
    float least = 1.0, longest = 0.0;
    for (int i = 0; i < 24; i++) {{
        float t = 0.5 + 1.7 * float(i), reach = 0.37 * float(1 + i % 7);
        {}
        for (int k = 1; k <= 16; k++) {{
            float ahead = min(reach, 20.0) * float(k) / 16.0;
            least = min(least, march_field(t + ahead) - ({}));
        }}
        longest = max(longest, reach);
    }}
    c = vec4(least, longest, 0.0, 1.0);
)";

TEST_F(Waters, ProvedSolversKeepTheirBound) {
    const auto proved = [&](const char* solver, const char* bend, const char* asks, const char* line) {
        scene::Scene scene = asked("water_surface", fmt::format(k_proof, asks, line));
        define(scene, std::string("SOLVER=") + solver);
        define(scene, std::string("BEND_SCALE=") + bend);
        Renderer drawing = renderer(scene, k_small);
        float least = 1.0F, longest = 0.0F;
        for (const FrameInputs& inputs : {at(10, 48, 14), at(1, 32, 19)}) {
            const image::Image image = frame(drawing, inputs);
            for (int y = 0; y < k_small.height; ++y)
                for (int x = 0; x < k_small.width; ++x) {
                    least = std::min(least, floats_at(image, x, y)[0]);
                    longest = std::max(longest, floats_at(image, x, y)[1]);
                }
        }
        EXPECT_GT(longest, 1.0F) << solver;
        return least;
    };
    const char* const clearance = "reach = march_clearance(t).y;";
    const char* const surface = "min(march_field(t), 0.0)"; // below it nothing is proved
    EXPECT_GE(proved("MARCH_CERTIFIED", "1.0", clearance, surface), -2e-5F);
    EXPECT_LT(proved("MARCH_CERTIFIED", "0.05", clearance, surface), -0.1F); // a proof can fail
    const char* const fall = "vec2 fall = march_fall(t, reach);";
    EXPECT_GE(proved("MARCH_SEGMENT", "1.0", fall, "fall.x - fall.y * ahead"), -2e-5F);
    EXPECT_LT(proved("MARCH_SEGMENT", "1.0", fall, "fall.x - 0.3 * fall.y * ahead"), -0.1F);
}

/// A ray that leaves is sampled once more before the document's loop sees that it is too far.
TEST_F(Waters, TheDocumentedSolverTakesTheDocumentedSamples) {
    scene::Scene scene = asked("water_surface", R"(
    float own = look(p), samples = march_samples, value, t = 0.1, counted = 0.0;
    for (int i = 0; i < 128; i++) {
        value = march_field(t);
        counted += 1.0;
        if (value < 0.0001 || t > 43.0) break;
        t += value;
    }
    float met = t > 43.0 ? -1.0 : t;
    c = vec4(samples, counted, own == met ? met : 1e6, 1.0);
)");
    define(scene, "DOCUMENT=1");
    Renderer drawing = renderer(scene, k_small);
    const image::Image image = frame(drawing, at(10, 48, 14.4F));
    int misses = 0;
    for (int y = 0; y < k_small.height; ++y)
        for (int x = 0; x < k_small.width; ++x) {
            const auto pixel = floats_at(image, x, y);
            ASSERT_EQ(pixel[0], pixel[1]) << x << ' ' << y;
            ASSERT_LT(pixel[2], 1e6F) << x << ' ' << y;
            misses += pixel[2] < 0;
        }
    EXPECT_GT(misses, 100);
}

TEST_F(Waters, NewtonInvertsTheMovement) {
    scene::Scene scene =
        asked("gerstner_waves", "make_waves(); vec2 place = 0.8 * p - 20.0; vec2 rest = unmoved(place);\n"
                                "vec4 along = train_a * cos(angles(rest));\n"
                                "c.rg = rest + vec2(dot(train_x, along), dot(train_z, along)) - place;\n");
    // Steepest at a range's end too: what adds up to more than 0.95 is lowered to it.
    for (const auto& [scale, steps, most] : {std::tuple{"wave_scale=0.5", "NEWTON_STEPS=4", 2e-5},
                                             std::tuple{"wave_scale=2", "NEWTON_STEPS=8", 2e-3}}) {
        define(scene, steps);
        ASSERT_TRUE(scene::override_knob(scene, scale));
        Renderer drawing = renderer(scene, k_small);
        const image::Image image = frame(drawing, at(12345.5, 0, 0));
        double worst = 0;
        for (int y = 0; y < k_small.height; ++y)
            for (int x = 0; x < k_small.width; ++x)
                worst = std::max({worst, std::abs(double(floats_at(image, x, y)[0])),
                                  std::abs(double(floats_at(image, x, y)[1]))});
        EXPECT_LT(worst, most) << scale;
    }
}

} // namespace tidemark::render::waters_gl_test
