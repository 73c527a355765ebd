// The options that `view` and `serve` share, and the function with which both run a Viewer.
#pragma once

#include "host/command_line.hpp"
#include "host/requests.hpp"
#include "host/supervision.hpp"
#include "window/viewer.hpp"

#include <string>

namespace tidemark::cli {

struct ViewerOptions {
    SceneRequest scene;
    FrameOptions frames;
    std::string record;
    LimitOptions limits;

    /// Returns whether frames drive the scene instead of the clock; its state is not saved then.
    bool by_frames() const { return frames.input || !record.empty(); }
};

void add_viewer_options(Command command, ViewerOptions& options);

/// Resolves the options and starts the Rehearsal, which forks: call it before the process has threads or a
/// context.
Result<Viewer::Settings> resolve(const ViewerOptions& options, FrameSequence frames);

/// Opens the screen and shows the scene until it is closed. Ends the process if a driver is still compiling
/// then, because that cannot be cancelled.
Result<int> show(Viewer::Settings settings, const OpenScreen& open_screen);

} // namespace tidemark::cli
