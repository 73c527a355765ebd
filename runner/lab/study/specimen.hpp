// A compiled scene with its own settings, which draws views, measures hits and is timed. Its context must be
// current as long as it lives.
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

/// The settings and the precision of one of a study's pictures.
struct Recipe {
    std::vector<Setting> settings;
    glsl::Precision precision = glsl::Precision::single;
};

/// The source of a scene's hits.
enum class HitSource {
    none, ///< hits are not needed, so nothing is compiled
    main_hit, ///< the scene's mainHit, if it has one
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

    /// Returns the names of the hash functions that compute in floats although the recipe asks for doubles.
    std::vector<std::string> kept_hashes() const;

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

} // namespace tidemark::lab
