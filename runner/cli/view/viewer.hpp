// A scene in a window: draws it, feeds it what people do to the window, and reloads it when its files are
// saved. Whatever is wrong with the files is said and waited for, with the last good picture running.
#pragma once

#include "cli/controls.hpp"
#include "cli/frame_writer.hpp"
#include "cli/input_script.hpp"
#include "cli/interrupt.hpp"
#include "cli/options.hpp"
#include "cli/requests.hpp"
#include "cli/view/finite_watch.hpp"
#include "cli/view/live_scene.hpp"
#include "cli/view/sound_player.hpp"
#include "cli/view/stage.hpp"
#include "platform/window.hpp"
#include "render/live_clock.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace tidemark::cli {

class Viewer {
public:
    struct Settings {
        SceneRequest scene;
        FrameSequence frames;                  ///< size, fps, camera, pass
        std::optional<render::Date> date = {}; ///< instead of the clock on the wall
        OutputPath record = {}; ///< where what people do is written; empty: nowhere. Excludes frames.input
        bool plain = false;     ///< never settles
        std::shared_ptr<Rehearsal> rehearsal = {}; ///< tries out what may be too much for the driver
    };

    /// Opens the window and begins to compile. Fails where options are wrong, and as Window does.
    static Result<Viewer> open(Settings settings);

    /// Until the person closes it or interrupts the program. Fails as LiveScene::follow does.
    Result<int> run(const Interrupt& interrupt);

    /// A thread is at work in the driver, which cannot be stopped: whoever wants to end must end the process.
    bool busy() const { return scene_.busy() || sound_->busy(); }

private:
    Viewer(Settings settings, platform::Window window, LiveScene scene);
    bool recording() const { return !settings_.record.empty(); }
    render::LiveClock clock_from(double now) const;

    // What people do
    void listen();
    void handle(const platform::PointerMoved& event) { control(event); }
    void handle(const platform::ButtonPressed& event) { control(event); }
    void handle(const platform::ButtonReleased& event) { control(event); }
    void handle(const platform::WheelTurned& event) { control(event); }
    void control(const ControlEvent& event);
    void handle(const platform::KeyPressed& event);
    void handle(const platform::KeyReleased& event);
    void obey(platform::Key key, double now);
    void escape(double now);
    void forget_what_follows();
    bool scene_reads_keyboard() const;
    void handle(const platform::FramebufferResized& event);
    void handle(const platform::RedrawNeeded&) { stale_ = true; }
    void handle(const platform::CloseRequested&) { closing_ = true; }
    void handle(const platform::FocusLost&) {}
    void save_picture();

    LiveScene::View view() const;
    Result<void> follow_scene(double now);
    Result<void> show(Stage fresh, double now);
    Result<void> swap_in(Stage fresh);
    void settle_after_rest(double now);
    void play_sound();
    void report_reload();
    bool compiles_for_long(double now) const;

    void draw(double now);
    void show_again();
    void look_for_numbers(double now);
    std::string trace_command() const;
    void show_title(double now);
    Result<void> finish();
    double seconds_to_sleep(double now) const;
    bool wants_frame(double now) const;
    bool waits_for_better() const;
    bool moving() const;

    Settings settings_;
    platform::Window window_; ///< owns the context: first in, last out
    LiveScene scene_;
    std::unique_ptr<SoundPlayer> sound_;
    std::optional<Stage> stage_; ///< none before the first picture
    render::LiveClock clock_;
    Controls controls_;
    std::optional<Replay>
        replay_; ///< moves the scene instead of the controls: of a recording, or of this one
    std::unique_ptr<FrameWriter> writer_; ///< made by the first picture that is saved
    FiniteWatch finite_;
    std::optional<ReloadTimes> reloaded_; ///< until its first frame is on show
    std::string title_;
    render::FrameState shown_; ///< the frame on show
    double next_draw_ = 0;
    double listened_at_ = 0;   ///< to what people do, last
    double held_seconds_ = 0;  ///< so long nobody listened before that
    bool of_the_hold_ = false; ///< what people did then is being handled
    bool drew_ = false;        ///< since then
    bool slow_ = false;        ///< the frame that was drawn last held the window
    double given_up_at_ = 0;
    bool given_up_ = false;          ///< frames take too long: none until somebody asks for one, or saves
    double touched_at_ = 0;          ///< when somebody last changed what is drawn, or its size
    std::set<platform::Key> obeyed_; ///< keys that are down and that the scene knows nothing of
    bool control_down_ = false;
    bool stale_ = true;    ///< the window does not show what it should
    bool at_rest_ = false; ///< the next frame is this one, until somebody does something
    bool settled_ = false; ///< the scene on show was, or it was tried
    bool closing_ = false;
};

} // namespace tidemark::cli
