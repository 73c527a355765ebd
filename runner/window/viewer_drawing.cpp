// Drawing frames, and everything that is shown over them: see FramePump and PictureView.

#include "host/console.hpp"
#include "host/presets.hpp"
#include "host/scene_report.hpp"
#include "media/picture_codecs.hpp"
#include "render/gl_textures.hpp"
#include "window/gallery.hpp"
#include "window/viewer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace tidemark::window {

using namespace host;
namespace {

/// The topic of the message while a pixel is traced.
constexpr std::string_view k_trace = "trace";
constexpr const char* k_fixed_scale =
    "the scale cannot change while recording or replaying: mouse positions are in pixels";

/// Returns the first error, on one line.
std::string headline(const Error& error) {
    for (const Diagnostic& diagnostic : error.diagnostics)
        if (diagnostic.severity == Severity::error)
            return to_string(diagnostic);
    return error.message;
}

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
        return announce("scale", k_fixed_scale);
    if (picture_.adapts())
        toggle_adaptive();
    if (wanted != picture_.scale()) {
        carry_out(overlay::GiveUpSeek{});
        change_scale(wanted);
    }
    tell("scale", fmt::format("scale {}: {}", picture_.scale().name(), scene::to_string(drawn_extent())));
}

void Viewer::toggle_adaptive() {
    if (recorder_.mode() != Recorder::Mode::live)
        return announce("scale", k_fixed_scale);
    if (picture_.adapts()) {
        picture_.adapt_to(std::nullopt);
        return announce("scale",
                        fmt::format("adaptive scale is off: the scale stays at {}", picture_.scale().name()));
    }
    const double fps = settings_.adaptive.value_or(settings_.frames.state.fps);
    picture_.adapt_to(fps);
    announce("scale", fmt::format("adaptive scale is on: it aims at {:g} fps", fps));
}

/// Returns the timers for the next frame; null while neither the controls nor adaptive scaling need them. The
/// time of the frame before may change the scale of this one, except while a thread compiles, when it is not
/// reliable.
std::vector<render::PassTimer>* Viewer::time_next_frame() {
    if (!overlay_.shows(Overlay::Panel::controls) && !picture_.adapts() && !picture_.lens().shows_status())
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

/// Opens scenes that are dropped on the window; another file becomes an input.
void Viewer::handle(const host::FilesDropped& event) {
    if (recorder_.mode() != Recorder::Mode::live)
        return tell("dropped", "no files are taken while recording or replaying");
    const bool scenes =
        std::ranges::all_of(event.paths, [](const std::string& path) { return scene::is_scene_file(path); });
    if (scenes && settings_.opens_others) {
        leave_ = Leave{Leave::To::files, event.paths};
        end_ = End::left;
    } else if (scenes || event.paths.size() != 1) {
        tell("dropped", "drop scenes, or one picture, sound or video");
    } else {
        take_input_file(event.paths.front());
    }
}

/// Ends for another scene or the gallery, if there is one and the key is one for that.
bool Viewer::leave_by(host::Key key) {
    using host::Key;
    const bool goes = key == Key::backspace || key == Key::page_up || key == Key::page_down;
    if (!goes || !settings_.in_gallery)
        return false;
    leave_ = Leave{key == Key::backspace ? Leave::To::gallery
                   : key == Key::page_up ? Leave::To::previous
                                         : Leave::To::next};
    end_ = End::left;
    return true;
}

/// Makes a dropped file the input of the first channel that Image reads and that has no input, else of the
/// first that it reads.
void Viewer::take_input_file(const std::string& file) {
    if (!stage_)
        return tell("dropped", "no scene is on show yet");
    const render::Renderer& renderer = stage_->renderer();
    const scene::Channels& channels = renderer.scene().image().channels;
    std::vector<int> read;
    for (const render::PlannedPass& planned : renderer.plan().passes)
        if (planned.pass == renderer.scene().image_index())
            read.assign(planned.channels.begin(), planned.channels.end());
    const auto is_free = [&](int channel) {
        const scene::Channel& its = channels[size_t(channel)];
        return its.where.file.empty() && traits_of(its.input).default_input;
    };
    const auto free = std::ranges::find_if(read, is_free);
    if (read.empty())
        return tell("dropped", "Image reads no channel: write texture(iChannel0, uv) to show the file");
    const int channel = free != read.end() ? *free : read.front();
    const std::string line = fmt::format("iChannel{} reads {}", channel, file);
    scene_.give_channel(channel, file, view());
    announce("dropped", line);
}

void Viewer::copy_picture() {
    if (!has_frame())
        return;
    const Frozen* const frozen = picture_.frozen();
    const image::Image picture = without_alpha(frozen ? frozen->picture.pixels : read_picture().pixels);
    const auto png = image::encode_png(
        {image::FileFormat::png, image::SampleDepth::u8, picture.extent, 3, picture.bytes, {}});
    const auto copied =
        png ? screen_->set_clipboard_picture({reinterpret_cast<const char*>(png->data()), png->size()})
            : fail(ErrorCode::write, png.error());
    if (!copied) {
        say(copied.error().message + "; the picture is saved as a file");
        save_picture();
        return tell("copied", copied.error().message + "; saved as a file");
    }
    announce("copied", fmt::format("copied the picture, {}", scene::to_string(picture.extent)));
}

/// Starts a video of what is shown, or ends it.
void Viewer::toggle_video() {
    constexpr double k_until_it_ends = std::numeric_limits<double>::infinity();
    const double now = now_seconds();
    VideoRecording* const video = recorder_.video();
    if (video && video->stopped())
        return;
    if (video) {
        video->stop(now);
        return tell("video", fmt::format("completing {}", video->name().string()), k_until_it_ends);
    }
    if (!has_frame())
        return;
    const auto started =
        recorder_.start_video(settings_.scene.path, stage_->extent(), settings_.frames.state.fps, now,
                              [&on = *screen_] { on.wake(); });
    const std::string line =
        started ? fmt::format("recording {}; Ctrl+R ends it", recorder_.video()->name().string())
                : to_string(started.error());
    announce("video", line, started ? k_until_it_ends : Messages::k_seconds);
    record_video(now);
}

/// Adds the frame on show to the video. Ends it when the size of the picture changes.
void Viewer::record_video(double now) {
    VideoRecording* const video = recorder_.video();
    if (!video || picture_.frozen() || !video->wants(now))
        return;
    if (stage_->extent() != video->extent())
        return toggle_video();
    video->show(stage_->renderer().read_back(), now);
}

void Viewer::report_video() {
    if (!recorder_.video() || !recorder_.video()->done())
        return;
    const std::string line = recorder_.video()->report();
    recorder_.end_video();
    announce("video", line, 2 * Messages::k_seconds);
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
    if (has_feedback() && picture_.lens().wants_buffers())
        picture_.lens().keep_buffers(state, stage_->renderer().buffer_state());
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
    if (frame.drawn)
        record_video(now_seconds());
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
    overlay::Model model = overlay_model();
    const Frozen* frozen = picture_.frozen();
    const gl::RenderTarget* lens = frozen || !stage_ ? nullptr : picture_.lens().target();
    fresh = picture_.lens().take_fresh() || fresh;
    screen_->begin(frozen   ? &frozen->target
                   : lens   ? lens
                   : stage_ ? &stage_->renderer().target()
                            : nullptr,
                   fresh);
    if (marked && !lens)
        picture_.draw_marks(*marked, screen_->extent());
    if (auto shown = screen_->finish(std::move(model), shown_moment()); !shown)
        say(to_string(shown.error()));
}

overlay::Model Viewer::overlay_model() {
    render::FrameState turned = shown_.state;
    if (pump_.drawing() && recorder_.mode() == Recorder::Mode::live)
        controls_.fill(turned); // newer than the frame on show
    const render::Renderer* renderer = stage_ ? &stage_->renderer() : nullptr;
    overlay::Model model = overlay_.model(renderer ? &renderer->scene() : nullptr, scene_.request(),
                                          turned.knobs, inputs_ && inputs_->has_midi(), now_seconds());
    if (picture_.magnifies() && renderer && !pump_.seeking() && !picture_.frozen())
        model.magnifier = picture_.magnifier(*renderer, inputs_of_shown(), screen_->extent());
    if (const double now = now_seconds(); pump_.draws_for_long(now)) {
        model.clock = pump_.progress(now, shown_.current);
        pump_.progress_shown(now);
    }
    if (renderer && !picture_.frozen())
        model.lens = picture_.legend(screen_->extent());
    if (renderer && picture_.lens().shows_status())
        model.status = status_line(now_seconds());
    if (!model.controls)
        return model;
    model.lenses = picture_.lens().chooser();
    model.hot_lines = picture_.lens().hot_lines();
    model.front = picture_.lens().front();
    picture_.add_thumbnails(model, overlay_.kept_views());
    picture_.add_pictures(model, *renderer, costs_, inputs_of_shown(), screen_->extent());
    model.time = timeline_.field(shown_.state);
    model.time.turns_back = !has_feedback();
    if (pump_.seeking())
        model.time.stepping = pump_.seek_progress();
    model.extent = renderer->extent();
    if (sound_->plays())
        model.sound = volume_;
    return model;
}

ShownMoment Viewer::shown_moment() const {
    return {.seconds = shown_.state.seconds(),
            .frame = shown_.state.frame,
            .reads_keyboard = stage_ && reads_keyboard(stage_->renderer()),
            .follows_pointer = pointer_moves_mouse_,
            .reads_camera = stage_ && reads_camera(stage_->renderer()),
            .begun = shown_.begun};
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
    if (picture_.shows_marks() && pump_.would_block(drawn_extent()))
        announce("marks", "marks are off while a frame takes more than a second");
    else
        tell("marks", picture_.shows_marks() ? "marks: NaN magenta, infinity green, below zero blue"
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
        return announce("frozen", "the driver has no memory to freeze the picture");
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
    return host::trace_words(scene_.request(), settings_.frames, state);
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
        return announce(k_trace, to_string(started.error()));
    search_ = *std::move(started);
    announce(k_trace, fmt::format("tracing pixel {},{}; press Enter to cancel", pixel.x, pixel.y),
             std::numeric_limits<double>::infinity());
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

/// Returns why no scene can have a lens in this window; empty: it can.
std::string Viewer::no_lens() const {
    if (!settings_.frames.state.pass.empty() && settings_.frames.state.pass != "Image")
        return "only Image has a lens: remove --pass";
    if (precision_of(settings_.scene) != glsl::Precision::single)
        return "not in double precision: remove --precision";
    if (!compiles_on_threads())
        return "TIDEMARK_ASYNC_COMPILE=off allows no second thread";
    return "";
}

/// Gives the thread of the lenses its next work, and shows what it has drawn.
void Viewer::follow_lens(double now) {
    LensView& lens = picture_.lens();
    if (!lens.active() || !stage_ || !shown_.current || pump_.seeking() || pump_.driver_held(now) ||
        !screen_->is_watched())
        return;
    const LensMoment moment{lens.scene(),   shown_.state,  inputs_of_shown(), lens.buffers_for(shown_.state),
                            has_feedback(), quick_extent()};
    const bool changed = lens.follow(
        moment, pump_.moving(around()), now, [this] { return screen_->create_context(); },
        [&on = *screen_] { on.wake(); });
    if (changed)
        report_lens();
}

/// Shows a change of the lens.
void Viewer::report_lens() {
    overlay_.mark_changed();
    const std::string message = picture_.lens().take_message();
    if (message.empty())
        return;
    say(message);
    tell("lens", message);
}

/// Returns a size in which a frame takes no longer than a part of a slow one.
Extent Viewer::quick_extent() const {
    constexpr double k_seconds = 0.03;
    Extent extent = stage_->extent();
    const double seconds = pump_.expected(extent).value_or(0);
    for (double left = seconds; left > k_seconds && extent.width > 32 && extent.height > 32; left /= 4)
        extent = {extent.width / 2, extent.height / 2};
    return extent;
}

void Viewer::toggle_status() {
    picture_.lens().toggle_status();
    overlay_.mark_changed();
}

/// Returns the status line: the state of the window, then the numbers of the frame on show.
std::string Viewer::status_line(double now) const {
    std::optional<double> milliseconds;
    for (const render::PlannedPass& planned : stage_->renderer().plan().passes)
        if (const auto took = costs_.of(planned.pass))
            milliseconds = milliseconds.value_or(0) + *took;
    return fmt::format("{}  {}", state_words(now), picture_.lens().status(milliseconds));
}

/// Returns the state with the frame rate, which changes twice a second at most.
std::string Viewer::state_words(double now) const {
    std::string state =
        pump_.seeking() ? fmt::format("stepping to frame {}, Esc cancels", pump_.seek_progress().last)
        : pump_.flow() == FramePump::Flow::cancelled ? "cancelled, space continues"
        : timeline_.paused()                     ? fmt::format("paused at {:.3f} s", shown_.state.seconds())
        : pump_.flow() == FramePump::Flow::still ? "still"
                                                 : fmt::format("{:.0f} fps", timeline_.frame_rate());
    if (const std::string words = pump_.progress(now, shown_.current); !words.empty())
        state = words;
    if (picture_.scale() != RenderScale())
        state += fmt::format(", scale {}", picture_.scale().name());
    if (picture_.frozen())
        state += ", frozen";
    if (const VideoRecording* video = recorder_.video(); video && !video->stopped())
        state += ", recording";
    if (finite_.found() > 0)
        state += fmt::format(", {} pixel{} not finite", finite_.found(), finite_.found() > 1 ? "s" : "");
    if (const std::string note = settings_.editor ? settings_.editor->note() : ""; !note.empty())
        state += ", " + note;
    return state;
}

/// Sets the title: the compile time while compiling, else the error if there is one, else the state. Between
/// two slow frames it stays, so that it does not change between progress and frame rate.
void Viewer::show_title(double now) {
    const bool between = pump_.frames_show_progress() && !pump_.drawing() && pump_.moving(around());
    if (between && stage_ && !scene_.failure() && !compiles_for_long(now))
        return;
    std::string state = state_words(now);
    overlay_.messages().retell("state", state);
    if (compiles_for_long(now))
        state = fmt::format("compiling… {:.0f} s{}", now - *scene_.building_since(),
                            stage_ ? ", Esc cancels" : "");
    else if (!stage_ && !scene_.failure())
        return;
    const std::string title = scene_.failure() && !compiles_for_long(now)
                                  ? (stage_ ? "" : "waiting: ") + headline(*scene_.failure())
                                  : fmt::format("{} - tidemark - {}", scene_.name(), state);
    if (overlay_.change_title(title))
        screen_->set_title(title);
}

} // namespace tidemark::window
