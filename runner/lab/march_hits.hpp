// Proves the first hits of a scene's rays from its text, and compares them with the scene's own march.
#pragma once

#include "base/measurement.hpp"
#include "lab/hits.hpp"
#include "lab/march_rays.hpp"
#include "lab/pass_function.hpp"
#include "proof/ray_proofs.hpp"
#include "proof/texels.hpp"
#include "render/frame_state.hpp"
#include "shader/march_record.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace tidemark::lab {

/// The ray of a pixel that enters a marching loop.
struct ProvedRay {
    glm::ivec2 pixel{0};
    size_t loop = 0; ///< index in PassFunction::loops
    enum class Outcome {
        agrees,          ///< the march ends at its first hit, or has none and finds none
        steps_over,      ///< the march ends past its first hit
        misses,          ///< the march ends without a hit and not at the surface, but there is one
        undecided,       ///< see `reason`
        unknown_texture, ///< the march reads a texture whose texels are not available
        unfaithful       ///< the loop carries more than the place on the ray
    } outcome = Outcome::undecided;
    proof::FirstHit::Reason reason = proof::FirstHit::Reason::none;
    uint64_t evaluations = 0;
    size_t turns = 0; ///< of the march
    /// The march steps over its first hit in its last step.
    bool within_last_step = false;
    /// The march misses because it went past the first hit, or because its limit of the distance ended it.
    bool went_past = false;
    /// The march was below the threshold at a place where that is excluded: a bug in Tidemark.
    bool contradicted = false;
    /// The march reads a texture whose mipmap level the device chooses, and the proof does not hold for all
    /// levels: it is for the base level only, if it succeeds.
    bool at_base_level = false;
};

/// A march is right if it ends at most this share of the distance past its first hit, or this much where the
/// distance is less than 1.
inline constexpr double k_same_end = 0.01;

/// Proves the ray of a pixel, with the pass's textures; nullopt if it enters no marching loop.
std::optional<ProvedRay> prove_ray(const PassFunction& function, const proof::FloatEvaluator& pixel,
                                   const proof::TextureSet& textures, glm::ivec2 at,
                                   uint64_t most_evaluations);

struct RayCounts {
    size_t rays = 0; ///< number of rays that entered a loop
    size_t agree = 0, step_over = 0, miss = 0, undecided = 0, unknown_texture = 0, unfaithful = 0,
           contradicted = 0;
    size_t within_last_step = 0; ///< of those that step over
    size_t went_past = 0;        ///< of those that miss
    size_t at_base_level = 0;
    std::array<size_t, proof::k_reasons> reasons{}; ///< of the undecided rays
    std::optional<size_t> wrong_loop{};             ///< of the first ray that steps over or misses
    std::vector<double> evaluations{};              ///< of the rays for which a proof was tried

    void add(const ProvedRay& ray);
    size_t decided() const { return agree + step_over + miss; }
    /// Returns whether most of the wrong rays are those of steps that are too long, not too few.
    bool steps_too_long() const { return step_over + went_past >= miss - went_past; }
    /// Returns the most common reason of the undecided rays.
    proof::FirstHit::Reason commonest() const;
};

// Proves the place at which each ray of a picture first hits the surface, from the scene's own text: the
// first zero of the distance that its march measures, in real arithmetic, on rays set up in double. If that
// distance has no zeros, as for fractals, it is the first place at which it falls below the march's
// threshold.

struct TrueHits {
    proof::Surface surface = proof::Surface::zero;
    /// NaN: not searched, or not known; -1: no hit up to the march's limit, or no loop is entered.
    Hits hits;
    size_t looked_at = 0;
    size_t unknown = 0;    ///< of the pixels searched
    double half_width = 0; ///< of the proved places, root mean square
};

/// Searches as many pixels, evenly spread, as `seconds` of each core allow. Returns nullopt if `keep_going`
/// cancels it.
std::optional<TrueHits> true_hits(const DrawnPass& drawn, double seconds, const KeepGoing& keep_going);

// Hits as the device computes them: a scene without a mainHit gets one that records, while mainImage runs,
// the first marching loop that each pixel enters. The pass in SSA form shows where to record; the recording
// is checked against the picture and against the pass evaluated on the CPU. Needs a current context.

/// Returns the place of a marching loop in its author's text.
glsl::MarchLines lines_of(const PassFunction& image, const proof::MarchingLoop& loop);

/// Returns each marching loop of the text once: one that is called from several places is inlined several
/// times.
std::vector<glsl::MarchLines> marches_of(const PassFunction& image);

/// Rewrites Common and the text of a pass, as their authors wrote them, to one text with a mainHit.
using RewriteText = std::function<Result<text::MappedText>(const glsl::ParsedText&, const glsl::TreeFacts&)>;

/// Name of the pass that with_pass_copy adds.
inline constexpr std::string_view k_copied_pass = "copy of a pass";
/// Returns the scene with a copy of a buffer before the buffer itself, so that it reads the same pictures: of
/// this frame from earlier passes, of the last frame from the buffer itself and from later ones.
scene::Scene with_pass_copy(const scene::Scene& scene, size_t pass);
/// Returns the scene with the rewritten text of a pass with a mainImage, of kind hit, in the place of Image.
/// A buffer stays as it is; its copy gets the rewritten text, which has TIDEMARK_ALL_BITS defined if the
/// buffer stores floats.
Result<scene::Scene> with_hit_text(const scene::Scene& scene, size_t pass, const RewriteText& rewrite);
/// Returns the name of the pass that with_hit_text rewrote; empty for Image.
std::string_view rewritten_pass(const scene::Scene& scene, size_t pass);

struct Recording {
    scene::Scene scene; ///< its Image is of kind hit; its last knob is glsl::k_record_knob
    /// Whether samples below the surface are recorded: false if the march ends only below it, or has fixed
    /// steps.
    bool sees_below = true;
    bool fixed_steps = false; ///< every march adds a constant
};

/// Instruments the scene. The error gives the reason why the march's place in the text is not known.
Result<Recording> record_hits(const scene::Scene& scene, const PassFunction& image);

/// Selects what the recording's renderer draws from now on.
void ask(render::Renderer& recording, glsl::RecordAnswer answer);

/// Result of the check, for the rays of a grid of pixels.
struct RecordingCheck {
    size_t rays = 0; ///< number that enter a marching loop, on the CPU
    /// of these, those that read a texture: its texels are not available, so they are not compared
    size_t textured = 0;
    /// of the others, those whose hit, iteration count and place equal the CPU's, up to rounding
    size_t agree = 0;
    size_t other_pixels = 0; ///< pixels of the picture that the recording text draws differently

    size_t compared() const { return rays - textured; }
};

/// `plain` and `recording` are the renderers of the scene and of the recording, of the same size.
RecordingCheck check_recording(render::Renderer& plain, render::Renderer& recording,
                               const PassFunction& image, const render::FrameState& state);
/// Returns the reason why the hits must not be used; empty if they may be.
std::string refusal_of(const RecordingCheck& check);

} // namespace tidemark::lab
