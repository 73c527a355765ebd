// A scene in a window: draws it, feeds it what people do to the window, and reloads it when its files are
// saved. Whatever goes wrong after the start leaves the last good picture running.
#pragma once

#include "cli/controls.hpp"
#include "cli/frame_writer.hpp"
#include "cli/input_script.hpp"
#include "cli/requests.hpp"
#include "platform/file_watcher.hpp"
#include "platform/window.hpp"
#include "render/live_clock.hpp"
#include "render/renderer.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace tidemark::cli {

class Viewer {
public:
    struct Settings {
        SceneRequest scene;
        FrameRequest frames;                   ///< extent, fps, camera
        std::string pass = {};                 ///< the pass to show; empty: Image
        std::optional<render::Date> date = {}; ///< instead of the clock on the wall
        std::filesystem::path record = {};     ///< where what people do is written; empty: nowhere
    };

    /// Opens the window and draws nothing yet. Fails like `load`, Window and Renderer do.
    static Result<Viewer> open(Settings settings);

    /// Until the person closes it.
    Result<int> run();

private:
    /// What a person waits for between saving and seeing.
    struct ReloadTimes {
        std::filesystem::file_time_type saved; ///< the file's own time
        double seen = 0;                       ///< wall clock, as are the next two
        double loaded = 0;
        double compiled = 0;
    };

    Viewer(Settings settings, platform::Window window, platform::FileWatcher watcher,
           render::Renderer renderer);

    // What people do
    void handle(const platform::PointerMoved&) {}
    void handle(const platform::ButtonPressed&) {}
    void handle(const platform::ButtonReleased&) {}
    void handle(const platform::WheelTurned&) {}
    void let_the_scene_know(const platform::InputEvent& event);
    void handle(const platform::KeyPressed& event);
    void handle(const platform::KeyReleased& event);
    void obey(platform::Key key, double now);
    bool scene_reads_keyboard() const;
    void handle(const platform::FramebufferResized& event);
    void handle(const platform::RedrawNeeded&) { stale_ = true; }
    void handle(const platform::CloseRequested&) { closing_ = true; }
    void handle(const platform::FocusLost&) {}
    void save_picture();

    // What happens to files
    void follow_files();
    Result<ReloadTimes> reload();
    void keep_turned_knobs(scene::Scene& fresh) const;
    void report_failure();
    void report_reload();

    void draw(double now);
    void show_title();
    Result<int> finish();
    double seconds_to_sleep(double now) const;
    bool wants_frame(double now) const;

    Settings settings_;
    platform::Window window_; ///< owns the context: first in, last out
    platform::FileWatcher watcher_;
    render::Renderer renderer_;
    render::LiveClock clock_;
    Controls controls_;
    std::optional<Replay> replay_; ///< moves the scene instead of the controls
    InputScript recorded_;
    std::unique_ptr<FrameWriter> writer_; ///< made by the first picture that is saved
    std::optional<Error> failure_;        ///< of the last reload, until mended
    std::optional<double> report_at_;     ///< when the failure is news; before, the file may be half-written
    std::optional<ReloadTimes> reloaded_; ///< until its first frame is on show
    std::string title_;
    render::FrameInputs shown_; ///< inputs of the frame on show
    double next_draw_ = 0;
    bool control_down_ = false;
    bool stale_ = true; ///< the window does not show what it should
    bool closing_ = false;
};

} // namespace tidemark::cli
