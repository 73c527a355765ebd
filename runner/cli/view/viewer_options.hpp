// What the options of `view` and of `serve` have in common, and what both do with a Viewer.
#pragma once

#include "cli/command_line.hpp"
#include "cli/interrupt.hpp"
#include "cli/limits.hpp"
#include "cli/options.hpp"
#include "cli/view/viewer.hpp"

#include <string>

namespace tidemark::cli {

struct ViewerOptions {
    SceneRequest scene;
    FrameOptions frames;
    std::string record;
    LimitOptions limits;

    /// The scene is moved by frames, not by the clock: nothing of it is remembered.
    bool by_frames() const { return frames.input || !record.empty(); }
};

void add_viewer_options(Command command, ViewerOptions& options);

/// Starts the Rehearsal, which forks: to be called before there are threads or a context.
Result<Viewer::Settings> resolve(const ViewerOptions& options, FrameSequence frames);

/// Opens the screen and shows the scene there to the end. Where a driver is still compiling then, which
/// cannot be waited for, the process ends in here.
Result<int> show(Viewer::Settings settings, const OpenScreen& open_screen);

} // namespace tidemark::cli
