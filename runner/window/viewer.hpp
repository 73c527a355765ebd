// A scene on a screen: draws it, passes the user's input to it, and reloads it when its files are saved.
// Reports errors in the files and waits for a fix while the last good picture goes on.
#pragma once

#include "host/moment.hpp"
#include "host/requests.hpp"
#include "host/supervision.hpp"
#include "window/frame_pump.hpp"
#include "window/inspection.hpp"
#include "window/live_inputs.hpp"
#include "window/live_scene.hpp"
#include "window/overlay.hpp"
#include "window/picture_view.hpp"
#include "window/recorder.hpp"
#include "window/screen.hpp"
#include "window/sound_player.hpp"
#include "window/stage.hpp"
#include "window/timeline.hpp"
#include "window/window_keys.hpp"

#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace tidemark::cli {

// The state that a window saves for the next window of the same scene, in a file in the user's state folder
// ($XDG_STATE_HOME/tidemark, else ~/.local/state/tidemark). Only `view` reads it.

struct Remembered {
    std::optional<Moment> moment{}; ///< last on show: its knobs, camera and time are used
    std::optional<platform::WindowPlace> place{};
    std::optional<RenderScale> scale{};
    bool controls_open = false;
    std::vector<Moment> views{};
    std::vector<live::Binding> controllers{}; ///< bindings of a MIDI device
    bool paused = false;
};

/// Returns the saved state. Returns nothing where there is none, or where it cannot be used, which is
/// reported in a line.
std::optional<Remembered> recall(const std::filesystem::path& scene);

/// Writes the state, completely or not at all; prints a line if it cannot be written.
void remember(const std::filesystem::path& scene, const Remembered& state);

/// Returns a summary for the user: `height = 2, camera 70,10,4, 2.500 s, 3 views`.
std::string words_of(const Remembered& state);

class Viewer {
public:
    struct Settings {
        SceneRequest scene;
        FrameSequence frames;                        ///< size, fps, camera, pass
        std::optional<render::Date> date = {};       ///< instead of the current date
        OutputPath record = {};                      ///< file for the user's input; excludes frames.input
        RenderScale scale = {};                      ///< the initial one
        std::optional<double> adaptive = {};         ///< frame rate to hold; none: the scale is constant
        bool plain = false;                          ///< no background optimisation
        bool remembers = false;                      ///< saves its state for the next window
        bool controls = false;                       ///< open at the start
        bool sounds = true;                          ///< plays the Sound pass
        bool paused = false;                         ///< at the start
        bool messages = false;                       ///< shows short messages over the picture
        std::optional<Remembered> left = {};         ///< state of the last window
        std::optional<LiveInputRequest> inputs = {}; ///< excludes frames.input
        std::shared_ptr<Rehearsal> rehearsal = {};   ///< tries scenes that may be too much for the driver
    };

    /// Opens the screen and starts to compile. Fails where options are wrong, and as `open_screen` does.
    static Result<Viewer> open(Settings settings, const OpenScreen& open_screen);

    /// Runs until the user closes the screen or interrupts the program. Returns the exit code; fails as
    /// LiveScene::follow does, and if the graphics driver was reset.
    Result<int> run(const Interrupt& interrupt);

    /// Returns whether `run` failed because the graphics driver was reset; another Viewer can continue then.
    bool was_reset() const { return end_ == End::driver_reset; }
    /// Return the current request for the scene, and the state for the next window.
    const SceneRequest& request() const { return scene_.request(); }
    std::optional<Remembered> state() const;

    /// Wakes `run`. May be called from any thread.
    void wake() const { screen_->wake(); }

    /// Returns whether a thread is in a driver call that cannot be stopped. To exit at once then, the process
    /// must be ended.
    bool busy() const { return scene_.busy() || sound_->busy() || pump_.driver_busy(); }

private:
    /// Why `run` ends.
    enum class End { none, closed, driver_reset };
    /// The frame on show.
    struct Shown {
        render::FrameState state;
        double begun = 0;     ///< when drawing it began
        bool current = false; ///< it is of the current text, and nothing has restarted since
    };
    Viewer(Settings settings, std::unique_ptr<Screen> screen, LiveScene scene);
    Result<void> open_inputs();

    // The event loop and the user's input: viewer.cpp
    void listen();
    void handle_all(const std::vector<platform::InputEvent>& events);
    void handle(const platform::PointerMoved& event) { control(event); }
    void handle(const platform::ButtonPressed& event) { control(event); }
    void handle(const platform::ButtonReleased& event) { control(event); }
    void handle(const platform::WheelTurned& event) { control(event); }
    void handle(const platform::KeyPressed& event);
    void handle(const platform::KeyReleased& event);
    void handle(const platform::FramebufferResized& event);
    void handle(const platform::RedrawNeeded& event);
    void handle(const platform::CloseRequested&) { end_ = End::closed; }
    void handle(const platform::TextTyped&) {}
    void handle(const platform::FocusLost&) {}
    void control(const ControlEvent& event);
    void obey(platform::Key key, double now);
    void obey_with_control(platform::Key key, double now);
    void escape(double now);
    bool close_innermost();
    void close_on_second_press(double now);
    void tell(std::string_view topic, std::string text, double seconds = Messages::k_seconds);
    void greet();
    double seconds_to_sleep(double now) const;
    FramePump::Around around() const;
    std::string state_words(double now) const;
    void show_title(double now);
    Result<void> check_driver();
    Result<void> finish();

    // The scene: viewer.cpp
    LiveScene::View view() const;
    Result<void> follow_scene(double now);
    Result<void> show(Stage fresh, double now);
    Result<void> swap_in(Stage fresh);
    void release_knobs();
    void settle_after_rest(double now);
    void play_sound();
    void report_reload();
    bool compiles_for_long(double now) const;
    bool knobs_may_turn() const;
    scene::Scene turned_scene() const;
    std::vector<std::filesystem::path> scene_files() const;

    // Drawing: viewer_drawing.cpp
    Extent drawn_extent() const { return picture_.drawn(screen_->extent()); }
    bool fit_drawing();
    bool change_scale(RenderScale wanted);
    void set_scale(RenderScale wanted);
    void toggle_adaptive();
    std::vector<render::PassTimer>* time_next_frame();
    void draw(double now);
    render::FrameState next_state(double now);
    void carry_on(double now);
    void show_frame(const FramePump::Made& frame);
    bool make_way();
    void cancel_frame();
    void stop_frames(double now);
    void report_slow_part(double now);
    void present(bool fresh);
    live::Model overlay_model();
    ShownMoment shown_moment() const;
    const gl::Texture* marked_picture();
    void toggle_marks();
    void toggle_freeze();
    render::FrameInputs inputs_of_shown() const;
    void look_for_numbers(double now);
    std::vector<std::string> trace_words() const;
    void trace_pixel();
    void take_origin();

    // Time: viewer_commands.cpp
    bool has_feedback() const { return stage_ && stage_->renderer().plan().feedback; }
    void seek(double seconds, double now);
    void advance_seek();
    void go_round(double now);
    void forget_what_follows() { recorder_.go_back(timeline_.next_frame_number()); }

    // The moment on show: viewer_commands.cpp
    Moment moment() const;
    KeptPicture read_picture() const;
    bool has_frame();
    void save_picture();
    void copy_moment();
    void keep_moment();
    void take_up(const Remembered& left);
    Edits edits() const;
    void follow_edits(double now);
    void go_to(const std::optional<Edits>& wanted, const char* done);

    // Commands of the panels and of live inputs: viewer_commands.cpp
    void carry_out_all(const live::Commands& commands);
    void take_inputs();
    void toggle_controls();
    void toggle_help();
    void carry_out(const live::TurnKnob& command);
    void carry_out(const live::ResetKnob& command);
    void carry_out(const live::ResetKnobs& command);
    void carry_out(const live::CopyKnobs& command);
    void carry_out(const live::WriteKnobs& command);
    void carry_out(const live::LearnController& command);
    void carry_out(const live::ForgetController& command);
    void carry_out(const live::OpenEditor& command);
    void carry_out(const live::Define& command) { scene_.define(command.name, command.value, view()); }
    void carry_out(const live::Undefine& command) { scene_.define(command.name, std::nullopt, view()); }
    void carry_out(const live::ShowPicture& command) { picture_.show_large(command.index); }
    void carry_out(const live::LookAtPicture& command) { picture_.look(command.look); }
    void carry_out(const live::KeepView&) { keep_moment(); }
    void carry_out(const live::GoToView& command);
    void carry_out(const live::ForgetView& command) { overlay_.forget_view(command.index); }
    void carry_out(const live::TogglePause&) { obey(platform::Key::space, now_seconds()); }
    void carry_out(const live::SetPlaying& command);
    void carry_out(const live::Restart&) { obey(platform::Key::home, now_seconds()); }
    void carry_out(const live::Seek& command);
    void carry_out(const live::HoldBar& command);
    void carry_out(const live::GrowBar&) { timeline_.grow_bar(shown_.state.seconds()); }
    void carry_out(const live::GiveUpSeek&);
    void carry_out(const live::SetSpeed& command) { timeline_.set_speed(command.speed, now_seconds()); }
    void carry_out(const live::SetLoop& command) { timeline_.set_loop(command); }

    Settings settings_;
    std::unique_ptr<Screen> screen_; ///< owns the first context, so it is destroyed last
    LiveScene scene_;
    std::unique_ptr<LiveInputs> inputs_; ///< null: none were requested
    std::unique_ptr<SoundPlayer> sound_;
    std::optional<Stage> stage_; ///< none before the first picture
    Timeline timeline_;
    FramePump pump_;
    PictureView picture_;
    Overlay overlay_;
    Recorder recorder_;
    Controls controls_;
    History history_;
    std::set<platform::Button> buttons_; ///< that are down
    bool edited_ = false;                ///< the user may have changed something that can be undone
    double escaped_at_ = -std::numeric_limits<double>::infinity(); ///< when Esc last had nothing to close
    WindowKeys keys_;
    Shown shown_;
    std::vector<platform::InputEvent> events_held_; ///< kept until the driver is free
    End end_ = End::none;
    PassCosts costs_; ///< while the controls are open or the scale adapts
    FiniteWatch finite_;
    std::unique_ptr<OriginSearch> search_; ///< null: none in progress
    std::optional<ReloadTimes> reloaded_;  ///< until its first frame is shown
    double touched_at_ = 0;                ///< when the user last changed the picture or its size
    bool settled_ = false;                 ///< background optimisation was tried for the scene on show
};

} // namespace tidemark::cli
