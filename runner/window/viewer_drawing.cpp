// Drawing frames, and everything that is shown over them: see FramePump and PictureView.

#include "host/console.hpp"
#include "host/scene_report.hpp"
#include "render/gl_textures.hpp"
#include "window/viewer.hpp"

#include <fmt/format.h>

#include <utility>

namespace tidemark::cli {
namespace {

/// The topic of the message while a pixel is traced.
constexpr std::string_view k_trace = "trace";

} // namespace

/// Sets the drawn size from window and scale. Returns whether it worked; else the old picture is stretched.
bool Viewer::fit_drawing() {
    if (screen_->extent().pixels() == 0)
        return true; // minimised
    touched_at_ = now_seconds();
    pump_.ask();
    if (!stage_)
        return true;
    if (pump_.drawing() && drawn_extent() != stage_->extent())
        cancel_frame();
    overlay_.mark_changed(); // the last picture, until one of that size is drawn
    const auto resized = stage_->renderer().resize(drawn_extent());
    if (!resized)
        say(to_string(resized.error()));
    return resized.has_value();
}

/// Changes the scale; the mouse stays at the same place of the picture. Returns whether it worked.
bool Viewer::change_scale(RenderScale wanted) {
    const Extent before = drawn_extent();
    const RenderScale scale_before = picture_.scale();
    picture_.set_scale(wanted);
    const bool fits = fit_drawing();
    if (fits)
        controls_.stretch(before, drawn_extent());
    else
        picture_.set_scale(scale_before);
    return fits;
}

/// Sets the scale and ends adaptive scaling.
void Viewer::set_scale(RenderScale wanted) {
    if (recorder_.mode() != Recorder::Mode::live)
        return say("the scale cannot change during a replay: mouse positions are recorded in pixels");
    if (picture_.adapts())
        toggle_adaptive();
    if (wanted == picture_.scale())
        return;
    carry_out(live::GiveUpSeek{});
    change_scale(wanted);
}

void Viewer::toggle_adaptive() {
    if (recorder_.mode() != Recorder::Mode::live)
        return say("the scale cannot change during a replay: mouse positions are recorded in pixels");
    if (picture_.adapts()) {
        picture_.adapt_to(std::nullopt);
        return say(fmt::format("adaptive scale is off: the scale stays at {}", picture_.scale().name()));
    }
    const double fps = settings_.adaptive.value_or(settings_.frames.state.fps);
    picture_.adapt_to(fps);
    say(fmt::format("adaptive scale is on: it aims at {:g} fps", fps));
}

/// Returns the timers for the next frame; null while neither the controls nor adaptive scaling need them. The
/// time of the frame before may change the scale of this one, except while a thread compiles, when it is not
/// reliable.
std::vector<render::PassTimer>* Viewer::time_next_frame() {
    if (!overlay_.shows(Overlay::Panel::controls) && !picture_.adapts())
        return nullptr;
    std::vector<render::PassTimer>* timers = costs_.next_frame();
    const auto took = costs_.frame_before();
    if (!took || scene_.busy())
        return timers;
    const RenderScale wanted = picture_.scale_after(*took);
    if (wanted != picture_.scale() && !change_scale(wanted))
        toggle_adaptive();
    return timers;
}

void Viewer::draw(double now) {
    if (pump_.goes_on(around(), now))
        return carry_on(now);
    const auto wanted = pump_.take_due(around(), now);
    if (!stage_ || !wanted)
        return present(false);
    std::vector<render::PassTimer>* timers = time_next_frame();
    const render::FrameState state = next_state(now);
    if (inputs_)
        inputs_->hear(); // fresh sound and webcam data
    render::FrameInputs inputs = inputs_of(state);
    if (inputs_)
        inputs.live = inputs_->media();
    if (const auto whole = pump_.begin(*stage_, state, inputs, *wanted, now, timers))
        show_frame(*whole);
    else
        carry_on(now);
}

/// Returns the state of the frame to draw now.
render::FrameState Viewer::next_state(double now) {
    render::FrameState state = timeline_.next_frame(now, settings_.frames.state);
    state.date = settings_.date ? *settings_.date : render::later(render::local_date(), -state.seconds());
    state.extent = stage_->extent();
    recorder_.fill(state, controls_);
    controls_.frame_drawn(); // later events belong to the next frame
    return state;
}

void Viewer::carry_on(double now) {
    overlay_.mark_changed_if(pump_.progress_due(now));
    if (!make_way())
        return report_slow_part(now);
    const auto made = pump_.advance();
    if (!made) {
        say(to_string(made.error()));
        return cancel_frame();
    }
    if (!*made)
        return report_slow_part(now);
    for (const auto& [pass, took] : (*made)->seconds)
        costs_.took(pass, took * 1000);
    show_frame(**made);
}

/// Makes it the frame on show.
void Viewer::show_frame(const FramePump::Made& frame) {
    shown_ = {frame.state, frame.begun, true};
    if (frame.drawn || frame.wanted || overlay_.changed() || screen_->wants_frame())
        present(frame.drawn);
    if (frame.drawn)
        finite_.frame_drawn();
    // Frames must keep counting while they are recorded, or while the scene reads iFrame.
    const bool still =
        !frame.drawn && !stage_->renderer().follows_clock() && recorder_.mode() == Recorder::Mode::live;
    pump_.set_still(still);
    if (still)
        timeline_.rest();
    if (reloaded_)
        report_reload();
    if (recorder_.take_save())
        save_picture();
}

/// Lets what waits for the driver run between two parts, and starts no part before that, because one may
/// never end. Returns whether the next part may start.
bool Viewer::make_way() {
    const bool due = pump_.shows_panels(around());
    if (!due && events_held_.empty())
        return true;
    if (pump_.driver_busy())
        return false;
    if (due)
        present(false);
    return events_held_.empty();
}

/// Cancels the frame or the seek in progress; the next frame gets the same number.
void Viewer::cancel_frame() {
    if (pump_.cancel())
        timeline_.give_frame_back();
}

void Viewer::stop_frames(double now) {
    const std::string drawn = pump_.share_text(now);
    cancel_frame();
    forget_what_follows();
    pump_.stop(now);
    timeline_.rest();
    say(fmt::format("{}: frame cancelled, {}: press space to continue, - to draw smaller, or save a file of "
                    "it; Esc twice closes the window",
                    settings_.scene.path.string(), drawn));
    if (pump_.driver_held(now))
        say("the driver cannot be stopped: its current work ends by itself");
}

void Viewer::report_slow_part(double now) {
    const auto part = pump_.take_slow_part(now);
    if (!part)
        return;
    const Rectangle& area = part->area;
    say(fmt::format("{}: {}x{} pixels of {} from {},{} on take more than {:.0f} s: a very long or endless "
                    "loop; Esc cancels the frame, - draws smaller",
                    settings_.scene.path.string(), area.extent.width, area.extent.height,
                    stage_->renderer().scene().passes[part->pass].name, area.x, area.y,
                    FramePump::k_too_long_seconds));
}

/// Shows the last drawn picture and the panels.
void Viewer::present(bool fresh) {
    const gl::Texture* marked = marked_picture(); // draws, so it must come before begin()
    live::Model model = overlay_model();
    const Frozen* frozen = picture_.frozen();
    screen_->begin(frozen ? &frozen->target : stage_ ? &stage_->renderer().target() : nullptr, fresh);
    if (marked)
        picture_.draw_marks(*marked, screen_->extent());
    if (auto shown = screen_->finish(std::move(model), shown_moment()); !shown)
        say(to_string(shown.error()));
}

live::Model Viewer::overlay_model() {
    render::FrameState turned = shown_.state;
    if (pump_.drawing() && recorder_.mode() == Recorder::Mode::live)
        controls_.fill(turned); // newer than the frame on show
    const render::Renderer* renderer = stage_ ? &stage_->renderer() : nullptr;
    live::Model model = overlay_.model(renderer ? &renderer->scene() : nullptr, scene_.request(),
                                       turned.knobs, inputs_ && inputs_->has_midi(), now_seconds());
    if (picture_.magnifies() && renderer && !pump_.seeking() && !picture_.frozen())
        model.magnifier = picture_.magnifier(*renderer, inputs_of_shown(), screen_->extent());
    if (const double now = now_seconds(); pump_.draws_for_long(now)) {
        model.clock = pump_.progress(now, shown_.current);
        pump_.progress_shown(now);
    }
    if (!model.controls)
        return model;
    picture_.add_pictures(model, *renderer, costs_, inputs_of_shown(), screen_->extent());
    model.time = timeline_.field(shown_.state);
    model.time.turns_back = !has_feedback();
    if (pump_.seeking())
        model.time.stepping = pump_.seek_progress();
    model.extent = renderer->extent();
    return model;
}

ShownMoment Viewer::shown_moment() const {
    return {shown_.state.seconds(), shown_.state.frame, stage_ && reads_keyboard(stage_->renderer()),
            shown_.begun};
}

/// Returns the inputs of the frame on show, with the last sound and webcam data.
render::FrameInputs Viewer::inputs_of_shown() const {
    render::FrameInputs inputs = inputs_of(shown_.state);
    if (inputs_)
        inputs.live = inputs_->media();
    return inputs;
}

const gl::Texture* Viewer::marked_picture() {
    if (!picture_.shows_marks() || !stage_ || pump_.seeking() || picture_.frozen() || pump_.drawing() ||
        pump_.would_block(drawn_extent()))
        return nullptr;
    return picture_.marked(stage_->renderer(), inputs_of_shown());
}

void Viewer::toggle_marks() {
    picture_.toggle_marks();
    const bool rest = picture_.shows_marks() && pump_.would_block(drawn_extent());
    if (rest)
        say("marks are off while a frame takes more than a second");
    tell("marks", rest                     ? "marks are off while a frame takes more than a second"
                  : picture_.shows_marks() ? "marks: NaN magenta, infinity green, below zero blue"
                                           : "marks are off");
    overlay_.mark_changed();
}

void Viewer::toggle_freeze() {
    if (!has_frame())
        return;
    overlay_.mark_changed();
    if (picture_.frozen()) {
        tell("frozen", "the picture moves again");
        return picture_.freeze(std::nullopt);
    }
    auto target = gl::copy_in_bytes(stage_->renderer().target());
    if (!target)
        return say("the driver has no memory to freeze the picture");
    picture_.freeze(Frozen{*std::move(target), read_picture(), moment()});
    tell("frozen", fmt::format("frozen at {:.3f} s; Z shows the current picture", shown_.state.seconds()));
}

/// Reports pixels that are not finite, once for each text: a window may show them as any colour.
void Viewer::look_for_numbers(double now) {
    if (!stage_ || now < finite_.due() || pump_.driver_busy())
        return;
    if (const size_t count = finite_.look(stage_->renderer(), now); count > 0)
        say(fmt::format("warning: {} not finite; find the origin with: {}",
                        pixels_are(count, fmt::format("at {:.3f} s", shown_.state.seconds())),
                        shell_words(trace_words())));
}

/// Returns the `check --trace` command for the frame on show, as far as options can express the user's input.
std::vector<std::string> Viewer::trace_words() const {
    render::FrameState state = shown_.state;
    state.extent = stage_->extent();
    state.fps = settings_.frames.state.fps;
    state.date = settings_.frames.state.date;
    return cli::trace_words(scene_.request(), settings_.frames, state);
}

/// Traces the NaN of the magnified pixel; a second press hides the result.
void Viewer::trace_pixel() {
    if (!picture_.magnifies() || !stage_ || picture_.frozen())
        return;
    if (overlay_.show_origin(nullptr) || search_) {
        search_.reset();
        overlay_.messages().end(k_trace);
        return overlay_.mark_changed();
    }
    const Rectangle pixel = picture_.pixel(stage_->renderer().target().extent(), screen_->extent());
    std::vector<std::string> words = trace_words();
    words.insert(words.end(), {"--pixel", fmt::format("{},{}", pixel.x, pixel.y), "--json"});
    auto started = OriginSearch::start(words, [&on = *screen_] { on.wake(); });
    if (!started)
        return say(to_string(started.error()));
    search_ = *std::move(started);
    const std::string line = fmt::format("tracing pixel {},{}; press Enter to cancel", pixel.x, pixel.y);
    say(line);
    tell(k_trace, line, std::numeric_limits<double>::infinity());
}

void Viewer::take_origin() {
    const auto printed = search_ ? search_->take() : std::nullopt;
    if (!printed)
        return;
    search_.reset();
    overlay_.messages().end(k_trace);
    const Error error = origin_of(*printed);
    overlay_.show_origin(&error);
    say(to_string(error));
}

} // namespace tidemark::cli
