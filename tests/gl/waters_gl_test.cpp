// The marched scenes of shaders/ against their references, and what every scene owes its user: knobs that do
// something and break nothing, features whose code is gone when they are off.
#include "base/file.hpp"
#include "gl_test.hpp"
#include "glsl/overrides.hpp"
#include "glsl/syntax/preprocess.hpp"
#include "image/census.hpp"
#include "image/files/picture_file.hpp"
#include "lab/fields/certified_march.hpp"
#include "lab/fields/knob_reader.hpp"
#include "lab/fields/reference.hpp"
#include "lab/fields/value_noise.hpp"
#include "text/tokens.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace tidemark::render {
namespace {

const fs::path k_shaders = fs::path(TIDEMARK_SOURCE_DIR) / "shaders";

struct Water {
    const char* scene;
    int octaves;
    double wrong; ///< share of pixels that may be wrong by more than a pixel and 0.1
};

constexpr Water k_waters[] = {
    {"water_surface", 7, 0.004}, {"gerstner_waves", 0, 0.006}, {"procedural_ocean", 3, 0.01}};

void define(scene::Scene& scene, const std::string& setting) {
    const auto done = glsl::override_definition(scene, setting);
    ASSERT_TRUE(done) << to_string(done.error());
}

class Waters : public RenderTest {
protected:
    /// A scene of shaders/ that runs `body` in the place of its mainImage.
    scene::Scene asked(const std::string& name, const std::string& body) const {
        auto text = read_file(k_shaders / (name + ".glsl"));
        EXPECT_TRUE(text);
        replace_all(*text, "\"lib/", "\"" + (k_shaders / "lib/").string());
        replace_all(*text, "\"../textures/", "\"" + (k_shaders / "../textures/").string());
        replace_all(*text, "void mainImage(", "void itsImage(");
        *text =
            "#define TIDEMARK_HIT 1\n" + *text + "\nvoid mainImage(out vec4 c, in vec2 p) {\n" + body + "}\n";
        auto scene = scene::load_scene(put(name + ".glsl", *text), {.media = {}, .allow_outside = true});
        EXPECT_TRUE(scene) << to_string(scene.error());
        return *std::move(scene);
    }
    static void replace_all(std::string& text, const std::string& from, const std::string& to) {
        for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
            text.replace(at, from.size(), to);
    }
    static lab::Reference reference(const scene::Scene& scene, const Water& water, const FrameInputs& inputs,
                                    Extent extent, lab::Lattice3 lattice = lab::IntegerLattice{}) {
        const auto made = lab::find_reference(water.scene)({.knobs = scene.knobs,
                                                            .time = inputs.time,
                                                            .resolution = {extent.width, extent.height},
                                                            .mouse = {inputs.mouse.x, inputs.mouse.y},
                                                            .octaves = water.octaves,
                                                            .lattice = std::move(lattice)});
        EXPECT_TRUE(made) << to_string(made.error());
        return *made;
    }
    static FrameInputs at(double time, float mouse_x, float mouse_y) {
        FrameInputs inputs;
        inputs.time = time;
        inputs.mouse = {mouse_x, mouse_y, 0, 0};
        return inputs;
    }
};

constexpr Extent k_small{64, 36};

/// What march_field is of the reference's value at this place of the ray.
double scaled(const Water& water, const lab::Reference& reference, const scene::Scene& scene,
              const lab::Ray& ray, double t) {
    if (std::string_view(water.scene) == "gerstner_waves") // over the bound of its slope
        return reference.field.sample(ray.at(t), ray.direction).clearance;
    const auto step_scale = std::ranges::find(scene.knobs, "step_scale", &scene::Knob::name);
    return float(step_scale->value[0]) * reference.field.value(ray.at(t));
}

TEST_F(Waters, FieldsAreThoseOfTheReferencesAtAnyTime) {
    for (const Water& water : k_waters) {
        const scene::Scene scene = asked(
            water.scene, "look(p); c = vec4(march_field(1.0), march_field(9.0), march_field(40.0), 1.0);");
        Renderer drawing = renderer(scene, k_small);
        for (const double time : {0.0, 10.0, 1000.1, 100000.1, 1000000.3}) {
            const FrameInputs inputs = at(time, 30, 15);
            const image::Image image = frame(drawing, inputs);
            const lab::Reference truth = reference(scene, water, inputs, k_small);
            double worst = 0;
            for (int y = 0; y < k_small.height; y += 3)
                for (int x = 0; x < k_small.width; x += 3) {
                    const lab::Ray ray = truth.ray({x + 0.5, y + 0.5});
                    const Floats4 found = floats_at(image, x, y);
                    size_t i = 0;
                    for (const double t : {1.0, 9.0, 40.0})
                        worst = std::max(worst, std::abs(found[i++] - scaled(water, truth, scene, ray, t)));
                }
            EXPECT_LT(worst, 3e-5) << water.scene << " at " << time;
        }
    }
}

/// What stylized_waves computes at a place, from what is baked there: its formulas in double.
struct StylizedWave {
    double phase = 0, mask = 0, height = 0;
};
StylizedWave stylized_wave(const scene::Scene& scene, const image::Image& ramps, const glm::dvec4& baked,
                           const glm::dvec2& at, double time) {
    lab::KnobReader knobs(scene.knobs);
    const auto smoothstep = [](double low, double high, double x) {
        const double s = std::clamp((x - low) / (high - low), 0.0, 1.0);
        return s * s * (3.0 - 2.0 * s);
    };
    constexpr double k_circle = 30.0;
    const double bent =
        knobs.number("bend") * (lab::value_noise(lab::IntegerLattice{}, 0.13 * at + 7.3) - 0.5);
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

TEST_F(Waters, StylizedWavesAreTheirFormulasInDouble) {
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

TEST_F(Waters, SineHashIsTheReferencesOnTheDevicesOwnLattice) {
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
    lab::SineLattice lattice{-262144, std::vector<float>(1024 * 512)};
    for (size_t i = 0; i < lattice.values.size(); ++i)
        lattice.values[i] = values.f32()[4 * i];

    scene::Scene scene =
        asked(water.scene, "look(p); c = vec4(march_field(1.0), march_field(9.0), march_field(20.0), 1.0);");
    define(scene, "INTEGER_HASH=0");
    Renderer drawing = renderer(scene, k_small);
    const FrameInputs inputs = at(10, 30, 15);
    const image::Image image = frame(drawing, inputs);
    const lab::Reference truth = reference(scene, water, inputs, k_small, lattice);
    double worst = 0;
    for (int y = 0; y < k_small.height; y += 3)
        for (int x = 0; x < k_small.width; x += 3) {
            const lab::Ray ray = truth.ray({x + 0.5, y + 0.5});
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

Judged judge(const image::Image& image, const lab::Reference& truth) {
    std::vector<double> errors;
    Judged judged;
    int wrong = 0;
    for (int y = 0; y < k_small.height; ++y)
        for (int x = 0; x < k_small.width; ++x) {
            const double found = floats_at(image, x, y)[0];
            const double t =
                lab::certified_march(truth.field, truth.ray({x + 0.5, y + 0.5}), truth.range).distance;
            judged.hits += t >= 0;
            if ((t < 0) != (found < 0))
                ++wrong;
            else if (t >= 0) {
                errors.push_back(std::abs(found - t));
                wrong += errors.back() > 0.1 + t / k_small.height;
            }
        }
    judged.wrong = double(wrong) / (k_small.width * k_small.height);
    if (!errors.empty()) {
        std::ranges::nth_element(errors, errors.begin() + long(errors.size() / 2));
        judged.median = errors[errors.size() / 2];
    }
    return judged;
}

TEST_F(Waters, DefaultSolversMeetTheWaterWhereACertifiedMarchDoes) {
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
        {"MARCH_CERTIFIED", 0.004, 2e-3}, {"MARCH_BRACKET", 0.004, 3e-5}, {"MARCH_FIXED", 0.02, 3e-5}};
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

TEST_F(Waters, NewtonLeavesNothingOfTheMovement) {
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

/// Every scene file of shaders/.
std::vector<fs::path> scene_files() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(k_shaders))
        if (entry.path().extension() == ".glsl")
            files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

/// Knob `i` at a part of its range; a colour's is black to white.
std::vector<scene::Knob> with_knob_at(std::vector<scene::Knob> knobs, size_t i, double part) {
    const auto range = knobs[i].range.value_or(scene::KnobRange{{0, 0, 0, 0}, {1, 1, 1, 1}});
    for (size_t k = 0; k < 4; ++k)
        knobs[i].value[k] = range.low[k] + part * (range.high[k] - range.low[k]);
    return knobs;
}

/// A way to look at a scene: its program, an instant and a mouse, and what is seen before a knob is turned.
struct Look {
    Renderer* drawing;
    FrameInputs inputs;
    image::Image before;
};

/// Whether a knob at this value changes anything; no sample may be other than a number.
bool changes_something(std::vector<Look>& looks, const std::vector<scene::Knob>& knobs) {
    bool changes = false;
    for (Look& look : looks) {
        look.drawing->turn(knobs);
        look.drawing->draw(look.inputs);
        const image::Image after = look.drawing->read_back();
        EXPECT_EQ(image::census(after).non_finite(), 0U);
        changes |= !std::ranges::equal(after.f32(), look.before.f32());
    }
    return changes;
}

TEST_F(Waters, EveryKnobChangesThePictureAndNeverBreaksIt) {
    const auto files = scene_files();
    ASSERT_GE(files.size(), 4U);
    for (const fs::path& file : files) {
        auto scene = scene::load_scene(file);
        ASSERT_TRUE(scene) << to_string(scene.error());
        std::vector<Renderer> drawings;
        drawings.push_back(renderer(*scene, {48, 27}));
        if (scene->image().text.text().find("#define TOP_VIEW") != std::string::npos) {
            define(*scene, "TOP_VIEW=1"); // has knobs of its own
            drawings.push_back(renderer(*scene, {48, 27}));
        }
        // Before the mouse is used and after, high and low; late enough for periods to have passed.
        std::vector<Look> looks;
        for (Renderer& drawing : drawings)
            for (const FrameInputs& inputs : {at(1234.5, 0, 0), at(1234.5, 34, 11), at(1234.5, 20, 1)})
                looks.push_back({&drawing, inputs, frame(drawing, inputs)});
        for (size_t i = 0; i < scene->knobs.size(); ++i) {
            bool changes = false;
            for (const double part : {0.0, 0.5, 1.0}) {
                const std::vector<scene::Knob> turned = with_knob_at(scene->knobs, i, part);
                SCOPED_TRACE(fmt::format("{}: {} = {}", file.string(), turned[i].name, to_string(turned[i])));
                changes |= changes_something(looks, turned);
            }
            EXPECT_TRUE(changes) << file << ": turning '" << scene->knobs[i].name << "' changes nothing";
        }
    }
}

TEST_F(Waters, ColoursAreNumbersBeforeTheyAreClamped) {
    const std::pair<const char*, const char*> scenes[] = {
        {"water_surface", "shade(t, position, ripples_at(position))"},
        {"gerstner_waves", "surface(t, position)"},
        {"procedural_ocean", "surface(t, position)"}};
    for (const auto& [name, color] : scenes) {
        const scene::Scene scene =
            asked(name, fmt::format("float t = look(p); vec3 position = ray_origin + t * ray_direction;\n"
                                    "c.rgb = t < 0.0 ? vec3(0.5) : {};\n",
                                    color));
        Renderer drawing = renderer(scene, {48, 27});
        for (size_t i = 0; i < scene.knobs.size(); ++i)
            for (const double part : {0.0, 1.0}) {
                drawing.turn(with_knob_at(scene.knobs, i, part));
                const image::Image image = frame(drawing, at(3, 30, 12));
                EXPECT_EQ(image::census(image).non_finite(), 0U)
                    << name << ' ' << scene.knobs[i].name << ' ' << part;
            }
    }
}

TEST_F(Waters, NothingJumpsAsTimeGoesOn) {
    for (const fs::path& file : scene_files()) {
        auto scene = scene::load_scene(file);
        ASSERT_TRUE(scene);
        Renderer drawing = renderer(*scene, k_small);
        const auto step = [&](double time) {
            const image::Image one = frame(drawing, at(time, 34, 11)),
                               next = frame(drawing, at(time + 1.0 / 60, 34, 11));
            double sum = 0;
            for (size_t i = 0; i < one.f32().size(); ++i)
                sum += std::pow(double(one.f32()[i]) - double(next.f32()[i]), 2);
            return std::sqrt(sum / double(one.f32().size()));
        };
        // The document of water_surface starts its drift again after 62.83 s, for one.
        for (const double cut : {62.83, 125.66, 400.0}) {
            const double beside = std::max(step(cut - 3.0 / 120), step(cut + 1.0 / 120));
            EXPECT_LT(step(cut - 1.0 / 120), 1.5 * beside) << file << " at " << cut;
        }
        // And there is movement still after three days, when iTime itself goes in steps of 1/32 s.
        const double usual = std::max(step(61), step(64));
        const double late = step(262144);
        EXPECT_LT(late, 2.5 * usual) << file;
        EXPECT_GT(late, 0.3 * usual) << file;
    }
}

TEST_F(Waters, StraightDownIsALookToo) {
    for (const Water& water : k_waters) {
        scene::Scene scene = asked(
            water.scene, "look(p); c.rgb = vec3(length(ray_direction), ray_direction.y, march_field(0.0));");
        ASSERT_TRUE(scene::override_knob(scene, "pitch_range=3.14159265"));
        Renderer drawing = renderer(scene, k_small);
        const image::Image image = frame(drawing, at(3, 32, 0));
        EXPECT_EQ(image::census(image).non_finite(), 0U);
        for (int x = 0; x < k_small.width; ++x)
            EXPECT_NEAR(floats_at(image, x, 18)[0], 1, 1e-6);
        EXPECT_NEAR(floats_at(image, 32, 18)[1], -1, 1e-3);
    }
}

TEST_F(Waters, ThePseudo3dSeasNearEdgeIsTheSameAtEverySize) {
    auto scene = scene::load_scene(k_shaders / "pseudo3d_water.glsl");
    ASSERT_TRUE(scene);
    const auto near_edge = [&](Extent extent) {
        Renderer drawing = renderer(*scene, extent);
        const image::Image image = frame(drawing, at(5, 0, 0));
        // Eight blocks along the lowest ninth of the picture.
        std::array<double, 8> blocks{};
        for (int y = 0; y < extent.height / 9; ++y)
            for (int x = 0; x < extent.width; ++x)
                blocks[size_t(8 * x / extent.width)] += double(floats_at(image, x, y)[1]);
        for (double& block : blocks)
            block /= double(extent.width / 8 * (extent.height / 9));
        return blocks;
    };
    const auto small = near_edge({128, 72}), large = near_edge({640, 360});
    for (size_t i = 0; i < small.size(); ++i)
        EXPECT_NEAR(small[i], large[i], 0.02) << i;
}

/// The names in the code that is compiled.
std::set<std::string, std::less<>> names_in(const scene::Scene& scene) {
    const std::string text = scene.image().text.text();
    const auto tokens = text::tokenize(text);
    std::set<std::string, std::less<>> names;
    for (const size_t i : glsl::preprocess(tokens).code)
        names.emplace(tokens[i].text);
    return names;
}

TEST_F(Waters, WhatIsOffIsGone) {
    const std::tuple<const char*, const char*, const char*, const char*> features[] = {
        {"gerstner_waves", "FOAM", "foam_picture", "foam_gain"},
        {"gerstner_waves", "REFLECTION", "", "fresnel_exponent"},
        {"gerstner_waves", "FOG", "", "fog_density"},
        {"gerstner_waves", "CLOUDS", "", "cloud_amount"},
        {"procedural_ocean", "FOAM", "crest", "foam_threshold"},
        {"procedural_ocean", "REFLECTION", "", "fresnel_power"},
        {"procedural_ocean", "FOG", "", "fog_density"},
        {"procedural_ocean", "CLOUDS", "", "cloud_amount"},
    };
    for (const auto& [name, feature, function, knob] : features) {
        for (const bool on : {true, false}) {
            auto scene = scene::load_scene(k_shaders / (std::string(name) + ".glsl"));
            ASSERT_TRUE(scene);
            define(*scene, fmt::format("{}={}", feature, on ? 1 : 0));
            if (*function) {
                EXPECT_EQ(names_in(*scene).contains(function), on) << name << ' ' << feature;
            }
            const Renderer drawing = renderer(*scene, {8, 8});
            EXPECT_EQ(drawing.program(0).reflection().has(knob), on) << name << ' ' << feature << ' ' << knob;
        }
    }
}

TEST_F(Waters, ASceneCarriesItsOwnSolverAlone) {
    const std::pair<const char*, const char*> marks[] = {{"MARCH_SPHERE", "HIT_DISTANCE"},
                                                         {"MARCH_ENHANCED", "k_relaxation"},
                                                         {"MARCH_CERTIFIED", "march_clearance"},
                                                         {"MARCH_BRACKET", "k_overshoot"},
                                                         {"MARCH_FIXED", "FIXED_STEP"}};
    for (const auto& [solver, own] : marks) {
        auto scene = scene::load_scene(k_shaders / "water_surface.glsl");
        ASSERT_TRUE(scene);
        define(*scene, std::string("SOLVER=") + solver);
        const auto names = names_in(*scene);
        for (const auto& [other, mark] : marks)
            EXPECT_EQ(names.contains(mark), mark == own) << solver << ' ' << mark;
    }
}

} // namespace
} // namespace tidemark::render
