// Describes a scene from its files alone, as text and as JSON. No driver is used, so it does not say which
// channels a program reads or which passes are drawn.
#pragma once

#include "host/requests.hpp"
#include "render/renderer.hpp"
#include "scene/scene.hpp"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::host {

/// Returns the name of a channel's input: a pass, a file, or the input's type.
std::string describe(const scene::Scene& scene, const scene::Channel& channel);

/// Returns true if a frame may depend on the one before, judged by the files alone: the scene has a buffer or
/// a cubemap pass.
bool may_feed_back(const scene::Scene& scene);

nlohmann::ordered_json files_of(const scene::Scene& scene);
nlohmann::ordered_json knobs_of(const scene::Scene& scene);
/// Lists each knob with its type, value and range.
std::string knob_lines(const scene::Scene& scene);

/// Return the length, rate and channels of each channel that reads a sound file or a video. They decode the
/// files.
nlohmann::ordered_json sounds_of(const scene::Scene& scene);
std::string sound_lines(const scene::Scene& scene);

/// Return the names that --define and --vary accept, with their values.
nlohmann::ordered_json definitions_of(const scene::Scene& scene);
std::string definition_lines(const scene::Scene& scene);

/// Return files, passes with the channels that have an assigned input, knobs and definitions.
nlohmann::ordered_json what_files_say(const scene::Scene& scene);
std::string lines_of_files(const scene::Scene& scene);

// Lists what a scene does not need and what was therefore not created.

/// A drawn pass and the channels that its program reads.
struct PassFacts {
    size_t pass = 0; ///< index into Scene::passes
    std::vector<int> channels;
};

struct SceneFacts {
    std::vector<PassFacts> passes;     ///< in drawing order
    std::vector<std::string> uniforms; ///< active in any pass, knobs and channels included
    std::vector<std::string> left_out; ///< texts for users, one per kind
    /// Active uniforms that have a value because their names are those of other hosts: the name, and our name
    /// for the value, or its meaning.
    std::vector<std::pair<std::string, std::string>> other_names;
};

SceneFacts facts_of(const render::Renderer& renderer);

/// Returns what specialisation of kind `how` removes from a pass's text; in double precision, what was
/// removed when the pass was compiled.
glsl::LeftOut left_out_of(const render::Renderer& renderer, size_t pass, glsl::Specialise how);

// The part of a report about the precision in which a scene was drawn.

/// Returns "single" or "double", the values of --precision.
std::string name_of(glsl::Precision precision);

/// Adds `precision`, and for double precision `float_hashes`: pass, function, file, line and kind of each
/// hash that stays in floats.
void add_precision(nlohmann::ordered_json& report, const render::Renderer& renderer);

/// Returns the same as text; empty in single precision.
std::string precision_lines(const render::Renderer& renderer);

// Reports pixels that are NaN or infinite, which neither a picture file nor a window shows.

/// Counts the pixels of the shown pass that are not finite. `picture` is its read-back: for Image the bytes
/// are marked (RenderOptions::marks_non_finite), and the marks are removed. Other passes use their alpha
/// themselves, so their floats are read instead.
size_t count_not_finite(const render::Renderer& renderer, image::Image& picture);

/// The same for the pictures of a frame, which may be the faces of a cube or its panorama, cut to `crop`
/// (nothing: whole). Where floats are read, the pixels of a cube are counted in its whole faces.
size_t count_not_finite(const render::Renderer& renderer, std::span<image::Image> pictures,
                        const std::optional<Rectangle>& crop);

/// Returns `3 pixels of frame 7 are` or `1 pixel at 2.5 s is`, to be followed by ` not finite`.
std::string pixels_are(size_t count, const std::string& when);

/// Return the command that finds the line, as arguments and as shell text.
std::vector<std::string> trace_words(const SceneRequest& scene, const FrameSequence& sequence,
                                     const render::FrameState& state);
std::string trace_command(const SceneRequest& scene, const FrameSequence& sequence,
                          const render::FrameState& state);

// Errors of a GLSL ES 3.00 compiler in a scene's texts as ShaderToy's site would compile them.

/// Adds compile errors to those `found` by reading (shader/portability.hpp). Each place is reported once,
/// including places of Common, which precedes every pass, and places in `found` before. A context must be
/// current.
/// `compiling` is called with the name of each pass before the driver compiles it.
void add_site_refusals(const scene::Scene& scene, std::vector<Diagnostic>& found,
                       const std::function<void(const std::string& pass)>& compiling = {});

} // namespace tidemark::host
