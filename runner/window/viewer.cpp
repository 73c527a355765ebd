#include "window/viewer.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/supervision.hpp"
#include "host/console.hpp"
#include "host/requests.hpp"
#include "host/scene_report.hpp"
#include "media/picture_file.hpp"
#include "render/gl_context.hpp"
#include "render/gl_textures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <variant>

namespace tidemark::cli {
namespace {

using platform::Key;

/// A frame that blocks the window for longer can be cancelled with Esc.
constexpr double k_hold_seconds = 1;
/// Shortest pause between two such frames, for events and file changes.
constexpr double k_breath_seconds = 0.05;
/// Largest age of the seconds in the title.
constexpr double k_title_seconds = 0.25;

render::RenderOptions options_for(Extent drawn, const Viewer::Settings& settings) {
    render::RenderOptions options{drawn, image::SampleType::u8, settings.frames.state.pass,
                                  precision_of(settings.scene)};
    options.marks_non_finite = true;
    return options;
}

} // namespace

Viewer::Viewer(Settings settings, std::unique_ptr<Screen> screen, LiveScene scene)
    : settings_(std::move(settings)), screen_(std::move(screen)), scene_(std::move(scene)),
      sound_(std::make_unique<SoundPlayer>()), clock_(clock_from(now_seconds())),
      controls_(settings_.frames.state.camera), scale_(settings_.scale), controls_open_(settings_.controls) {
    // While recording, the recording itself drives the scene, so that a replay shows the same pictures.
    if (settings_.frames.input || recording())
        replay_.emplace(settings_.frames.input.value_or(InputScript{}), settings_.frames.state.camera);
    if (settings_.adaptive)
        toggle_adaptive();
    if (settings_.left)
        take_up(*settings_.left);
}

/// Counts frames instead of time while recording or replaying: a wall clock cannot be reproduced.
render::LiveClock Viewer::clock_from(double now) const {
    const bool by_frames = settings_.frames.input || recording();
    return render::LiveClock(now, by_frames ? std::optional(settings_.frames.state.fps) : std::nullopt);
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

Result<int> Viewer::run(const Interrupt& interrupt) {
    const auto rescue = screen_->when_lost([this](std::string_view what) {
        const auto saved = finish();
        say(to_string(saved ? Error{ErrorCode::no_context, std::string(what)} : saved.error()));
        exit_at_once(exit_code(ErrorCode::no_context));
    });
    listened_at_ = now_seconds();
    while (!closing_ && !interrupt.requested()) {
        listen();
        const double now = now_seconds();
        TRY(follow_scene(now));
        take_inputs();
        settle_after_rest(now);
        take_origin();
        step_there();
        go_round(now);
        rest_unwatched(now);
        if (wants_frame(now))
            draw(now);
        TRY(check_driver());
        look_for_numbers(now_seconds());
        show_title(now);
        sound_->follow(clock_.time(now), !clock_.paused());
    }
    leave();
    return finish().map([&] { return interrupt.requested() ? Interrupt::k_exit_code : 0; });
}

/// Writes the recording and pending pictures before it reports a driver reset.
Result<void> Viewer::check_driver() {
    const auto reason = gl::reset_reason();
    if (!reason)
        return {};
    was_reset_ = true;
    TRY(finish());
    return fail(ErrorCode::timed_out, fmt::format("the graphics driver was reset: {}", *reason));
}

/// Waits for events. Those that came while a frame blocked the window are handled first, as they refer to the
/// picture shown then.
void Viewer::listen() {
    double now = now_seconds();
    held_seconds_ = now - listened_at_;
    of_the_hold_ = held_seconds_ > k_hold_seconds;
    if (std::exchange(drew_, false)) {
        slow_ = of_the_hold_;
        pace_.took(drawn_extent(), render::FramePace::Way::whole, held_seconds_);
    }
    if (ending_ && ending_->end.wait(0))
        ending_.reset();
    if (of_the_hold_) {
        handle_all(screen_->wait(0));
        next_draw_ = std::max(next_draw_, now + k_breath_seconds);
        now = now_seconds();
    }
    of_the_hold_ = false;
    handle_all(screen_->wait(closing_ ? 0 : seconds_to_sleep(now)));
    listened_at_ = now_seconds();
}

/// Handles events. While a part of a frame occupies the driver, only Esc and closing the window are handled
/// at once; the others are kept.
void Viewer::handle_all(const std::vector<platform::InputEvent>& events) {
    std::vector<platform::InputEvent> happened = std::exchange(events_held_, {});
    happened.insert(happened.end(), events.begin(), events.end());
    const bool held = !happened.empty() && driver_is_at_work();
    for (const platform::InputEvent& event : happened) {
        const auto* key = std::get_if<platform::KeyPressed>(&event);
        const bool leads_out =
            std::holds_alternative<platform::CloseRequested>(event) || (key && key->key == Key::escape);
        if (held && !leads_out) {
            events_held_.push_back(event);
            continue;
        }
        stale_overlay_ |= magnifier_.follow(event);
        if (!screen_->take(event))
            std::visit([this](const auto& it) { handle(it); }, event);
        obey_overlay();
    }
    obey_overlay();
}

/// Returns whether to wait for a reload: do not start a slow frame while one is compiling.
bool Viewer::waits_for_better() const {
    return scene_.building_since() && (slow_ || draws_for_long(now_seconds()));
}

Result<void> Viewer::finish() {
    if (recording()) {
        const OutputPath& record = settings_.record;
        const auto read =
            stage_ ? files_read(stage_->renderer().scene()) : std::vector<std::filesystem::path>{};
        TRY(write_file(record.sparing(read), to_string(replay_->script())));
    }
    return writer_ ? writer_->finish() : Result<void>();
}

bool Viewer::wants_frame(double now) const {
    if (!screen_->is_watched())
        return false;
    if (goes_on())
        return true;
    if (stepping_ || driver_is_at_work())
        return false;
    if (overlay_due())
        return true;
    if (making_ || waits_for_better() || (slow_ && now < next_draw_))
        return false;
    return stale_ || (moving() && now >= next_draw_);
}

/// Returns whether frames follow each other without events.
bool Viewer::moving() const {
    return stage_ && !clock_.paused() && !at_rest_ && !given_up_ && !stepping_;
}

double Viewer::seconds_to_sleep(double now) const {
    double until = std::numeric_limits<double>::infinity();
    const bool held = driver_is_held(now);
    const bool watched = screen_->is_watched();
    if ((watched && goes_on()) || stepping_)
        return 0;
    if (watched && !held && ((stale_ && !slow_ && !making_) || overlay_due()))
        return 0;
    if (watched && !held && (stale_ || moving()) && !making_ && !waits_for_better())
        until = next_draw_;
    if (scene_.building_since() || ending_)
        until = std::min(until, now + k_title_seconds);
    if (!held)
        until = std::min(until, finite_.due());
    if (const auto wake = scene_.wake_at())
        until = std::min(until, *wake);
    return std::max(0.0, until - now);
}

/// Shows the last drawn picture and the overlay.
void Viewer::present(bool fresh) {
    stale_overlay_ = false;
    const gl::Texture* marked = marked_picture(); // draws, so it must come before begin()
    live::Model model = overlay_model();
    screen_->begin(target_on_show(), fresh);
    if (marked)
        marks_->draw(*marked, screen_->extent());
    if (auto shown = screen_->finish(std::move(model), shown_moment()); !shown)
        say(to_string(shown.error()));
}

ShownMoment Viewer::shown_moment() const {
    return {shown_.seconds(), shown_.frame, stage_ && reads_keyboard(stage_->renderer()), shown_begun_};
}

/// Reports pixels that are not finite, once for each text: a window may show them as any colour.
void Viewer::look_for_numbers(double now) {
    if (!stage_ || now < finite_.due() || driver_is_at_work())
        return;
    if (const size_t count = finite_.look(stage_->renderer(), now); count > 0)
        say(fmt::format("warning: {} not finite; find the origin with: {}",
                        pixels_are(count, fmt::format("at {:.3f} s", shown_.seconds())),
                        shell_words(trace_words())));
}

/// Returns the `check --trace` command for the frame on show, as far as options can express the user's input.
std::vector<std::string> Viewer::trace_words() const {
    render::FrameState state = shown_;
    state.extent = stage_->renderer().extent();
    state.fps = settings_.frames.state.fps;
    state.date = settings_.frames.state.date;
    return cli::trace_words(scene_.request(), settings_.frames, state);
}

void Viewer::handle(const platform::KeyPressed& event) {
    const auto owner = keys_.press(event, stage_ && reads_keyboard(stage_->renderer()));
    if (owner == WindowKeys::Owner::window && screen_->has(event.key))
        obey(event.key, now_seconds());
    else if (owner == WindowKeys::Owner::scene)
        control(event);
}

void Viewer::handle(const platform::KeyReleased& event) {
    if (keys_.release(event) == WindowKeys::Owner::scene)
        control(event);
}

void Viewer::obey(Key key, double now) {
    const bool moves_time = key == Key::left || key == Key::right || key == Key::space || key == Key::home;
    if (stepping_ && moves_time)
        carry_out(live::GiveUpSeek{});
    const bool resizes =
        key == Key::minus || key == Key::equal || key == Key::keypad_subtract || key == Key::keypad_add;
    if (moves_time)
        drop_frame();
    if (given_up_ && (moves_time || resizes)) {
        given_up_ = false;
        if (key == Key::space && !clock_.paused())
            return;
    }
    switch (key) {
    case Key::left:
        clock_.step(-1, settings_.frames.state.fps, now);
        forget_what_follows();
        break;
    case Key::right: clock_.step(1, settings_.frames.state.fps, now); break;
    case Key::space: clock_.toggle_pause(now); break;
    case Key::home:
        if (stage_)
            stage_->renderer().reset();
        has_frame_ = false;
        clock_.restart(now);
        forget_what_follows();
        break;
    case Key::r: return control(CameraReset{});
    case Key::f: screen_->toggle_full_screen(); break;
    case Key::escape: escape(now); break;
    case Key::c: return copy_moment();
    case Key::k: return keep_moment();
    case Key::s: return save_picture(); // of the frame on show; draws nothing
    case Key::h:
    case Key::f1: return toggle_help();
    case Key::tab: return toggle_controls();
    case Key::m: return toggle_magnifier();
    case Key::n: return toggle_marks();
    case Key::enter: return trace_pixel();
    case Key::z: return toggle_freeze();
    case Key::a: return toggle_adaptive();
    case Key::minus:
    case Key::keypad_subtract: return set_scale(scale_.stepped(-1));
    case Key::equal:
    case Key::keypad_add: return set_scale(scale_.stepped(1));
    default: return show_picture_of(key);
    }
    stale_ = true;
}

/// Cancels seeking, slow frames or compiling, whichever is in progress; else closes the window.
void Viewer::escape(double now) {
    if (stepping_)
        return carry_out(live::GiveUpSeek{});
    if (given_up_ && now - given_up_at_ < k_hold_seconds)
        return; // pressed again for the same frame
    if (stage_ && (of_the_hold_ || draws_for_long(now) || (slow_ && (moving() || making_)))) {
        give_frames_up(now);
    } else if (stage_ && compiles_for_long(now)) {
        scene_.give_up();
    } else {
        closing_ = true;
    }
}

/// Ends the recording at the next frame, because time went backwards.
void Viewer::forget_what_follows() {
    if (recording())
        replay_->go_back(clock_.next_frame_number());
}

LiveScene::View Viewer::view() const {
    return {[this] { return screen_->create_context(); }, options_for(drawn_extent(), settings_),
            inputs_on_show(), settings_.rehearsal};
}

/// Takes over a finished reload. Waits while the driver is occupied, because the buffers cannot be copied
/// then.
Result<void> Viewer::follow_scene(double now) {
    if (driver_is_held(now))
        return {};
    auto fresh = TRY(scene_.follow(view(), now));
    stale_overlay_ |= errors_.show(scene_.failure());
    if (scene_.failure())
        going_to_.reset();
    return fresh ? show(*std::move(fresh), now) : Result<void>();
}

/// Shows a new Stage from now on. An optimised one draws the same pictures, so everything else stays.
Result<void> Viewer::show(Stage fresh, double now) {
    const bool first = !stage_;
    if (first)
        clock_ = clock_from(now);
    TRY(swap_in(std::move(fresh)));
    if (stage_->share()) {
        say(fmt::format("background optimisation: frames take {:.0f} % less time, same bytes",
                        100 * (1 - *stage_->share())));
        return {};
    }
    play_sound();
    defined_.reset();
    origin_.show(nullptr);
    release_knobs();
    reloaded_ = scene_.take_times();
    settled_ = false;
    given_up_ = slow_ = has_frame_ = false;
    finite_.begin_anew();
    stale_ = true;
    touched_at_ = now;
    if (first && going_to_ && has_feedback()) {
        going_to_.reset(); // all earlier frames would be drawn before anything is visible
        say("starting at 0 s: the scene reads its own last frame");
    }
    if (going_to_)
        seek(*std::exchange(going_to_, std::nullopt), now);
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
    drop_frame();
    ending_.reset();
    parts_fail_ = false;
    pace_.doubt();
    part_size_ = {};
    if (stage_)
        glFinish(); // its drawings must be complete before they are copied
    forget_looking();
    costs_.forget();
    if (adaptive_)
        adaptive_->forget();
    if (frozen_)
        frozen_->target.framebuffer = {}; // deleted in the context that owns it
    const std::optional<Stage> before = std::exchange(stage_, std::nullopt);
    stage_.emplace(std::move(fresh));
    TRY(stage_->enter());
    if (frozen_)
        frozen_->target = gl::attach(std::move(frozen_->target.texture));
    if (before) {
        stage_->renderer().continue_from(before->renderer());
        for (const std::string& line : edits_of_turned(before->renderer().scene().knobs,
                                                       stage_->renderer().scene().knobs, shown_.knobs))
            say(line);
    }
    if (drawn_extent() != stage_->renderer().extent())
        fit_drawing(); // the window was resized in the meantime
    return {};
}

/// Starts background optimisation after idle time. Not for a still picture, which is not drawn again, and not
/// for slow frames, because a trial draws them whole and occupies the driver.
void Viewer::settle_after_rest(double now) {
    constexpr double k_longest_trial_frame = 0.25;
    if (pace_.expected(drawn_extent()).value_or(0) > k_longest_trial_frame)
        return;
    if (settings_.plain || settled_ || !moving() || scene_.building_since() || scene_.failure() ||
        knobs_may_turn())
        return;
    const auto rest = stage_->seconds_to_settle();
    if (!rest || now - touched_at_ < *rest)
        return;
    settled_ = true;
    scene_.build_anew(turned_scene(), view(), LiveScene::Settle::yes);
}

void Viewer::play_sound() {
    const scene::Scene& scene = stage_->renderer().scene();
    if (!settings_.sounds || !scene.find(scene::PassKind::sound))
        return sound_->stop();
    if (auto context = screen_->create_context())
        sound_->play(*std::move(context), scene, precision_of(settings_.scene));
    else
        say(to_string(context.error()));
}

/// Prints the times of a reload: Tidemark's share (notice, load) and the driver's (compile, first draw).
void Viewer::report_reload() {
    glFinish(); // the picture is visible when drawing is complete
    const double shown = now_seconds();
    const auto ms = [](double from, double to) { return (to - from) * 1000; };
    say(fmt::format("reloaded in {:.0f} ms: notice {:.0f}, load {:.1f}, compile {:.0f}, first draw {:.0f}",
                    ms(reloaded_->saved, shown), ms(reloaded_->saved, reloaded_->seen),
                    ms(reloaded_->seen, reloaded_->loaded), ms(reloaded_->loaded, reloaded_->compiled),
                    ms(reloaded_->compiled, shown)));
    reloaded_.reset();
}

} // namespace tidemark::cli
