// A compiled scene for measurements, at one setting or at changing settings.
//
// A scene whose settings change without recompiling: numbers of its text become uniforms, so one program
// serves all of them. Use it for pictures, not for times: drivers unroll loops and fold constants if they
// know the numbers. Pure.
#pragma once

#include "base/error.hpp"
#include "lab/hits.hpp"
#include "lab/instrumented_pass.hpp"
#include "lab/march_hits.hpp"
#include "lab/scene_numbers.hpp"
#include "lab/study.hpp"
#include "lab/work_precision.hpp"
#include "render/frame_stepper.hpp"

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

// A compiled scene with its own settings, which draws views, measures hits and is timed. Its context must be
// current as long as it lives.

/// The settings and the precision of one of a study's pictures.
struct Recipe {
    std::vector<Setting> settings;
    glsl::Precision precision = glsl::Precision::single;
};

/// The source of a scene's hits.
enum class HitSource {
    none,             ///< hits are not needed, so nothing is compiled
    main_hit,         ///< the scene's mainHit, if it has one
    main_hit_or_march ///< else the march of its mainImage, recorded while it runs
};

class Specimen {
public:
    /// Compiles the scene for pictures; the program for hits, if there is one, is compiled with the first
    /// request for them. The error has the authors' files and lines.
    static Result<Specimen> create(const scene::Scene& scene, const Recipe& recipe, Extent extent,
                                   HitSource hits = HitSource::main_hit);

    /// Draws one RGB float picture for each view. If a frame depends on the previous one, all frames from 0
    /// are drawn, once for views of the same run.
    std::vector<image::Image> pictures(const std::vector<View>& views);
    image::Image picture(const View& view);
    /// Sets the values of the scene's knobs, in their order, from the next picture on.
    void turn(const std::vector<scene::Knob>& knobs);

    bool has_hits() const { return hit_scene_.has_value(); }
    /// The error gives the reason why recorded hits cannot be used.
    Result<Hits> hits(const View& view);
    Result<std::vector<Hits>> hits(const std::vector<View>& views);

    /// Draws one more picture of the view and times it, from idle to idle.
    Cost time(const View& view, bool ask_gpu);

    /// Returns the names of the hash functions that compute in floats although the recipe requests doubles.
    std::vector<std::string> kept_hashes() const;

    /// Returns how the loops of all passes end in the view, in any pixel (lab/instrumented_pass.hpp).
    Result<std::vector<LoopEnd>> loop_ends(const View& view);
    /// Returns where the driver cuts a loop in any of the views. It draws only if the numbers of `set`, the
    /// scene at the present settings, allow so many iterations.
    Result<std::vector<SourceLocation>> cut_loops(const scene::Scene& set, const std::vector<View>& views);
    /// Returns whether the picture depends on passes whose results are stored as floats.
    bool has_buffers() const { return renderer_->plan().passes.size() > 1 || renderer_->plan().feedback; }

    double compile_milliseconds() const { return compile_milliseconds_; }
    /// Returns the time of the first frame, which includes deferred compilation in the driver.
    double first_draw_milliseconds() const { return first_draw_milliseconds_; }

private:
    Specimen() = default;

    Result<void> record(const scene::Scene& set);
    Result<void> check_recording(const View& view);

    Extent extent_;
    glsl::Precision precision_ = glsl::Precision::single;
    std::optional<render::Renderer> renderer_;
    std::optional<scene::Scene> hit_scene_;
    std::optional<PassFunction> recorded_; ///< the pass whose hits are recorded
    std::optional<render::Renderer> hit_renderer_;
    double compile_milliseconds_ = 0;
    double first_draw_milliseconds_ = 0;
    bool drawn_ = false;
};

// A scene that is drawn at one setting after the other, and recompiled only if a setting needs another
// program. Its context must be current as long as it lives.

class TurnedSpecimen {
public:
    /// `scene` must outlive the object.
    TurnedSpecimen(const scene::Scene& scene, Extent extent, HitSource hits)
        : scene_(scene), extent_(extent), hits_(hits) {}

    /// Returns the scene at these settings, valid until the next call. The error is that of the author's own
    /// text.
    Result<Specimen*> at(const std::vector<Setting>& settings, glsl::Precision precision);
    /// Returns whether the present specimen has uniforms in the place of its settings' numbers.
    bool has_uniforms() const { return turnable_.has_value(); }

private:
    bool make_turnable(const std::vector<Setting>& settings);

    const scene::Scene& scene_;
    Extent extent_;
    HitSource hits_;
    glsl::Precision precision_ = glsl::Precision::single;
    std::optional<TurnableScene> turnable_; ///< source of `specimen_`; nullopt: the scene's own text
    std::optional<Specimen> specimen_;
    std::map<std::string, std::vector<scene::Knob>> known_; ///< knobs of `turnable_`, by settings
    bool own_text_only_ = false;                            ///< the driver rejects the text with uniforms
};

/// Returns the scene with each value of its buffers changed by about the rounding of a float, in
/// pseudo-random directions; nullopt if a buffer has no mainImage of its own. `share` of the picture's change
/// stands for the effect of rounding itself.
std::optional<scene::Scene> with_nudged_buffers(scene::Scene scene, glsl::Precision precision, double& share);

} // namespace tidemark::lab
