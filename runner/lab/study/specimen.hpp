// A scene with settings of its own, compiled, and what it shows of a view. A context must be current as long
// as it lives.
#pragma once

#include "base/result.hpp"
#include "lab/hits.hpp"
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

class Specimen {
public:
    /// Compiles the scene as a picture; its mainHit, if it has one, with the first question for it. The error
    /// has the authors' files and lines.
    static Result<Specimen> create(const scene::Scene& scene, const Recipe& recipe, Extent extent);

    /// RGB, floats. Where a frame depends on the one before it, all frames from 0 are drawn.
    image::Image picture(const View& view);
    bool has_hits() const { return hit_scene_.has_value(); }
    Result<Hits> hits(const View& view);

    /// One more picture of that view, from idle to idle.
    Cost time(const View& view, bool ask_gpu);

    /// What computes in floats although the recipe says double: hashes, by the names of their functions.
    std::vector<std::string> kept_hashes() const;

    double compile_milliseconds() const { return compile_milliseconds_; }
    /// The first frame, in which drivers compile what they put off.
    double first_draw_milliseconds() const { return first_draw_milliseconds_; }

private:
    Specimen() = default;

    Extent extent_;
    glsl::Precision precision_ = glsl::Precision::single;
    std::optional<render::Renderer> renderer_;
    std::optional<scene::Scene> hit_scene_;
    std::optional<render::Renderer> hit_renderer_;
    double compile_milliseconds_ = 0;
    double first_draw_milliseconds_ = 0;
    bool drawn_ = false;
};

} // namespace tidemark::lab
