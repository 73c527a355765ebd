// Requests from the command line, shared by all commands: a scene with its overrides, and the frames to draw.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"
#include "host/command_line.hpp"
#include "host/devices.hpp"
#include "host/input_script.hpp"
#include "host/supervision.hpp"
#include "render/frame_state.hpp"
#include "scene/load_scene.hpp"
#include "scene/scene.hpp"
#include "shader/shader_source.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::host {

/// A scene and the changes that options make to it. The texts are checked when the scene is loaded.
struct SceneRequest {
    std::filesystem::path path{};
    std::vector<std::string> sets{};     ///< --set NAME=VALUE
    std::vector<std::string> defines{};  ///< --define NAME=VALUE
    std::vector<std::string> channels{}; ///< --channel N=WHAT
    scene::LoadOptions files{};          ///< --media, --allow-outside
    std::optional<bool> doubles{};       ///< --precision double, or single; none: single
    bool double_hashes = false;          ///< --double-hashes
    bool knobs_may_go = false;      ///< a --set or --define of an unknown name is a warning, not an error
    std::vector<Diagnostic> said{}; ///< warnings already printed by an earlier load of the same scene
};

glsl::Precision precision_of(const SceneRequest& request);

/// Returns the options that change the scene, as command-line arguments.
std::vector<std::string> option_words(const SceneRequest& request);

/// Returns the file's name as a command-line argument; a leading dash is escaped with "./".
std::string file_word(const std::filesystem::path& file);

/// Returns the path of a file that belongs to a scene: `waves.check.json` next to `waves.glsl`, or
/// `check.json` in a scene folder. It need not exist.
std::filesystem::path file_beside(const std::filesystem::path& scene, const std::string& name);

/// Loads the scene with its overrides. Prints its warnings.
Result<scene::Scene> load(const SceneRequest& request);

/// The two steps of `load`: the scene as its files define it, and the changes made by options.
Result<scene::Scene> load_as_written(const SceneRequest& request);
Result<void> apply_options(const SceneRequest& request, scene::Scene& scene);

/// The frames to draw and their state.
struct FrameSequence {
    render::FrameState state{}; ///< the state of every frame, except its number and time
    std::vector<int> frames{0};
    std::optional<InputScript> input{}; ///< recorded input, instead of a fixed mouse and camera
    std::string input_file{};           ///< the file that `input` was read from
    /// For a moment saved in a window, whose clock was irregular: the frame rate of the frames that lead to
    /// `state.frame`. Nothing: the sequence has a constant time step.
    std::optional<double> lead_in_fps{};
};

/// Loads the scene. Fails (ErrorCode::usage) if it lacks a knob that the sequence's recording sets, or if a
/// knob refuses a value of the recording or of the state.
Result<scene::Scene> load(const SceneRequest& request, const FrameSequence& sequence);
/// The same for files that `scene::load_scene` has read already; returns its error if it failed.
Result<scene::Scene> load(const SceneRequest& request, const FrameSequence& sequence,
                          Result<scene::Scene> files);

/// Returns the state of each frame of the sequence. It depends only on the frame's number, so a frame drawn
/// alone equals the same frame of a sequence.
render::FrameStates states_of(const FrameSequence& sequence);

/// Returns the options that recreate a state, as command-line arguments after the scene.
std::vector<std::string> option_words(const render::FrameState& state);

/// Returns the options that recreate a frame of a scene, as far as options can express its state. With a
/// `recording` (empty: none), input comes from that file.
std::vector<std::string> option_words(const SceneRequest& scene, const std::string& recording,
                                      render::FrameState state);

/// Every integer up to this limit is exact in a float.
inline constexpr double k_farthest_pixel = 1 << 24;

/// Parses a size, for example `640x360`.
Result<Extent> parse_size(std::string_view text);

/// Parses OpenImageIO's frame ranges: `7`, `1-10`, `1-10x3`, `10-1`, several with commas; inclusive; from 0.
Result<std::vector<int>> parse_frames(std::string_view text);

/// Parses `x,y` (after a click at that pixel) or `x,y,down` (in the frame of the press); `x,y,from_x,from_y`
/// (after a drag to that pixel) or `x,y,from_x,from_y,down` (before the drag's end).
Result<render::Mouse> parse_mouse(std::string_view text);

/// Parses --pixel: `x,y` from the bottom left, inside a picture of size `extent`.
Result<glm::ivec2> parse_pixel(std::string_view text, Extent extent);

/// Formats a camera as --camera accepts it.
std::string to_string(const render::OrbitCamera& camera);

// The options shared by several commands: adds them to a command and converts them to requests.

/// Adds SCENE, --set, --define, --channel, --media and --allow-outside.
void add_scene_options(Command command, SceneRequest& request);
/// Adds --media and --allow-outside.
void add_file_options(Command command, SceneRequest& request);

/// Adds --precision and --double-hashes, for every command that draws.
void add_precision_options(Command command, SceneRequest& request);

/// Adds --device and --require-gpu, for every command that draws without a window.
void add_device_options(Command command, DeviceChoice& device);

/// The frame options as they were typed.
struct FrameOptions {
    std::optional<std::string> size;
    std::map<std::string_view, double> numbers; ///< by option: `--fps` and the other numbers of a run
    std::optional<int> frame;
    std::optional<std::string> frames;
    std::optional<double> time;
    std::optional<std::string> mouse;
    std::optional<std::string> date;
    std::optional<std::string> camera;
    std::optional<std::string> input;
    std::string pass; ///< empty: Image
};

/// Adds the option of one number of `render::k_frame_fields`, or of all of them.
void add_number_options(Command command, FrameOptions& options, std::string_view option = {});
/// Adds --size, the numbers (--fps), --date, --camera, --pass and --input, which a window has too.
void add_picture_options(Command command, FrameOptions& options);
/// Adds --frame, --frames, --time and --mouse; in a window the user controls these directly.
void add_time_options(Command command, FrameOptions& options);

/// Returns all files that a scene is drawn from, which an output must not replace.
std::vector<std::filesystem::path> files_read(const scene::Scene& scene, const FrameOptions& options = {});

/// Sets the size that the scene states, if --size is not given.
FrameOptions sized(FrameOptions options, const scene::Scene& scene);
/// The same, from the scene's files. Errors in them are ignored here; loading the scene reports them.
FrameOptions sized(FrameOptions options, const SceneRequest& request);

/// Checks all options and converts them; `base` supplies what they leave open. An error names the option and
/// what to give.
Result<FrameSequence> resolve(const FrameOptions& options, FrameSequence base = {});

// The options that limit memory and time of a command, and the limits that result.

struct LimitOptions {
    std::optional<std::string> memory;
    std::optional<double> timeout;
};

/// Returns true if a sub-command compiles or draws a scene.
bool compiles_scenes(Command command);

void add_memory_option(Command command, LimitOptions& options);

/// Adds --memory and --timeout to every sub-command that compiles scenes and does not have its own; --memory
/// also to the one that draws them on two devices.
void add_limit_options(Command app, LimitOptions& options);

/// Returns the limits; without --memory, half of the machine's memory.
Result<Limits> resolve(const LimitOptions& options);

} // namespace tidemark::host
