// Properties of every scene of shaders/: each knob does something and breaks nothing, the picture does not
// jump as time goes on, and the code of features that are off is gone.
#include "base/tokens.hpp"
#include "media/image.hpp"
#include "scene/load_scene.hpp"
#include "scene/scene.hpp"
#include "shader/token_reading.hpp"
#include "waters.hpp"

#include <cmath>
#include <set>

namespace tidemark::render::shipped_scenes_gl_test {

using ShippedScenes = Waters;

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

TEST_F(ShippedScenes, EveryKnobChangesThePictureAndKeepsItFinite) {
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
        // Before the mouse is used and after, high and low, and with the host's camera moved; late enough for
        // periods to have passed.
        FrameInputs orbited = at(1234.5, 34, 11);
        orbited.orbit = {0.4, 0.1, 0.9, 1};
        std::vector<Look> looks;
        for (Renderer& drawing : drawings)
            for (const FrameInputs& inputs :
                 {at(1234.5, 0, 0), at(1234.5, 34, 11), at(1234.5, 20, 1), orbited})
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

TEST_F(ShippedScenes, ColoursAreNumbersBeforeTheyAreClamped) {
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

TEST_F(ShippedScenes, MotionIsContinuous) {
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

TEST_F(ShippedScenes, ViewsStraightDownAreFinite) {
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

/// At the limits of --camera, and with a pan that goes far out.
TEST_F(ShippedScenes, ViewsFromTheLimitsOfTheCameraAreFinite) {
    for (const fs::path& file : scene_files()) {
        const auto scene = scene::load_scene(file);
        ASSERT_TRUE(scene) << to_string(scene.error());
        Renderer drawing = renderer(*scene, {80, 45});
        for (const char* camera :
             {"210,89.9,10", "30,-89.9,10", "30,20,0.001", "30,20,1000000", "30,0,10,1000,500,-2000"}) {
            SCOPED_TRACE(file.string() + " " + camera);
            const auto parsed = parse_camera(camera);
            ASSERT_TRUE(parsed) << to_string(parsed.error());
            EXPECT_EQ(
                image::census(frame(drawing, inputs_of({.time = 2, .extent = {80, 45}, .camera = *parsed})))
                    .non_finite(),
                0U);
        }
    }
}

TEST_F(ShippedScenes, ThePseudo3dSeasNearEdgeIsIndependentOfTheSize) {
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
        const int pixels = extent.width / 8 * (extent.height / 9);
        for (double& block : blocks)
            block /= pixels;
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

TEST_F(ShippedScenes, DisabledFeaturesAreNotInTheProgram) {
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

TEST_F(ShippedScenes, ASceneContainsOnlyItsOwnSolver) {
    const std::pair<const char*, const char*> marks[] = {
        {"MARCH_SPHERE", "HIT_DISTANCE"},       {"MARCH_ENHANCED", "k_relaxation"},
        {"MARCH_CERTIFIED", "march_clearance"}, {"MARCH_BRACKET", "k_overshoot"},
        {"MARCH_SEGMENT", "march_fall"},        {"MARCH_FIXED", "FIXED_STEP"}};
    for (const auto& [solver, own] : marks) {
        auto scene = scene::load_scene(k_shaders / "water_surface.glsl");
        ASSERT_TRUE(scene);
        define(*scene, std::string("SOLVER=") + solver);
        const auto names = names_in(*scene);
        for (const auto& [other, mark] : marks)
            EXPECT_EQ(names.contains(mark), mark == own) << solver << ' ' << mark;
    }
}

} // namespace tidemark::render::shipped_scenes_gl_test
