// Helpers of the tests of the scenes in shaders/: functions that evaluate expressions in a scene's own text,
// and the scene's reference, if it has one.
#pragma once

#include "base/file.hpp"
#include "fields/gerstner_waves_field.hpp"
#include "fields/procedural_ocean_field.hpp"
#include "fields/water_surface_field.hpp"
#include "gl_test.hpp"
#include "scene/load_scene.hpp"
#include "shader/definitions.hpp"

#include <algorithm>
#include <string>

namespace tidemark::render {

inline const fs::path k_shaders = fs::path(TIDEMARK_SOURCE_DIR) / "shaders";

struct Water {
    const char* scene;
    int octaves;
    double wrong; ///< share of pixels that may be wrong by more than a pixel and 0.1
    fields::MakeReference reference;
};

inline constexpr Water k_waters[] = {{"water_surface", 7, 0.004, fields::water_surface_reference},
                                     {"gerstner_waves", 0, 0.006, fields::gerstner_waves_reference},
                                     {"procedural_ocean", 3, 0.01, fields::procedural_ocean_reference}};

inline constexpr Extent k_small{64, 36};

inline void define(scene::Scene& scene, const std::string& setting) {
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
    static fields::Reference reference(const scene::Scene& scene, const Water& water,
                                       const FrameInputs& inputs, Extent extent,
                                       fields::Lattice3 lattice = fields::IntegerLattice{}) {
        const auto made = water.reference({.knobs = scene.knobs,
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

} // namespace tidemark::render
