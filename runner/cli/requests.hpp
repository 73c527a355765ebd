// What the command line asks for, as values that every command shares: a scene with its overrides, and the
// frames to make of it.
#pragma once

#include "base/extent.hpp"
#include "base/result.hpp"
#include "cli/input_script.hpp"
#include "glsl/dialect.hpp"
#include "render/frame_state.hpp"
#include "scene/load_options.hpp"
#include "scene/scene.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::cli {

/// A scene and what the options change in it. The texts are checked when the scene is loaded.
struct SceneRequest {
    std::filesystem::path path{};
    std::vector<std::string> sets{};     ///< --set NAME=VALUE
    std::vector<std::string> defines{};  ///< --define NAME=VALUE
    std::vector<std::string> channels{}; ///< --channel N=WHAT
    scene::LoadOptions files{};          ///< --media, --allow-outside
    std::optional<bool> doubles{};       ///< --precision double, or single; none: single
    bool double_hashes = false;          ///< --double-hashes
    bool knobs_may_go = false;           ///< --set and --define of what is not there: a warning, no error
    std::vector<Diagnostic> said{};      ///< warnings that were printed before, by a load of the same scene
};

glsl::Precision precision_of(const SceneRequest& request);

/// The words that ask for what the options change in the scene, as they are typed.
std::vector<std::string> option_words(const SceneRequest& request);

/// The file's name as the word of a command: one that begins with a dash is no option.
std::string file_word(const std::filesystem::path& file);

/// What is said of a scene in a file of its own: `waves.check.json` beside `waves.glsl`, `check.json` in a
/// folder. It need not exist.
std::filesystem::path file_beside(const std::filesystem::path& scene, const std::string& name);

/// The scene with its overrides. Prints its warnings.
Result<scene::Scene> load(const SceneRequest& request);

/// The two halves of `load`: the scene as its files have it, and what the options change in it.
Result<scene::Scene> load_as_written(const SceneRequest& request);
Result<void> apply_options(const SceneRequest& request, scene::Scene& scene);

/// Which frames, and what they see.
struct FrameSequence {
    render::FrameState state{}; ///< of all of them, but for their number and time
    std::vector<int> frames{0};
    std::optional<InputScript> input{}; ///< instead of a person, or of a mouse and a camera that stand still
    std::string input_file{};           ///< that it was read from
    /// Of a moment in a window, whose clock no other frame follows: the frames that lead to `state.frame` are
    /// so many a second. None: they are as far from it in time as in number.
    std::optional<double> lead_in_fps{};
};

/// The scene, which must have the knobs that the sequence's recording turns (ErrorCode::usage).
Result<scene::Scene> load(const SceneRequest& request, const FrameSequence& sequence);

/// What each frame of the sequence's run sees. Depends on nothing but its number, so that a frame asked for
/// alone equals the same frame of a sequence.
render::FrameStates states_of(const FrameSequence& sequence);

/// The words that bring a state back, as they are typed behind the scene.
std::vector<std::string> option_words(const render::FrameState& state);

/// Those that bring back a frame of a scene, as far as options can say what people did. Where a recording
/// (empty: none) moves the mouse, it does so there, too.
std::vector<std::string> option_words(const SceneRequest& scene, const std::string& recording,
                                      render::FrameState state);

/// Every whole number up to here is a float.
inline constexpr double k_farthest_pixel = 1 << 24;

/// `640x360`.
Result<Extent> parse_size(std::string_view text);

/// OpenImageIO's frame ranges: `7`, `1-10`, `1-10x3`, `10-1`, several with commas; inclusive; from 0.
Result<std::vector<int>> parse_frames(std::string_view text);

/// `x,y` or `x,y,down`: after a click at that pixel, or in the very frame of the press;
/// `x,y,from_x,from_y` or `x,y,from_x,from_y,down`: after a drag to that pixel, or before its end.
Result<render::Mouse> parse_mouse(std::string_view text);

/// --pixel: `x,y` from the bottom left, within a picture of that size.
Result<glm::ivec2> parse_pixel(std::string_view text, Extent extent);

/// As --camera takes it.
std::string to_string(const render::OrbitCamera& camera);

} // namespace tidemark::cli
