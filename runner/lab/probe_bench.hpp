// The bench that draws a scene for probes, and the stored results of the search.
//
// Results of the search through a scene's moments, knobs and mouse positions (lab/exploration.hpp).
#pragma once

#include "lab/hits.hpp"
#include "lab/march_hits.hpp"
#include "lab/probe_inputs.hpp"
#include "render/frame_stepper.hpp"
#include "scene/scene.hpp"
#include "shader/undefined_behaviour.hpp"

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

/// The pixels of a pass to draw: every `stride`-th, starting at (left, down).
struct PixelGrid {
    int stride = 1;
    int left = 0;
    int down = 0;
};

/// Returns a grid with as many pixels but a smaller stride, inside a picture of size `whole`. Its middle is
/// the place of pixel number `pixel` of `grid`, counted row by row from the bottom; `part` is the size of the
/// grids in pixels.
PixelGrid finer(const PixelGrid& grid, Extent part, uint32_t pixel, Extent whole);

/// A site at which a value left its domain, with the first situation that showed it.
struct Outside {
    FrameState where;
    PixelGrid grid;       ///< of the pixels that showed it
    bool bound = false;   ///< index, shift, whole-number divisor, texel or conversion
    std::string sentence; ///< only if `bound`: place, operand, pixel and moment
    SourceLocation place{};
    std::string what{}; ///< only if `bound`: the operand and its value
    size_t pass = 0;    ///< index in the scene
    glsl::DomainSite site{};

    /// Returns whether it is a texel outside of its texture or level, which is 0 on ShaderToy's site and
    /// here.
    bool is_texel() const { return site.kind == glsl::DomainKind::fetch; }
};

struct Explored {
    /// Situations in which a pass is not finite, confirmed by drawing the scene's own text; the first one
    /// found comes first.
    std::vector<FrameState> not_finite;
    std::vector<Outside> outside; ///< one per site
    /// "sampled: 240 situations, …": what was sampled, and how.
    std::string sentence;
    std::string left_out; ///< why the text was not instrumented; empty: it was
};

// Draws a scene in any situation for the probes and keeps its compiled programs for later calls. A context
// must be current while it exists.

/// The contents of one pass after a frame.
struct PassPicture {
    std::string pass;
    image::Image picture; ///< RGBA, floats
};

/// Draws Image as ProbeBench::picture does (RGB floats), but in another process.
using DrawElsewhere = std::function<Result<image::Image>(const FrameState&)>;

class ProbeBench {
public:
    /// `with_one_thread` is empty if the number of the driver's threads cannot be set.
    ProbeBench(const scene::Scene& scene, Promises promises, DrawElsewhere with_one_thread = {});

    const scene::Scene& scene() const { return scene_; }
    const Promises& promises() const { return promises_; }
    /// Sets the first frame of a scene with feedback; without this call it is first_frame_of(state).
    void start_at(int frame) { start_ = frame; }

    /// Returns Image, RGB floats. A scene with feedback is drawn from frame first_frame_of(state) on. In
    /// double, a scene gets the iTime that floats have.
    Result<image::Image> picture(const FrameState& state,
                                 glsl::Precision precision = glsl::Precision::single);
    /// Returns all drawn passes except cubemaps. Alpha is what a buffer's text wrote; Image's is always 1.
    Result<std::vector<PassPicture>> passes(const FrameState& state);
    /// Does the same and, with feedback, puts the passes after the previous frame into `before`; draws each
    /// frame once.
    Result<std::vector<PassPicture>> passes(const FrameState& state, std::vector<PassPicture>& before);

    const DrawElsewhere& with_one_thread() const { return with_one_thread_; }

    /// Returns whether a frame depends on the one before it.
    Result<bool> has_feedback();
    /// Draws frame after frame from 0 on and passes each to `see`, with all its passes except cubemaps, until
    /// `see` returns false.
    using See = std::function<bool(const FrameState&, const std::vector<PassPicture>&)>;
    Result<void> step(const See& see);

    /// Returns whether hits are available: from a mainHit that compiles or, if the text has none, from the
    /// recorded march of mainImage.
    bool has_hits();
    /// Returns why has_hits() was false.
    const std::string& hit_problem() const { return hit_problem_; }
    /// Returns whether hits come from a mainHit, once has_hits() was called.
    bool has_main_hit() const { return has_main_hit_; }
    /// Returns why the text's mainHit does not compile; empty if it has none, or has_hits() was not called.
    const std::string& main_hit_problem() const { return main_hit_problem_; }
    Result<Hits> hits(const FrameState& state, glsl::Precision precision = glsl::Precision::single);

    /// Returns why the march of mainImage cannot be recorded; empty if it can.
    const std::string& recording_problem();
    /// Draws one answer of the recorded march, RGBA floats.
    Result<image::Image> recorded(const FrameState& state, glsl::RecordAnswer answer,
                                  glsl::Precision precision = glsl::Precision::single);
    /// Returns whether hits flag samples below the surface.
    bool sees_below() const { return has_main_hit_ || sees_below_; }
    /// Returns the same for the recorded march, once recording_problem() was called.
    bool recording_sees_below() const { return sees_below_; }

    /// Returns whether the recorded march advances by a constant.
    bool fixed_steps() const { return fixed_steps_; }

    /// Returns Image as a function in SSA form.
    const Result<PassFunction>& image_function() { return function_of(scene_.image_index()); }
    const Result<PassFunction>& function_of(size_t pass);

    /// The frames that a preview with feedback draws: all from first_frame_of(state) on, or only its own.
    /// Then the caller fills the buffers that hold the previous frame.
    enum class RunUp { drawn, left_out };
    /// Returns a pass that is about to be drawn in that state; all that it depends on is drawn.
    Result<render::PassPreview> preview(const FrameState& state, size_t pass, RunUp run_up = RunUp::drawn);
    /// Returns the renderer of the unchanged scene; `drawn` also draws that state, so that the textures hold
    /// it.
    Result<const render::Renderer*> compiled();
    Result<const render::Renderer*> drawn(const FrameState& state);
    /// Returns the renderer that draws that state; it has not drawn it.
    Result<const render::Renderer*> renderer(const FrameState& state);

    /// Compiles the scene again, while `picture` reuses programs. It drops all programs kept so far.
    Result<image::Image> fresh_picture(const FrameState& state);

    /// Returns the hashes that the scene's double version keeps in float. Fails if the scene cannot be
    /// promoted.
    Result<std::vector<glsl::KeptHash>> hashes();

    /// The stored result of a search; empty before the first (lab/exploration.hpp).
    std::optional<Explored>& explored() { return explored_; }
    /// Returns the probe that has reported rays that run out of steps; empty if none has.
    std::string_view running_out_reported() const { return running_out_reported_; }
    void report_running_out(std::string_view probe) { running_out_reported_ = probe; }

    /// Returns "; see bounds: …" if the search found an access out of bounds, after which any bytes may be
    /// drawn; else an empty text.
    std::string see_bounds() const;

private:
    enum class Entry { picture, main_hit, recording };
    std::string try_main_hit();
    std::string try_recording();
    Result<scene::Scene> scene_of(const FrameState& state, Entry entry) const;
    Result<render::Renderer*> drawn(const FrameState& state, Entry entry, glsl::Precision precision);
    std::vector<PassPicture> read_back(render::Renderer& renderer) const;
    int start_of(const FrameState& state) const { return start_.value_or(first_frame_of(state)); }
    Result<render::Renderer*> renderer(const FrameState& state, Entry entry, glsl::Precision precision);

    scene::Scene scene_;
    std::optional<int> start_; ///< of start_at
    bool hits_tried_ = false;
    std::string hit_problem_, main_hit_problem_;
    std::string_view running_out_reported_;
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
