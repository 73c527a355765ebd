// The options shared by several commands: adds them to a command and converts them to requests.
#pragma once

#include "cli/command_line.hpp"
#include "cli/requests.hpp"
#include "platform/device_choice.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

/// Adds SCENE, --set, --define, --channel, --media and --allow-outside.
void add_scene_options(Command command, SceneRequest& request);
/// Adds --media and --allow-outside.
void add_file_options(Command command, SceneRequest& request);

/// Adds --precision and --double-hashes, for every command that draws.
void add_precision_options(Command command, SceneRequest& request);

/// Adds --device and --require-gpu, for every command that draws without a window.
void add_device_options(Command command, platform::DeviceChoice& device);

/// The frame options as they were typed.
struct FrameOptions {
    std::optional<std::string> size;
    std::optional<double> fps;
    std::optional<int> frame;
    std::optional<std::string> frames;
    std::optional<double> time;
    std::optional<std::string> mouse;
    std::optional<std::string> date;
    std::optional<std::string> camera;
    std::optional<std::string> input;
    std::string pass; ///< empty: Image
};

/// Adds --size, --fps, --date, --camera, --pass and --input, which a window has too.
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

} // namespace tidemark::cli
