// A scene whose settings change without recompiling: numbers of its text become uniforms, so one program
// serves all of them. Use it for pictures, not for times: drivers unroll loops and fold constants if they
// know the numbers. Pure.
#pragma once

#include "lab/setting.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

class TurnableScene {
public:
    /// Makes as many numbers of these settings uniforms as possible. The error is that of `with`.
    static Result<TurnableScene> create(scene::Scene scene, const std::vector<Setting>& settings);

    /// Returns the scene to compile. The driver may reject it although it accepts the author's text: the size
    /// of an array must be a constant.
    const scene::Scene& scene() const { return scene_; }

    /// Returns the values of its knobs at these settings; nullopt if the settings need another program,
    /// because they select a branch of #if or name a solver.
    std::optional<std::vector<scene::Knob>> knobs_at(const std::vector<Setting>& settings) const;

private:
    /// The uniform that replaces a setting's number.
    struct Uniform {
        std::string setting;
        scene::Knob knob;
    };

    explicit TurnableScene(scene::Scene scene) : original_(std::move(scene)) {}
    Result<void> put_uniforms();
    bool is_program_of(const scene::Scene& plain, const std::map<std::string, std::string>& texts) const;

    scene::Scene original_;
    scene::Scene scene_;
    std::vector<Uniform> uniforms_;
    std::optional<std::vector<std::string>> words_; ///< of `scene_`, without the declarations of `uniforms_`
};

} // namespace tidemark::lab
