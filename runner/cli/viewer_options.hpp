// The options that `view` and `serve` share, and the function with which both run a Viewer.
#pragma once

#include "host/command_line.hpp"
#include "host/requests.hpp"
#include "host/supervision.hpp"
#include "window/viewer.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace tidemark::cli {

struct ViewerOptions {
    host::SceneRequest scene;
    host::FrameOptions frames;
    std::string record;
    host::LimitOptions limits;
    bool editor = false; ///< draws the texts of EditorTexts

    /// Returns whether frames drive the scene instead of the clock; its state is not saved then.
    bool by_frames() const { return frames.input || !record.empty(); }
};

void add_viewer_options(host::Command command, ViewerOptions& options);

/// Waits for the first texts of --editor and adds them to the scene's request; null without --editor.
Result<std::shared_ptr<window::EditorTexts>> open_editor(ViewerOptions& options);

/// Resolves the options. With `rehearses` it starts the Rehearsal, which forks: call it before the process
/// has threads or a context then.
Result<window::Viewer::Settings> resolve(const ViewerOptions& options, host::FrameSequence frames,
                                         const std::shared_ptr<window::EditorTexts>& editor,
                                         bool rehearses = true);

/// Chooses what is shown next in a screen; nothing: the user closes it.
using NextScene = std::function<Result<std::optional<window::Viewer::Settings>>(
    const window::Viewer::Leave& leave, window::Screen&, const host::Interrupt&)>;

/// Opens the screen and shows the scene until it is closed. Ends the process if a driver is still compiling
/// then, because that cannot be cancelled. Without a scene `next` chooses the first one.
Result<int> show(std::optional<window::Viewer::Settings> settings, const window::OpenScreen& open_screen,
                 const NextScene& next = {});

} // namespace tidemark::cli
