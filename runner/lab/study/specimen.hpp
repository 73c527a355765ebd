// A scene with settings of its own, compiled, and what it shows of a view. A context must be current as long
// as it lives.
#pragma once

#include "base/result.hpp"
#include "lab/hits.hpp"
#include "lab/march/recorded_hits.hpp"
#include "lab/setting.hpp"
#include "lab/study/timing.hpp"
#include "lab/study/view.hpp"
#include "render/frame_stepper.hpp"

#include <optional>

namespace tidemark::lab {

/// How one of a study's pictures is made.
struct Recipe {
    std::vector<Setting> settings;
    glsl::Precision precision = glsl::Precision::single;
};

/// Where a scene's hits come from.
enum class HitSource {
    none,             ///< nobody asks for them: nothing is compiled
    main_hit,         ///< its mainHit, if it has one
    main_hit_or_march ///< else the march of its mainImage, recorded while it runs
};

class Specimen {
public:
    /// Compiles the scene as a picture; what tells its hits, if anything does, with the first question for
    /// them. The error has the authors' files and lines.
    static Result<Specimen> create(const scene::Scene& scene, const Recipe& recipe, Extent extent,
                                   HitSource hits = HitSource::main_hit);

    /// RGB, floats, one for each view. Where a frame depends on the one before it, all frames from 0 are
    /// drawn, once for views that lie in one run.
    std::vector<image::Image> pictures(const std::vector<View>& views);
    image::Image picture(const View& view);
    /// The scene's knobs, in their order, from the next picture on.
    void turn(const std::vector<scene::Knob>& knobs);

    bool has_hits() const { return hit_scene_.has_value(); }
    /// The error says why what was recorded is not to be used.
    Result<Hits> hits(const View& view);
    Result<std::vector<Hits>> hits(const std::vector<View>& views);

    /// One more picture of that view, from idle to idle.
    Cost time(const View& view, bool ask_gpu);

    /// What computes in floats although the recipe says double: hashes, by the names of their functions.
    std::vector<std::string> kept_hashes() const;

    double compile_milliseconds() const { return compile_milliseconds_; }
    /// The first frame, in which drivers compile what they put off.
    double first_draw_milliseconds() const { return first_draw_milliseconds_; }

private:
    Specimen() = default;

    Result<void> record(const scene::Scene& set);
    Result<void> check_recording(const View& view);

    Extent extent_;
    glsl::Precision precision_ = glsl::Precision::single;
    std::optional<render::Renderer> renderer_;
    std::optional<scene::Scene> hit_scene_;
    std::optional<PassFunction> recorded_; ///< what the hits of are recorded
    std::optional<render::Renderer> hit_renderer_;
    double compile_milliseconds_ = 0;
    double first_draw_milliseconds_ = 0;
    bool drawn_ = false;
};

} // namespace tidemark::lab
