// A scene whose settings change without compiling it again: numbers of its text are uniforms, so that one
// program shows them all. For pictures, not for times: drivers unroll and fold what they know. Pure.
#pragma once

#include "lab/setting.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

class TurnableScene {
public:
    /// With these settings, as many of their numbers as uniforms as can be. The error is that of `with`.
    static Result<TurnableScene> create(scene::Scene scene, const std::vector<Setting>& settings);

    /// What is to be compiled. It may be refused where the author's text is not: the size of an array must be
    /// a constant.
    const scene::Scene& scene() const { return scene_; }

    /// Its knobs at these settings; nothing where those make another program: they choose a branch of #if, or
    /// name a solver.
    std::optional<std::vector<scene::Knob>> knobs_at(const std::vector<Setting>& settings) const;

private:
    /// What stands in the place of a setting's number.
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
    std::optional<std::vector<std::string>> words_; ///< of `scene_`, the declarations of `uniforms_` aside
};

} // namespace tidemark::lab
