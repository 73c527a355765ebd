// A scene on a screen: draws it, passes the user's input to it, and reloads it when its files are saved.
// Reports errors in the files and waits for a fix while the last good picture goes on.
#pragma once

#include "host/frame_files.hpp"
#include "host/input_script.hpp"
#include "host/moment.hpp"
#include "host/requests.hpp"
#include "host/supervision.hpp"
#include "render/buffer_views.hpp"
#include "render/frame_in_parts.hpp"
#include "render/picture_parts.hpp"
#include "window/frame_pacing.hpp"
#include "window/inspection.hpp"
#include "window/live_inputs.hpp"
#include "window/live_scene.hpp"
#include "window/remembered.hpp"
#include "window/screen.hpp"
#include "window/seek.hpp"
#include "window/sound_player.hpp"
#include "window/source_errors.hpp"
#include "window/stage.hpp"
#include "window/window_keys.hpp"

#include <memory>
#include <optional>
#include <string>

namespace tidemark::cli {

class Viewer {
public:
    struct Settings {
        SceneRequest scene;
        FrameSequence frames;                  ///< size, fps, camera, pass
        std::optional<render::Date> date = {}; ///< instead of the current date
        OutputPath record = {};         ///< file for the user's input; empty: none. Excludes frames.input
        render::RenderScale scale = {}; ///< the initial one
        std::optional<double> adaptive = {};         ///< frame rate to hold; none: the scale is constant
        bool plain = false;                          ///< no background optimisation
        bool remembers = false;                      ///< saves its state for the next window
        bool controls = false;                       ///< open at the start
        bool sounds = true;                          ///< plays the Sound pass
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
    bool was_reset() const { return was_reset_; }
    /// Return the current request for the scene, and the state for the next window.
    const SceneRequest& request() const { return scene_.request(); }
    std::optional<Remembered> state() const;

    /// Wakes `run`. May be called from any thread.
    void wake() const { screen_->wake(); }

    /// Returns whether a thread is in a driver call that cannot be stopped. To exit at once then, the process
    /// must be ended.
    bool busy() const { return scene_.busy() || sound_->busy() || driver_is_at_work(); }

private:
    /// A picture to be saved, with the metadata that reproduces it.
    struct Picture {
        int frame = 0;
        image::Image pixels;
        image::PictureFormat format;
    };
    /// A frame that stays on show.
    struct Frozen {
        gl::RenderTarget target; ///< in the Stage's context
        Picture picture;
        Moment moment;
    };
    /// A frame that is drawn in parts.
    struct Making {
        render::FrameState state;
        render::FrameInParts frame;
        double begun;
        bool wanted;       ///< it shows a change by the user
        bool said = false; ///< the message that it may never end was printed
    };
    Viewer(Settings settings, std::unique_ptr<Screen> screen, LiveScene scene);
    bool recording() const { return !settings_.record.empty(); }
    render::LiveClock clock_from(double now) const;

    // User input
    void listen();
    void handle(const platform::PointerMoved& event) { control(event); }
    void handle(const platform::ButtonPressed& event) { control(event); }
    void handle(const platform::ButtonReleased& event) { control(event); }
    void handle(const platform::WheelTurned& event) { control(event); }
    void handle(const platform::KeyPressed& event);
    void handle(const platform::KeyReleased& event);
    void obey(platform::Key key, double now);
    void handle_all(const std::vector<platform::InputEvent>& events);
    void escape(double now);
    void forget_what_follows();
    void handle(const platform::TextTyped&) {}
    void handle(const platform::RedrawNeeded&) { stale_ = stale_overlay_ = true; }
    void handle(const platform::CloseRequested&) { closing_ = true; }
    void handle(const platform::FocusLost&) {}

    // The size of the drawn picture: viewer_drawing.cpp
    Extent drawn_extent() const;
    void control(const ControlEvent& event);
    void handle(const platform::FramebufferResized& event);
    bool fit_drawing();
    bool change_scale(render::RenderScale wanted);
    void set_scale(render::RenderScale wanted);
    void toggle_adaptive();
    std::vector<render::PassTimer>* time_next_frame();

    // The frozen picture: viewer_drawing.cpp
    void toggle_freeze();
    const gl::RenderTarget* target_on_show() const;

    // The moment on show: viewer_overlay.cpp
    Moment moment() const;
    image::PictureFormat format_of_picture() const;
    Picture read_picture() const;
    bool has_frame() const;
    void save_picture();
    void copy_moment();
    void keep_moment();
    void take_up(const Remembered& left);
    void leave() const;
    Result<void> check_driver();
    void carry_out(const live::KeepView&) { keep_moment(); }
    void carry_out(const live::GoToView& command);
    void carry_out(const live::ForgetView& command);

    // The overlay: viewer_overlay.cpp
    void toggle_controls();
    void show_picture_of(platform::Key digit);
    void toggle_help();
    live::Model overlay_model();
    void obey_overlay();
    void carry_out(const live::TurnKnob& command);
    void carry_out(const live::ResetKnob& command);
    void carry_out(const live::ResetKnobs& command);
    void carry_out(const live::CopyKnobs& command);
    void carry_out(const live::WriteKnobs& command);
    void carry_out(const live::OpenEditor& command);
    void carry_out(const live::Define& command);
    void carry_out(const live::Undefine& command);
    void carry_out(const live::ShowPicture& command) { large_ = command.index; }
    void carry_out(const live::TogglePause&) { obey(platform::Key::space, now_seconds()); }
    void carry_out(const live::Restart&) { obey(platform::Key::home, now_seconds()); }
    void carry_out(const live::Seek& command) { seek(command.seconds, now_seconds()); }
    void carry_out(const live::GiveUpSeek&);
    void carry_out(const live::SetSpeed& command);
    void carry_out(const live::SetLoop& command);
    live::TimeField time_field() const;
    void seek(double seconds, double now);
    void step_there();
    void rest_unwatched(double now);
    void go_round(double now);
    bool has_feedback() const { return stage_ && stage_->renderer().plan().feedback; }
    bool knobs_may_turn() const;
    bool overlay_due() const;
    scene::Scene turned_scene() const;

    // Live inputs: live_inputs.cpp
    Result<void> open_inputs();
    void take_inputs();
    render::FrameInputs heard_inputs(const render::FrameState& state);
    render::FrameInputs inputs_at(const render::FrameState& state) const;
    render::FrameInputs inputs_on_show() const;
    std::vector<scene::Knob> turned_knobs() const;
    void carry_out(const live::SetPlaying& command);
    void carry_out(const live::LearnController& command);
    void carry_out(const live::ForgetController& command);

    // Inspecting the picture: inspection.cpp
    void toggle_magnifier();
    void toggle_marks();
    render::ShownFloats& floats();
    std::optional<live::MagnifierField> magnifier_field();
    const gl::Texture* marked_picture();
    void look_at_pictures(live::Model& model);
    void carry_out(const live::LookAtPicture& command) { look_ = command.look; }
    void forget_looking();
    void trace_pixel();
    void take_origin();

    LiveScene::View view() const;
    Result<void> follow_scene(double now);
    Result<void> show(Stage fresh, double now);
    Result<void> swap_in(Stage fresh);
    void release_knobs();
    void settle_after_rest(double now);
    void play_sound();
    void report_reload();

    // The title: viewer_overlay.cpp
    bool compiles_for_long(double now) const;
    void show_title(double now);

    // Frames, whole or in parts: viewer_drawing.cpp
    void draw(double now);
    render::FrameState next_state(double now);
    void draw_whole(const render::FrameState& state, bool wanted, double now,
                    std::vector<render::PassTimer>* timers);
    void begin_frame(const render::FrameState& state, bool wanted, double now);
    void carry_on(double now);
    void frame_is_made(bool drawn);
    void frame_is_drawn(const render::FrameState& state, double begun, bool drawn, bool wanted);
    void drop_frame();
    void give_frames_up(double now);
    void say_what_holds(double now);
    void doubt_pace();
    bool goes_on() const { return making_ && !waits_for_better(); }
    bool draws_for_long(double now) const;
    bool drawing_would_hold() const;
    const std::optional<render::FrameInParts::UnderWay>& driver_at() const;
    bool make_way();
    bool driver_is_at_work() const;
    bool driver_is_held(double now) const;
    std::string drawing_words(double now) const;
    void present(bool fresh);
    ShownMoment shown_moment() const;
    void look_for_numbers(double now);
    std::vector<std::string> trace_words() const;
    Result<void> finish();
    double seconds_to_sleep(double now) const;
    bool wants_frame(double now) const;
    bool waits_for_better() const;
    bool moving() const;

    Settings settings_;
    std::unique_ptr<Screen> screen_; ///< owns the first context, so it is destroyed last
    LiveScene scene_;
    std::unique_ptr<LiveInputs> inputs_; ///< null: none were requested
    live::ControllerMap controllers_;    ///< of this scene, also without a MIDI device
    std::unique_ptr<SoundPlayer> sound_;
    std::optional<Stage> stage_; ///< none before the first picture
    render::LiveClock clock_;
    render::FramePace pace_;
    render::PartSize part_size_;
    std::optional<Making> making_;                         ///< none: no frame is half drawn
    std::optional<render::FrameInParts::UnderWay> ending_; ///< the driver's part of a cancelled frame
    std::vector<platform::InputEvent> events_held_;        ///< kept until the driver is free
    double clock_shown_at_ = 0;                            ///< when a slow frame's progress was last shown
    bool parts_fail_ = false;                              ///< there is not enough memory for them
    bool save_due_ = false;                                ///< the next frame is to be saved
    bool was_reset_ = false;                               ///< the graphics driver
    bool has_frame_ = false; ///< a frame of the current text was drawn, and nothing has restarted since
    Controls controls_;
    render::RenderScale scale_;
    std::optional<render::AdaptiveScale> adaptive_; ///< none: the scale is constant
    std::optional<Replay>
        replay_; ///< drives the scene instead of controls_: a given recording, or the one being made
    std::unique_ptr<FrameWriter> writer_; ///< created by the first saved picture
    FiniteWatch finite_;
    std::optional<ReloadTimes> reloaded_; ///< until its first frame is shown
    std::string title_;
    render::FrameState shown_; ///< the frame on show
    double shown_begun_ = 0;   ///< when drawing it began
    double next_draw_ = 0;
    double listened_at_ = 0;   ///< when events were last handled
    double held_seconds_ = 0;  ///< time before that without handling events
    bool of_the_hold_ = false; ///< handling the events that came in that time
    bool drew_ = false;        ///< a frame was drawn since then
    bool slow_ = false;        ///< the last drawn frame blocked the window
    double given_up_at_ = 0;
    bool given_up_ = false; ///< slow frames were cancelled: none until the user requests one or saves
    std::optional<double> unwatched_since_;
    double touched_at_ = 0; ///< when the user last changed the picture or its size
    WindowKeys keys_;
    ErrorBoard errors_;
    PassCosts costs_; ///< while the controls are open or the scale adapts
    Magnifier magnifier_;
    std::optional<render::ShownFloats> floats_; ///< of the Stage, created on demand
    std::optional<render::NumberMarks> marks_;  ///< likewise
    std::optional<PictureViews> pictures_;      ///< likewise, while the controls are open
    bool marks_shown_ = false;
    std::optional<Frozen> frozen_;            ///< shown instead of later frames
    std::unique_ptr<OriginSearch> search_;    ///< null: none in progress
    ErrorBoard origin_;                       ///< its result
    std::unique_ptr<SteppingThere> stepping_; ///< null: not seeking
    live::SetLoop loop_;                      ///< of time
    std::vector<Moment> views_;               ///< kept by the user
    std::optional<double> going_to_;          ///< iTime of the view that the next Stage shows
    std::optional<size_t> large_;             ///< index into the overlay's pictures
    live::LookField look_;                    ///< how that one is viewed
    std::optional<std::vector<live::DefinitionField>> defined_; ///< of the scene on show; none: not read yet
    bool controls_open_ = false;                                ///< in the overlay
    bool help_open_ = false;                                    ///< likewise
    bool stale_overlay_ = false;                                ///< it is out of date
    bool stale_ = true;                                         ///< the picture is out of date
    bool at_rest_ = false; ///< the next frame would be the same, until there is input
    bool settled_ = false; ///< background optimisation was tried for the scene on show
    bool closing_ = false;
};

} // namespace tidemark::cli
