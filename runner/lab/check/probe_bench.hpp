// Where probes look at a scene: draws it in any situation and keeps what was compiled for the next question.
// A context must be current as long as it lives.
#pragma once

#include "lab/check/explored.hpp"
#include "lab/check/probe_state.hpp"
#include "lab/check/promises.hpp"
#include "lab/hits.hpp"
#include "lab/march/recorded_hits.hpp"
#include "render/frame_stepper.hpp"
#include "scene/scene.hpp"

#include <functional>
#include <map>
#include <string>

namespace tidemark::lab {

/// What one pass holds after a frame.
struct PassPicture {
    std::string pass;
    image::Image picture; ///< RGBA, floats
};

/// RGB of Image as `picture` has it, drawn elsewhere.
using DrawElsewhere = std::function<Result<image::Image>(const FrameState&)>;

class ProbeBench {
public:
    /// `with_one_thread`: empty where the driver does not let itself be set so.
    ProbeBench(const scene::Scene& scene, Promises promises, DrawElsewhere with_one_thread = {});

    const scene::Scene& scene() const { return scene_; }
    const Promises& promises() const { return promises_; }

    /// RGB of Image, floats. A scene with feedback is drawn from its start, first_frame_of that state.
    Result<image::Image> picture(const FrameState& state,
                                 glsl::Precision precision = glsl::Precision::single);
    /// All passes that are drawn, but cubemaps. Alpha is what a buffer's text wrote; Image's is always 1.
    Result<std::vector<PassPicture>> passes(const FrameState& state);

    const DrawElsewhere& with_one_thread() const { return with_one_thread_; }

    /// Whether a frame depends on the one before it.
    Result<bool> has_feedback();
    /// Draws frame after frame from 0 on and shows each, with all its passes but cubemaps, until `see` says
    /// false.
    using See = std::function<bool(const FrameState&, const std::vector<PassPicture>&)>;
    Result<void> step(const See& see);

    /// Whether it is known what rays meet: from a mainHit that compiles or, where the text has none, from the
    /// march of mainImage, recorded.
    bool has_hits();
    /// Why not.
    const std::string& hit_problem() const { return hit_problem_; }
    bool has_main_hit() const { return has_main_hit_; }
    Result<Hits> hits(const FrameState& state, glsl::Precision precision = glsl::Precision::single);

    /// Why the march of mainImage cannot be recorded; empty: it can.
    const std::string& recording_problem();
    /// What it answers, RGBA in floats.
    Result<image::Image> recorded(const FrameState& state, glsl::RecordAnswer answer,
                                  glsl::Precision precision = glsl::Precision::single);
    /// Whether hits say where a sample was below the surface.
    bool sees_below() const { return has_main_hit_ || sees_below_; }

    /// Whether a march that is recorded goes on by a constant.
    bool fixed_steps() const { return fixed_steps_; }

    /// Image as a function in SSA form.
    const Result<PassFunction>& image_function() { return function_of(scene_.image_index()); }
    const Result<PassFunction>& function_of(size_t pass);

    /// A pass that is about to be drawn in that state: all frames before are drawn.
    Result<render::PassPreview> preview(const FrameState& state, size_t pass);
    /// What the scene as it stands was compiled to; the same with its textures as that state leaves them.
    Result<const render::Renderer*> compiled();
    Result<const render::Renderer*> drawn(const FrameState& state);

    /// Compiles anew, where `picture` takes what it has.
    Result<image::Image> fresh_picture(const FrameState& state);

    /// The promoted scene's hashes; the error of a scene that cannot be promoted.
    Result<std::vector<glsl::KeptHash>> hashes();

    /// What a search has seen; none: nobody has searched yet (lab/check/exploration.hpp).
    std::optional<Explored>& explored() { return explored_; }
    /// "; see bounds: …" where it saw what may draw any bytes; else empty.
    std::string see_bounds() const;

private:
    enum class Entry { picture, main_hit, recording };
    std::string try_main_hit();
    std::string try_recording();
    Result<scene::Scene> scene_of(const FrameState& state, Entry entry) const;
    Result<render::Renderer*> drawn(const FrameState& state, Entry entry, glsl::Precision precision);
    std::vector<PassPicture> read_back(render::Renderer& renderer) const;
    Result<render::Renderer*> renderer(const FrameState& state, Entry entry, glsl::Precision precision);

    scene::Scene scene_;
    bool hits_tried_ = false;
    std::string hit_problem_;
    std::optional<std::string> recording_problem_;
    bool sees_below_ = false;
    bool fixed_steps_ = false;
    std::map<size_t, Result<PassFunction>> functions_;
    Promises promises_;
    DrawElsewhere with_one_thread_;
    bool has_main_hit_;
    std::map<std::string, render::Renderer> renderers_;
    std::optional<Explored> explored_;
};

} // namespace tidemark::lab
