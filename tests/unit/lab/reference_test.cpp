// Which text a reference applies to: the one that it was written for, under any name, and no edit of it.
#include "base/file.hpp"
#include "glsl/overrides.hpp"
#include "lab/fields/field_text.hpp"
#include "lab/fields/gerstner_waves_field.hpp"
#include "lab/fields/procedural_ocean_field.hpp"
#include "lab/fields/reference.hpp"
#include "lab/fields/water_surface_field.hpp"
#include "scene/load_scene.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace tidemark::lab {
namespace {

namespace fs = std::filesystem;

const fs::path k_shaders = fs::path(TIDEMARK_SOURCE_DIR) / "shaders";

scene::Scene loaded(const fs::path& file, const std::vector<std::string>& definitions = {}) {
    auto scene = scene::load_scene(file, {.media = {}, .allow_outside = true});
    EXPECT_TRUE(scene) << to_string(scene.error());
    for (const std::string& definition : definitions) {
        const auto done = glsl::override_definition(*scene, definition);
        EXPECT_TRUE(done) << to_string(done.error());
    }
    return *std::move(scene);
}

std::string hash_of(const scene::Scene& scene) {
    const auto hash = field_hash(scene);
    return hash ? *hash : to_string(hash.error());
}

TEST(Reference, IsBoundToTheTextsOfOurScenes) {
    struct Case {
        const char* scene;
        std::vector<std::string> definitions;
        MakeReference make;
        bool sine = false, poles = false, wraps = false;
    };
    const Case cases[] = {
        {"water_surface", {}, water_surface_reference},
        {"water_surface", {"TURNING_POLES=1"}, water_surface_reference, false, true},
        {"water_surface", {"INTEGER_HASH=0"}, water_surface_reference, true, false},
        {"water_surface", {"INTEGER_HASH=0", "TURNING_POLES=1"}, water_surface_reference, true, true},
        {"water_surface",
         {"DOCUMENT=1", "INTEGER_HASH=1", "TURNING_POLES=0"},
         water_surface_reference,
         false,
         false,
         true},
        {"water_surface", {"DOCUMENT=1", "INTEGER_HASH=1"}, water_surface_reference, false, true, true},
        {"water_surface", {"DOCUMENT=1", "TURNING_POLES=0"}, water_surface_reference, true, false, true},
        {"water_surface", {"DOCUMENT=1"}, water_surface_reference, true, true, true},
        {"gerstner_waves", {}, gerstner_waves_reference},
        {"procedural_ocean", {}, procedural_ocean_reference},
    };
    for (const Case& c : cases) {
        const scene::Scene scene = loaded(k_shaders / (std::string(c.scene) + ".glsl"), c.definitions);
        SCOPED_TRACE(testing::Message() << c.scene << ' ' << testing::PrintToString(c.definitions)
                                        << ": its text has the hash " << hash_of(scene)
                                        << "; read it against its reference before you put that into "
                                           "runner/lab/fields/reference.cpp");
        const auto found = find_reference(scene);
        EXPECT_TRUE(found);
        if (!found)
            continue;
        EXPECT_EQ(found->make, c.make);
        EXPECT_EQ(found->sine_lattice, c.sine);
        EXPECT_EQ(found->turning_poles, c.poles);
        EXPECT_EQ(found->drift_wraps, c.wraps);
    }
}

TEST(Reference, IsTheSameForEverySolverAndLight) {
    const scene::Scene plain = loaded(k_shaders / "water_surface.glsl");
    for (const char* definition :
         {"SOLVER=MARCH_SPHERE", "SOLVER=MARCH_CERTIFIED", "SOLVER=MARCH_FIXED", "MAX_STEPS=17",
          "HIT_DISTANCE=0.1", "FIXED_STEP=3.0", "ANALYTIC_NORMAL=0", "SLOPE_DISTANCE=0.5"})
        EXPECT_EQ(hash_of(loaded(k_shaders / "water_surface.glsl", {definition})), hash_of(plain))
            << definition;
    for (const char* octaves : {"1", "5", "12"}) {
        const auto found =
            find_reference(loaded(k_shaders / "water_surface.glsl", {std::string("OCTAVES=") + octaves}));
        ASSERT_TRUE(found);
        EXPECT_EQ(found->octaves, std::stoi(octaves));
    }
    EXPECT_TRUE(find_reference(loaded(k_shaders / "gerstner_waves.glsl", {"NEWTON_STEPS=2"})));
    EXPECT_TRUE(find_reference(loaded(k_shaders / "procedural_ocean.glsl", {"OCTAVES=5"})));
}

TEST(Reference, IsNotForDefinitionsThatItDoesNotKnow) {
    const auto why = [](const char* scene, const char* definition) {
        const auto found = find_reference(loaded(k_shaders / scene, {definition}));
        return found ? "found" : found.error().message;
    };
    EXPECT_EQ(why("water_surface.glsl", "OCTAVES=(4 + 3)"),
              "the reference reads OCTAVES as a plain number, not as '(4 + 3)': give one with --define "
              "OCTAVES=N, or write it so");
    EXPECT_EQ(why("water_surface.glsl", "OCTAVES=13"),
              "the reference knows OCTAVES from 1 to 12, and it is 13");
    for (const auto& [scene, definition] : {std::pair{"water_surface.glsl", "DRIFT_PERIOD=10.0"},
                                            {"procedural_ocean.glsl", "INTEGER_HASH=0"},
                                            {"pseudo3d_water.glsl", "ROW_SAMPLES=2"}})
        EXPECT_NE(why(scene, definition), "found") << definition;
}

/// Our scenes in a folder of their own, where they may be edited.
class EditedScene : public testing::Test {
protected:
    EditedScene() { fs::copy(k_shaders / "lib", folder_.path() / "lib", fs::copy_options::recursive); }

    fs::path put(const std::string& name, std::string text) const {
        EXPECT_TRUE(write_file(folder_.path() / name, text));
        return folder_.path() / name;
    }
    static std::string text_of(const std::string& scene) {
        auto text = read_file(k_shaders / scene);
        EXPECT_TRUE(text);
        return *text;
    }
    static std::string with(std::string text, const std::string& from, const std::string& to) {
        const size_t at = text.find(from);
        EXPECT_NE(at, text.npos) << from;
        return text.replace(at, from.size(), to);
    }

    TemporaryFolder folder_;
};

TEST_F(EditedScene, KeepsItsReferenceUnderAnotherNameAndWithOtherWords) {
    const std::string text = text_of("water_surface.glsl");
    EXPECT_TRUE(find_reference(loaded(put("my_sea.glsl", text))));
    EXPECT_TRUE(find_reference(
        loaded(put("a.glsl", with(text, "float depth = 0.0;", "float  depth /* m */ =\n0.0;")))));
    EXPECT_TRUE(find_reference(loaded(put("b.glsl", with(text, "wave_height = 3.0", "wave_height = 2.0")))));
    EXPECT_TRUE(find_reference(loaded(put("c.glsl", with(text, "vec3(gamma)", "vec3(2.0 * gamma)")))));
    EXPECT_TRUE(find_reference(loaded(put("d.glsl", "float nothing_to_do_with_it = 1.0;\n" + text))));
}

TEST_F(EditedScene, HasNoReferenceAfterAnyEditOfItsField) {
    const std::string text = text_of("water_surface.glsl");
    const std::pair<const char*, const char*> edits[] = {
        {"return sea_step * (position.y", "return sea_step * (position.y - 1.5"},
        {"float depth = 0.0;", "float depth = 1.5;"},
        {"height *= wave_gain;", "height *= 0.9 * wave_gain;"},
        {"ray_origin = camera_position;", "ray_origin = camera_position + vec3(0.0, 1.5, 0.0);"},
        {"ray_origin = camera_position;", "ray_origin = camera_position; sea_bob_phase += 1.0;"},
        {"hit = march_report(look(fragCoord));", "hit = march_report(look(fragCoord)) + 1.5;"},
        {"vec3 ray_origin;", "vec3 ray_origin;\nfloat moved = ray_origin.y += 1.5;"},
        {"#include \"lib/march.glsl\"",
         "#include \"lib/march.glsl\"\n#define value_noise(p, c) (0.5 * value_noise(p, c))"},
        {"// ---- The field", "#undef OCTAVES\n#define OCTAVES 5\n// ---- The field"},
        {"#define OCTAVES 7 ", "#define OCTAVES 7 + 1 "},
        {"// ---- The field", "#ifdef SHADER_TOY\n#define bob(x) (1.5 + bob(x))\n#endif\n// ---- The field"},
        {"#iUniform float bob_height = 0.6 in { 0.0, 3.0 }", "#iUniform int bob_height = 1 in { 0, 3 }"},
        {"#iUniform float wave_gain = 0.51 in { 0.1, 0.8 }", "const float wave_gain = 0.51;"},
    };
    for (const auto& [from, to] : edits)
        EXPECT_FALSE(find_reference(loaded(put("water_surface.glsl", with(text, from, to))))) << to;
    const fs::path whole = put("water_surface.glsl", text);
    ASSERT_TRUE(find_reference(loaded(whole)));
    for (const auto& [file, from, to] :
         {std::tuple{"lib/noise.glsl", "return ", "return 0.5 * "},
          {"lib/camera.glsl", "return ", "return 1.01 * "},
          {"lib/march.glsl", "return vec4(distance,", "return vec4(distance + 1.5,"},
          {"lib/march.glsl", "return march_count(march_field(t));",
           "return march_count(march_field(t) - 1.5);"}}) {
        const std::string lib = text_of(file);
        std::string edited = lib;
        for (size_t at = 0; (at = edited.find(from, at)) != edited.npos; at += std::string(to).size())
            edited.replace(at, std::string(from).size(), to);
        put(file, edited);
        EXPECT_FALSE(find_reference(loaded(whole))) << file << ": " << to;
        put(file, lib);
    }
}

TEST_F(EditedScene, NeedsMainHitAndATextThatDoesNotAskItsDriver) {
    const auto why = [&](const std::string& text) {
        const auto found = find_reference(loaded(put("a.glsl", text)));
        return found ? "found" : found.error().message;
    };
    const std::string image = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n";
    EXPECT_EQ(why(image), "the scene has no mainHit");
    const std::string hit = "void mainHit(out vec4 h, in vec2 p) { h = vec4(-1, 0, 0, 0); }\n";
    EXPECT_EQ(why(image + hit + "#if HW_PERFORMANCE == 1\n#endif\n"), "the text asks for HW_PERFORMANCE");
    EXPECT_TRUE(
        why(image + hit).starts_with("no reference was written for the text of this field (SHA-256 "));
}

} // namespace
} // namespace tidemark::lab
