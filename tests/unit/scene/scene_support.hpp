// Helpers of the tests of scenes in files: a folder to write scenes into, and results as text.
#pragma once

#include "scene/load_scene.hpp"
#include "scene/scene.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace tidemark::scene {

inline const std::string k_main_image = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n";

inline std::vector<std::string> names_of(const Scene& scene) {
    std::vector<std::string> names;
    for (const Pass& pass : scene.passes)
        names.push_back(pass.name);
    return names;
}

inline const ChannelInput& input(const Scene& scene, size_t pass, size_t channel) {
    return scene.passes.at(pass).channels[channel].input;
}

class SceneFolder : public testing::Test {
protected:
    void save(const std::string& name, std::string_view text) const {
        std::filesystem::create_directories((folder_ / name).parent_path());
        save_in_place(folder_ / name, text);
    }
    const std::filesystem::path& path() const { return folder_.path(); }

    Scene load(const std::string& name = "", const LoadOptions& options = {}) const {
        auto scene = load_scene(name.empty() ? path() : folder_ / name, options);
        EXPECT_TRUE(scene) << to_string(scene.error());
        return scene ? *std::move(scene) : Scene{};
    }
    std::string refusal(const std::string& name = "") const {
        const auto scene = load_scene(name.empty() ? path() : folder_ / name);
        return scene ? "it was loaded" : plain(to_string(scene.error()));
    }
    std::vector<std::string> warnings_of(const Scene& scene) const {
        std::vector<std::string> lines;
        for (const Diagnostic& warning : scene.warnings)
            lines.push_back(plain(to_string(warning)));
        return lines;
    }
    /// The text with the folder's own path left out.
    std::string plain(std::string text) const {
        const std::string folder = path().string() + "/";
        for (size_t at; (at = text.find(folder)) != std::string::npos;)
            text.erase(at, folder.size());
        return text;
    }

private:
    TemporaryFolder folder_;
};

} // namespace tidemark::scene
