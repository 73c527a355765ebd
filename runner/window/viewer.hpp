// A scene on a screen: draws it, passes the user's input to it, and reloads it when its files are saved.
// Reports errors in the files and waits for a fix while the last good picture goes on.
#pragma once

#include "host/moment.hpp"
#include "host/presets.hpp"
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

namespace tidemark::window {

// The state that a window saves for the next window of the same scene, in a file in the user's state folder
// ($XDG_STATE_HOME/tidemark, else ~/.local/state/tidemark). Only `view` reads it.

struct Remembered {
    std::optional<host::Moment> moment{}; ///< last on show: its knobs, camera and time are used
    std::optional<WindowPlace> place{};
    std::optional<RenderScale> scale{};
    bool controls_open = false;
    std::vector<host::Preset> views{};  ///< that are in no file of presets
    double morph_seconds = 0;           ///< how long going to a view takes
    std::vector<Binding> controllers{}; ///< bindings of a MIDI device
    bool paused = false;
    overlay::SoundField sound{};
};

inline constexpr double k_longest_morph_seconds = 60;

/// Returns the saved state. Returns nothing where there is none, or where it cannot be used, which is
/// reported in a line.
std::optional<Remembered> recall(const std::filesystem::path& scene);

/// Writes the state, completely or not at all; prints a line if it cannot be written.
void remember(const std::filesystem::path& scene, const Remembered& state);

/// Returns a summary for the user: `height = 2, camera 70,10,4, 2.500 s`.
std::string words_of(const Remembered& state);

class Viewer {
public:
    struct Settings {
        host::SceneRequest scene;
        host::FrameSequence frames;                  ///< size, fps, camera, pass
        std::optional<render::Date> date = {};       ///< instead of the current date
        OutputPath record = {};                      ///< file for the user's input; excludes frames.input
        RenderScale scale = {};                      ///< the initial one
        std::optional<double> adaptive = {};         ///< frame rate to hold; none: the scale is constant
        bool plain = false;                          ///< no background optimisation
        bool remembers = false;                      ///< saves its state for the next window
        bool controls = false;                       ///< open at the start
        bool sounds = true;                          ///< plays the scene's sound
        bool paused = false;                         ///< at the start
        bool messages = false;                       ///< shows short messages over the picture
        bool opens_others = false;                   ///< scenes that are dropped on it: `leave`
        bool in_gallery = false;                     ///< and those of a gallery, by keys
        std::optional<Remembered> left = {};         ///< state of the last window
        std::optional<LiveInputRequest> inputs = {}; ///< excludes frames.input
        std::shared_ptr<EditorTexts> editor = {};    ///< unsaved texts; its end closes the screen
        std::shared_ptr<Rehearsal> rehearsal = {};   ///< tries scenes that may be too much for the driver
    };

    /// Opens the screen and starts to compile. Fails where options are wrong, and as `open_screen` does.
    static Result<Viewer> open(Settings settings, const OpenScreen& open_screen);

    /// Runs until the user closes the screen or interrupts the program. Returns the exit code; fails as
    /// LiveScene::follow does, and if the graphics driver was reset.
    Result<int> run(const host::Interrupt& interrupt);

    /// Returns whether `run` failed because the graphics driver was reset; another Viewer can continue then.
    bool was_reset() const { return end_ == End::driver_reset; }
    /// The next thing to show in the same screen.
    struct Leave {
        enum class To { gallery, next, previous, files } to = To::gallery;
        std::vector<std::string> files{}; ///< to be opened
    };
    /// Returns it if `run` ended for that, and not for the user who closed the screen.
    const std::optional<Leave>& leave() const { return leave_; }
    /// Returns the screen, for the next scene. To be called after `run`; then destroy this object.
    std::unique_ptr<Screen> release_screen() { return std::move(screen_); }

    /// Return the current request for the scene, and the state for the next window.
    const host::SceneRequest& request() const { return scene_.request(); }
    std::optional<Remembered> state() const;

    /// Wakes `run`. May be called from any thread.
    void wake() const { screen_->wake(); }

    /// Returns whether a thread is in a driver call that cannot be stopped. To exit at once then, the process
    /// must be ended.
    bool busy() const {
        return scene_.busy() || sound_->busy() || pump_.driver_busy() || picture_.lens().busy();
    }

private:
    /// Why `run` ends.
    enum class End { none, closed, driver_reset, left };
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
    void handle_all(const std::vector<host::InputEvent>& events);
    void handle(const host::PointerMoved& event);
    void handle(const host::ButtonPressed& event) { control(event); }
    void handle(const host::ButtonReleased& event) { control(event); }
    void handle(const host::WheelTurned& event) { control(event); }
    void handle(const host::KeyPressed& event);
    void handle(const host::KeyReleased& event);
    void handle(const host::FramebufferResized& event);
    void handle(const host::RedrawNeeded& event);
    void handle(const host::CloseRequested&) { end_ = End::closed; }
    void handle(const host::TextTyped&) {}
    void handle(const host::FocusLost&) {}
    void handle(const host::FilesDropped& event);
    void control(const host::ControlEvent& event);
    void obey(host::Key key, double now);
    void obey_with_control(host::Key key, double now);
    bool leave_by(host::Key key);
    void escape(double now);
    bool close_innermost();
    void close_on_second_press(double now);
    void tell(std::string_view topic, std::string text, double seconds = Messages::k_seconds);
    void announce(std::string_view topic, const std::string& line, double seconds = Messages::k_seconds);
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
    bool sound_runs() const;
    void set_volume(const overlay::SoundField& wanted);
    void change_volume(int steps);
    void report_reload();
    bool compiles_for_long(double now) const;
    bool knobs_may_turn() const;
    void leave_optimised();
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
    overlay::Model overlay_model();
    ShownMoment shown_moment() const;
    const gl::Texture* marked_picture();
    void toggle_marks();
    void toggle_freeze();
    render::FrameInputs inputs_of_shown() const;
    void look_for_numbers(double now);
    std::string no_lens() const;
    void follow_lens(double now);
    void report_lens();
    void toggle_status();
    std::string status_line(double now) const;
    Extent quick_extent() const;
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
    host::Moment moment() const;
    KeptPicture read_picture() const;
    bool has_frame();
    void save_picture();
    void copy_moment();
    void copy_picture();
    void toggle_video();
    void record_video(double now);
    void report_video();
    void take_input_file(const std::string& file);
    void keep_moment();
    host::Preset view_on_show() const;
    void open_presets();
    void write_presets();
    void advance_morph(double now);
    void adopt_view(const host::Preset& view);
    void take_up(const Remembered& left);
    Edits edits() const;
    void follow_edits(double now, bool morphing = false);
    void go_to(const std::optional<Edits>& wanted, const char* done);

    // Commands of the panels and of live inputs: viewer_commands.cpp
    void carry_out_all(const overlay::Commands& commands);
    void take_inputs();
    void toggle_controls();
    void toggle_help();
    void carry_out(const overlay::TurnKnob& command);
    void carry_out(const overlay::ResetKnob& command);
    void carry_out(const overlay::ResetKnobs& command);
    void carry_out(const overlay::CopyKnobs& command);
    void carry_out(const overlay::WriteKnobs& command);
    void carry_out(const overlay::LearnController& command);
    void carry_out(const overlay::ForgetController& command);
    void carry_out(const overlay::OpenEditor& command);
    void carry_out(const overlay::Define& command) { scene_.define(command.name, command.value, view()); }
    void carry_out(const overlay::Undefine& command) { scene_.define(command.name, std::nullopt, view()); }
    void carry_out(const overlay::ShowPicture& command) { picture_.show_large(command.index); }
    void carry_out(const overlay::LookAtPicture& command) { picture_.look(command.look); }
    void carry_out(const overlay::KeepView&) { keep_moment(); }
    void carry_out(const overlay::GoToView& command);
    void carry_out(const overlay::ForgetView& command) { overlay_.forget_view(command.index); }
    void carry_out(const overlay::RenameView& command);
    void carry_out(const overlay::SetMorph& command) { overlay_.set_morph(command.seconds); }
    void carry_out(const overlay::OpenScene&) {}
    void carry_out(const overlay::GalleryColumns&) {}
    void carry_out(const overlay::TogglePause&) { obey(host::Key::space, now_seconds()); }
    void carry_out(const overlay::SetPlaying& command);
    void carry_out(const overlay::Restart&) { obey(host::Key::home, now_seconds()); }
    void carry_out(const overlay::Seek& command);
    void carry_out(const overlay::HoldBar& command);
    void carry_out(const overlay::GrowBar&) { timeline_.grow_bar(shown_.state.seconds()); }
    void carry_out(const overlay::GiveUpSeek&);
    void carry_out(const overlay::SetSpeed& command) { timeline_.set_speed(command.speed, now_seconds()); }
    void carry_out(const overlay::SetLoop& command) { timeline_.set_loop(command); }
    void carry_out(const overlay::SetVolume& command) { set_volume(command.sound); }
    void carry_out(const overlay::SetLens& command);
    void carry_out(const overlay::WatchHotLines& command) { picture_.lens().watch_lines(command.open); }

    Settings settings_;
    std::unique_ptr<Screen> screen_; ///< owns the first context, so it is destroyed last
    LiveScene scene_;
    std::unique_ptr<LiveInputs> inputs_; ///< null: none were requested
    std::unique_ptr<SoundPlayer> sound_;
    overlay::SoundField volume_;
    std::optional<Stage> stage_; ///< none before the first picture
    Timeline timeline_;
    FramePump pump_;
    PictureView picture_;
    Overlay overlay_;
    Recorder recorder_;
    host::Controls controls_;
    History history_;
    std::optional<host::PresetFile> presets_;                          ///< none: the views are in no file
    std::shared_ptr<const std::vector<host::Preset>> presets_written_; ///< the views that are in the file
    std::optional<host::Morph> morph_;
    bool pointer_moves_mouse_ = false; ///< without a button: the scene is a text of another host
    std::set<host::Button> buttons_;   ///< that are down
    bool edited_ = false;              ///< the user may have changed something that can be undone
    double escaped_at_ = -std::numeric_limits<double>::infinity(); ///< when Esc last had nothing to close
    WindowKeys keys_;
    Shown shown_;
    std::vector<host::InputEvent> events_held_; ///< kept until the driver is free
    End end_ = End::none;
    std::optional<Leave> leave_;
    PassCosts costs_; ///< while the controls are open or the scale adapts
    FiniteWatch finite_;
    std::unique_ptr<OriginSearch> search_; ///< null: none in progress
    std::optional<ReloadTimes> reloaded_;  ///< until its first frame is shown
    double touched_at_ = 0;                ///< when the user last changed the picture or its size
    bool settled_ = false;                 ///< background optimisation was tried for the scene on show
};

} // namespace tidemark::window
