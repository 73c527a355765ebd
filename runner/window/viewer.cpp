#include "window/viewer.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/supervision.hpp"
#include "host/console.hpp"
#include "host/scene_report.hpp"
#include "render/gl_context.hpp"
#include "shader/pass_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace tidemark::window {

using namespace host;
namespace {

using host::Key;

constexpr Key k_i{'I'}, k_l{'L'}, k_q{'Q'}, k_u{'U'}, k_v{'V'}, k_x{'X'}, k_y{'Y'};

/// Largest age of the seconds in the title.
constexpr double k_title_seconds = 0.25;
/// Esc closes the window when it is pressed again within this time.
constexpr double k_second_press_seconds = 1;
/// Compiling is not mentioned before this time.
constexpr double k_short_wait_seconds = 0.3;

render::RenderOptions options_for(Extent drawn, const Viewer::Settings& settings) {
    render::RenderOptions options{drawn, image::SampleType::u8, settings.frames.state.pass,
                                  precision_of(settings.scene)};
    options.marks_non_finite = true;
    return options;
}

} // namespace

/// Frames are counted instead of time while recording or replaying: a wall clock cannot be reproduced.
Viewer::Viewer(Settings settings, std::unique_ptr<Screen> screen, LiveScene scene)
    : settings_(std::move(settings)), screen_(std::move(screen)), scene_(std::move(scene)),
      sound_(std::make_unique<SoundPlayer>()),
      timeline_(now_seconds(), settings_.frames.state.fps,
                settings_.frames.input || !settings_.record.empty() ? Timeline::Source::frames
                                                                    : Timeline::Source::wall_clock),
      pump_(settings_.frames.state.fps), picture_(settings_.scale), overlay_(settings_.controls),
      recorder_(settings_.record, settings_.frames.input, settings_.frames.state.camera),
      controls_(settings_.frames.state.camera) {
    if (!settings_.messages)
        overlay_.messages().turn_off();
    if (settings_.adaptive)
        toggle_adaptive();
    if (settings_.left)
        take_up(*settings_.left);
    if (settings_.remembers)
        open_presets();
}

Result<Viewer> Viewer::open(Settings settings, const OpenScreen& open_screen) {
    auto first = LiveScene::load(settings.scene);
    if (!first.scene && first.scene.error().code == ErrorCode::usage)
        return fail(std::move(first.scene.error()));
    settings.record = settings.record.sparing({settings.scene.path}); // it may not load yet
    if (first.scene)
        settings.record = settings.record.sparing(files_read(*first.scene));
    if (!settings.record.empty())
        TRY(settings.record.place());
    const std::string name = first.scene ? first.scene->name() : settings.scene.path.stem().string();
    auto screen = open_screen(name + " - tidemark");
    if (!screen) // without a screen nothing can wait for a save
        return fail(std::move(first.scene ? screen.error() : first.scene.error()));
    const Extent drawn = settings.scale.drawn((*screen)->extent());
    const LiveScene::View view{
        [&] { return (*screen)->create_context(); }, options_for(drawn, settings), {}, settings.rehearsal};
    auto live = LiveScene::create(settings.scene, std::move(first), view, [&on = **screen] { on.wake(); });
    if (!live)
        return fail(std::move(live.error()));
    Viewer viewer(std::move(settings), *std::move(screen), *std::move(live));
    TRY(viewer.open_inputs());
    return viewer;
}

/// Opens live inputs: their messages are carried out like commands of the panels, so that they are recorded,
/// too.
Result<void> Viewer::open_inputs() {
    if (settings_.inputs && recorder_.mode() == Recorder::Mode::recording)
        say_what_is_not_recorded(*settings_.inputs);
    if (settings_.inputs)
        inputs_ = TRY(LiveInputs::open(*settings_.inputs, [&on = *screen_] { on.wake(); }));
    return {};
}

Result<int> Viewer::run(const Interrupt& interrupt) {
    const auto rescue = screen_->when_lost([this](std::string_view what) {
        const auto saved = finish();
        say(to_string(saved ? Error{ErrorCode::no_context, std::string(what)} : saved.error()));
        exit_at_once(exit_code(ErrorCode::no_context));
    });
    const EditorTexts::Waking waking(settings_.editor.get(), [this] { screen_->wake(); });
    pump_.end_round();
    while (end_ == End::none && !interrupt.requested()) {
        listen();
        if (settings_.editor && settings_.editor->ended())
            end_ = End::closed;
        const double now = now_seconds();
        TRY(follow_scene(now));
        take_inputs();
        const bool morphing = morph_.has_value();
        advance_morph(now);
        follow_edits(now, morphing);
        write_presets();
        report_video();
        overlay_.mark_changed_if(overlay_.messages().take_due(now));
        settle_after_rest(now);
        take_origin();
        follow_lens(now);
        advance_seek();
        go_round(now);
        timeline_.watch(screen_->is_watched(), now);
        if (pump_.wants_frame(around(), now))
            draw(now);
        TRY(check_driver());
        look_for_numbers(now_seconds());
        show_title(now);
        sound_->follow(timeline_.time(now), now, sound_runs());
    }
    picture_.lens().stop();
    if (settings_.remembers && stage_)
        remember(settings_.scene.path, *state());
    return finish().map([&] { return interrupt.requested() ? Interrupt::k_exit_code : 0; });
}

/// Writes the recording and pending pictures before it reports a driver reset.
Result<void> Viewer::check_driver() {
    const auto reason = gl::reset_reason();
    if (!reason)
        return {};
    end_ = End::driver_reset;
    TRY(finish());
    return fail(ErrorCode::timed_out, fmt::format("the graphics driver was reset: {}", *reason));
}

Result<void> Viewer::finish() {
    return recorder_.finish(scene_files());
}

/// Waits for events. Those that came while a frame blocked the window are handled first, as they refer to the
/// picture shown then.
void Viewer::listen() {
    if (pump_.begin_round(drawn_extent()))
        handle_all(screen_->wait(0));
    pump_.begin_waiting();
    handle_all(screen_->wait(end_ == End::none ? seconds_to_sleep(now_seconds()) : 0));
    pump_.end_round();
}

/// Handles events. While a part of a frame occupies the driver, only Esc, Ctrl+Q and closing the window are
/// handled at once; the others are kept.
void Viewer::handle_all(const std::vector<host::InputEvent>& events) {
    std::vector<host::InputEvent> happened = std::exchange(events_held_, {});
    happened.insert(happened.end(), events.begin(), events.end());
    const bool held = !happened.empty() && pump_.driver_busy();
    bool control = keys_.control_down();
    for (const host::InputEvent& event : happened) {
        const auto* key = std::get_if<host::KeyPressed>(&event);
        control |= key && key->key == Key::control;
        const bool leads_out =
            std::holds_alternative<host::CloseRequested>(event) || (key && key->key == Key::escape);
        if (held && control && key && key->key == k_q)
            end_ = End::closed;
        if (held && !leads_out) {
            events_held_.push_back(event);
            continue;
        }
        edited_ = true;
        if (std::holds_alternative<host::ButtonPressed>(event) ||
            std::holds_alternative<host::WheelTurned>(event))
            morph_.reset(); // the user takes over
        if (const auto* pressed = std::get_if<host::ButtonPressed>(&event))
            buttons_.insert(pressed->button);
        else if (const auto* released = std::get_if<host::ButtonReleased>(&event))
            buttons_.erase(released->button);
        overlay_.mark_changed_if(picture_.follow(event));
        if (!screen_->take(event))
            std::visit([this](const auto& it) { handle(it); }, event);
        carry_out_all(screen_->take_commands());
    }
    carry_out_all(screen_->take_commands());
}

void Viewer::handle(const host::PointerMoved& event) {
    if (pointer_moves_mouse_ && !buttons_.contains(host::Button::left))
        control(PointerFollowed{event.at});
    control(event);
}

void Viewer::handle(const host::KeyPressed& event) {
    const auto owner = keys_.press(event, stage_ && reads_keyboard(stage_->renderer()));
    if (owner == WindowKeys::Owner::window && screen_->has(event.key))
        return keys_.control_down() ? obey_with_control(event.key, now_seconds())
                                    : obey(event.key, now_seconds());
    if (owner == WindowKeys::Owner::scene)
        control(event);
}

void Viewer::handle(const host::KeyReleased& event) {
    if (keys_.release(event) == WindowKeys::Owner::scene)
        control(event);
}

void Viewer::handle(const host::FramebufferResized&) {
    picture_.forget_times();
    fit_drawing();
}

void Viewer::handle(const host::RedrawNeeded&) {
    pump_.ask();
    overlay_.mark_changed();
}

/// Passes an event to the scene and draws a paused picture again if it has changed.
void Viewer::control(const ControlEvent& event) {
    const ControlEvent seen = picture_.in_picture(event, screen_->extent());
    if (!controls_.handle(seen, drawn_extent().height))
        return;
    touched_at_ = now_seconds();
    pump_.ask();
    if (std::holds_alternative<KnobTurned>(event))
        pump_.doubt(drawn_extent());
    recorder_.note(timeline_.next_frame_number(), seen);
}

/// Obeys the shortcuts with Ctrl. Other keys mean the same as without it, for scenes that read the keyboard.
void Viewer::obey_with_control(Key key, double now) {
    follow_edits(now);
    if (key == Key::z)
        go_to(history_.undo(), "undone");
    else if (key == k_y)
        go_to(history_.redo(), "done again");
    else if (key == k_q)
        end_ = End::closed;
    else if (key == Key::r && !keys_.shift_down())
        toggle_video();
    else if (key == Key::c && keys_.shift_down())
        copy_picture();
    else
        obey(key, now);
}

void Viewer::obey(Key key, double now) {
    const bool is_digit = key > Key::digit_0 && key <= Key::digit_9;
    if (keys_.alt_down() && is_digit)
        return carry_out(overlay::GoToView{size_t(key) - size_t(Key::digit_0) - 1});
    if (leave_by(key))
        return;
    const bool moves_time = key == Key::left || key == Key::right || key == Key::space || key == Key::home;
    const bool resizes =
        key == Key::minus || key == Key::equal || key == Key::keypad_subtract || key == Key::keypad_add;
    if (moves_time) {
        carry_out(overlay::GiveUpSeek{});
        cancel_frame();
    }
    if ((moves_time || resizes) && pump_.resume() && key == Key::space && !timeline_.paused())
        return;
    if (key == k_x)
        key = Key::z;
    else if (key == k_i)
        return toggle_status();
    else if (key == k_l) {
        picture_.lens().step(keys_.shift_down() ? -1 : 1);
        return report_lens();
    } else if (key == k_u)
        return set_volume({volume_.volume, !volume_.muted});
    else if (key == k_v && !timeline_.by_frames()) {
        timeline_.set_speed(1, now);
        tell("speed", "speed 1");
    }
    switch (key) {
    case Key::left:
        timeline_.step(-1, now);
        forget_what_follows();
        break;
    case Key::right: timeline_.step(1, now); break;
    case Key::space: timeline_.toggle_pause(now); break;
    case Key::home:
        if (stage_)
            stage_->reset();
        shown_.current = false;
        timeline_.restart(now);
        forget_what_follows();
        break;
    case Key::up: return change_volume(1);
    case Key::down: return change_volume(-1);
    case Key::r: return control(CameraReset{});
    case Key::f:
        screen_->toggle_full_screen();
        if (screen_->is_full_screen())
            tell("full screen", "Full screen: F or Esc leaves it");
        break;
    case Key::escape: escape(now); break;
    case Key::c: return copy_moment();
    case Key::k: return keep_moment();
    case Key::s: return save_picture(); // of the frame on show; draws nothing
    case Key::h:
    case Key::f1: return toggle_help();
    case Key::tab: return toggle_controls();
    case Key::m: picture_.toggle_magnifier(); return overlay_.mark_changed();
    case Key::n: return toggle_marks();
    case Key::enter: return trace_pixel();
    case Key::z: return toggle_freeze();
    case Key::a: return toggle_adaptive();
    case Key::minus:
    case Key::keypad_subtract: return set_scale(picture_.scale().stepped(-1));
    case Key::equal:
    case Key::keypad_add: return set_scale(picture_.scale().stepped(1));
    default:
        if (overlay_.shows(Overlay::Panel::controls) && key >= Key::digit_0 && key <= Key::digit_9) {
            picture_.choose(int(key) - int(Key::digit_0));
            overlay_.mark_changed();
        }
        return;
    }
    pump_.ask();
}

/// Cancels seeking, slow frames or compiling, whichever is in progress; else closes the innermost of what is
/// open. Closes the window at once while a driver that cannot be stopped blocks it.
void Viewer::escape(double now) {
    if (pump_.seeking())
        return carry_out(overlay::GiveUpSeek{});
    if (pump_.just_stopped(now))
        return;
    if (stage_ && pump_.can_stop(around(), now))
        stop_frames(now);
    else if (stage_ && compiles_for_long(now))
        scene_.give_up();
    else if (pump_.driver_held(now))
        end_ = End::closed;
    else if (!close_innermost())
        close_on_second_press(now);
}

/// Closes help, the large picture, controls, magnifier or full screen; returns false if none is open.
bool Viewer::close_innermost() {
    const bool controls = overlay_.shows(Overlay::Panel::controls);
    if (overlay_.shows(Overlay::Panel::help))
        overlay_.toggle(Overlay::Panel::help);
    else if (controls && picture_.large())
        picture_.show_large(std::nullopt);
    else if (controls)
        toggle_controls();
    else if (picture_.magnifies())
        picture_.toggle_magnifier();
    else if (screen_->is_full_screen())
        screen_->toggle_full_screen();
    else
        return false;
    escaped_at_ = -std::numeric_limits<double>::infinity();
    overlay_.mark_changed();
    return true;
}

void Viewer::close_on_second_press(double now) {
    if (now - std::exchange(escaped_at_, now) <= k_second_press_seconds)
        end_ = End::closed;
    else
        tell("quit", "Esc again, or Ctrl+Q, closes the window", k_second_press_seconds);
}

/// Shows a short message of a topic over the picture.
void Viewer::tell(std::string_view topic, std::string text, double seconds) {
    overlay_.messages().tell(topic, std::move(text), now_seconds(), seconds);
}

/// Prints a line, and shows it over the picture.
void Viewer::announce(std::string_view topic, const std::string& line, double seconds) {
    say(line);
    tell(topic, line, seconds);
}

/// Shows the most important keys over the first picture.
void Viewer::greet() {
    tell("keys",
         reads_keyboard(stage_->renderer()) ? "Ctrl+Tab: controls, F1: keys" : "Tab: controls, H: keys");
}

FramePump::Around Viewer::around() const {
    return {.watched = screen_->is_watched(),
            .plays = stage_ && !timeline_.paused(),
            .compiles = scene_.building_since().has_value(),
            .panels_changed = overlay_.changed() || screen_->wants_frame(),
            .events_held = !events_held_.empty()};
}

double Viewer::seconds_to_sleep(double now) const {
    constexpr double k_morph_step = 1 / 60.0;
    double until = pump_.due(around(), now);
    if (morph_)
        until = std::min(until, now + k_morph_step);
    if (scene_.building_since() || pump_.ending())
        until = std::min(until, now + k_title_seconds);
    if (!pump_.driver_held(now))
        until = std::min({until, finite_.due(), overlay_.messages().due()});
    if (const auto wake = scene_.wake_at())
        until = std::min(until, *wake);
    return std::max(0.0, until - now);
}

LiveScene::View Viewer::view() const {
    return {[this] { return screen_->create_context(); }, options_for(drawn_extent(), settings_),
            inputs_of_shown(), settings_.rehearsal};
}

std::vector<std::filesystem::path> Viewer::scene_files() const {
    return stage_ ? files_read(stage_->renderer().scene()) : std::vector<std::filesystem::path>{};
}

/// Takes over a finished reload. Waits while the driver is occupied, because the buffers cannot be copied
/// then.
Result<void> Viewer::follow_scene(double now) {
    if (pump_.driver_held(now))
        return {};
    if (settings_.editor)
        if (auto change = settings_.editor->take())
            scene_.put(*std::move(change), view());
    auto fresh = TRY(scene_.follow(view(), now));
    overlay_.show_error(scene_.failure(), scene_.request().files.unsaved);
    if (scene_.failure())
        timeline_.begin_next_scene_at(std::nullopt);
    return fresh ? show(*std::move(fresh), now) : Result<void>();
}

/// Shows a new Stage from now on. An optimised one draws the same pictures, so everything else stays.
Result<void> Viewer::show(Stage fresh, double now) {
    const bool first = !stage_;
    if (first) {
        timeline_.begin(now);
        if (settings_.paused || (settings_.left && settings_.left->paused))
            timeline_.toggle_pause(now);
    }
    TRY(swap_in(std::move(fresh)));
    if (stage_->share()) {
        say(fmt::format("background optimisation: frames take {:.0f} % less time, same bytes",
                        100 * (1 - *stage_->share())));
        return {};
    }
    play_sound();
    picture_.lens().set_scene(std::make_shared<const scene::Scene>(stage_->renderer().scene()), no_lens());
    overlay_.forget_scene();
    release_knobs();
    history_.adopt(edits());
    if (first)
        greet();
    const glsl::PassReading reading(stage_->renderer().scene(), stage_->renderer().scene().image());
    pointer_moves_mouse_ = reading.mouse_follows_pointer();
    reloaded_ = scene_.take_times();
    settled_ = false;
    shown_.current = false;
    pump_.begin_scene();
    finite_.begin_anew();
    touched_at_ = now;
    const auto begins_at = timeline_.take_next_scene_time();
    if (begins_at && first && has_feedback()) // all earlier frames would be drawn before anything is visible
        say("starting at 0 s: the scene reads its own last frame");
    else if (begins_at)
        seek(*begins_at, now);
    return {};
}

/// Drops held values that the scene on show does not need or accept. Prints a line for each that it refuses,
/// and for a recording that it refuses.
void Viewer::release_knobs() {
    const std::vector<scene::Knob>& knobs = stage_->renderer().scene().knobs;
    for (const std::string& line : controls_.release(knobs))
        say(fmt::format("warning: {}; the scene's own value is used", line));
    if (settings_.frames.input)
        if (const auto known = check_knobs(*settings_.frames.input, knobs); !known)
            say(fmt::format("warning: --input {}: {}", settings_.frames.input_file, known.error().message));
}

/// Replaces the Stage. The buffers keep their contents: an edited scene continues from where it was, as on
/// ShaderToy.
Result<void> Viewer::swap_in(Stage fresh) {
    cancel_frame();
    pump_.forget_scene();
    if (stage_)
        stage_->finish(); // its drawings must be complete before they are copied
    picture_.leave_context();
    picture_.forget_times();
    costs_.forget();
    const std::optional<Stage> before = std::exchange(stage_, std::nullopt);
    stage_.emplace(std::move(fresh));
    TRY(stage_->enter());
    picture_.enter_context();
    if (before) {
        stage_->renderer().continue_from(before->renderer());
        for (const std::string& line : edits_of_turned(before->renderer().scene().knobs,
                                                       stage_->renderer().scene().knobs, shown_.state.knobs))
            say(line);
    }
    if (drawn_extent() != stage_->extent())
        fit_drawing(); // the window was resized in the meantime
    return {};
}

/// Starts background optimisation after idle time. Not for a still picture, which is not drawn again, and not
/// for slow frames, because a trial draws them whole and occupies the driver.
void Viewer::settle_after_rest(double now) {
    constexpr double k_longest_trial_frame = 0.25;
    if (pump_.expected(drawn_extent()).value_or(0) > k_longest_trial_frame)
        return;
    if (settings_.plain || settled_ || !pump_.moving(around()) || scene_.building_since() ||
        scene_.failure() || knobs_may_turn())
        return;
    const auto rest = stage_->seconds_to_settle();
    if (!rest || now - touched_at_ < *rest)
        return;
    settled_ = true;
    scene_.build_anew(turned_scene(), view(), LiveScene::Settle::yes);
}

/// Returns whether knobs may change soon, which would make a program that contains their values useless.
bool Viewer::knobs_may_turn() const {
    return overlay_.shows(Overlay::Panel::controls) || (inputs_ && settings_.inputs->turns_knobs()) ||
           recorder_.turns_knobs();
}

/// Returns the scene on show with the current values of its knobs.
scene::Scene Viewer::turned_scene() const {
    scene::Scene scene = stage_->renderer().scene();
    for (scene::Knob& knob : scene.knobs)
        knob.value = value_after(knob, shown_.state.knobs);
    return scene;
}

/// Prints the times of a reload: Tidemark's share (notice, load) and the driver's (compile, first draw).
void Viewer::report_reload() {
    stage_->finish(); // the picture is visible when drawing is complete
    const double shown = now_seconds();
    const auto ms = [](double from, double to) { return (to - from) * 1000; };
    say(fmt::format("reloaded in {:.0f} ms: notice {:.0f}, load {:.1f}, compile {:.0f}, first draw {:.0f}",
                    ms(reloaded_->saved, shown), ms(reloaded_->saved, reloaded_->seen),
                    ms(reloaded_->seen, reloaded_->loaded), ms(reloaded_->loaded, reloaded_->compiled),
                    ms(reloaded_->compiled, shown)));
    reloaded_.reset();
}

bool Viewer::compiles_for_long(double now) const {
    const auto since = scene_.building_since();
    return since && now - *since > k_short_wait_seconds;
}

} // namespace tidemark::window
