// The options that mean the same wherever they stand: registered on a command, then turned into requests.
#pragma once

#include "cli/command_line.hpp"
#include "cli/requests.hpp"
#include "platform/device_choice.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

/// SCENE, --set, --define, --channel, --media, --allow-outside.
void add_scene_options(Command command, SceneRequest& request);
/// The last two of these.
void add_file_options(Command command, SceneRequest& request);

/// --precision, --double-hashes: of every command that draws.
void add_precision_options(Command command, SceneRequest& request);

/// --device, --require-gpu: of every command that draws without a window.
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

/// --size, --fps, --date, --camera, --pass, --input: what a window knows too.
void add_picture_options(Command command, FrameOptions& options);
/// --frame, --frames, --time, --mouse: what a window gets from the person in front of it.
void add_time_options(Command command, FrameOptions& options);

/// All files that a scene is drawn from: what an output must not replace.
std::vector<std::filesystem::path> files_read(const scene::Scene& scene, const FrameOptions& options = {});

/// Where no --size is typed, that which the scene states.
FrameOptions sized(FrameOptions options, const scene::Scene& scene);
/// The same before the scene is loaded to be drawn. What is wrong with its files is for that load to say.
FrameOptions sized(FrameOptions options, const SceneRequest& request);

/// Checks them all. An error names the option and what to give. `base`: what they leave open.
Result<FrameSequence> resolve(const FrameOptions& options, FrameSequence base = {});

} // namespace tidemark::cli
