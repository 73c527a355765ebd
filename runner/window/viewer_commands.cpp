// Carries out the commands of the panels and of live inputs; the moment on show as a value.

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "host/console.hpp"
#include "host/fingerprint.hpp"
#include "host/scene_report.hpp"
#include "scene/knob.hpp"
#include "window/viewer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace tidemark::cli {
namespace {

Result<std::string> write_into(const std::string& file, const std::vector<scene::Knob>& knobs) {
    const std::string text = TRY(read_text_file(file));
    const auto changed = scene::with_defaults(text, knobs);
    if (!changed)
        return fail(ErrorCode::write,
                    fmt::format("cannot write knobs into '{}': {}", file, changed.error().message));
    TRY(replace_text(OutputPath::typed(file), text, *changed));
    std::string line = fmt::format("{}:", file);
    for (const scene::Knob& knob : knobs)
        line += fmt::format(" {} = {}", knob.name, to_string(knob));
    return line;
}

/// Writes the knobs that differ from their defaults. Returns a message for each file; fails
/// (ErrorCode::write) where a file cannot be written or no longer declares the knob.
Result<std::vector<std::string>> write_knobs(const std::vector<scene::Knob>& knobs) {
    std::map<std::string, std::vector<scene::Knob>> by_file;
    for (const scene::Knob& knob : knobs)
        if (knob.value != knob.initial)
            by_file[knob.where.file].push_back(knob);
    if (by_file.empty())
        return std::vector<std::string>{"nothing to write: every knob has the file's value"};
    std::vector<std::string> lines;
    for (const auto& [file, turned] : by_file)
        lines.push_back(TRY(write_into(file, turned)));
    return lines;
}

/// Returns true if a program of the scene reads the orbit camera.
bool uses_camera(const render::Renderer& renderer) {
    const SceneFacts facts = facts_of(renderer);
    std::vector<std::string> read = facts.uniforms;
    for (const auto& [name, ours] : facts.other_names)
        read.push_back(ours);
    return std::ranges::any_of(read, [](const std::string& name) {
        return name == "iCamera" || name == "iOrbit" || name == "iOrbitPan" || name == "iViewMatrix";
    });
}

/// Returns the number with six significant digits.
double rounded(double number) {
    return number_from<double>(fmt::format("{:.6g}", number)).value_or(number);
}

render::OrbitCamera rounded(const render::OrbitCamera& camera) {
    const glm::dvec3& target = camera.target;
    return {rounded(camera.azimuth),
            rounded(camera.elevation),
            rounded(camera.distance),
            {rounded(target.x), rounded(target.y), rounded(target.z)}};
}

} // namespace

// Time

/// Goes to a time. With feedback all earlier frames are drawn, so that the buffers have their usual contents.
void Viewer::seek(double seconds, double now) {
    const auto frame = timeline_.frame_at(seconds);
    if (!frame)
        return; // a typed number may be out of range
    pump_.ask();
    pump_.resume();
    if (has_feedback())
        cancel_frame(); // without feedback it is completed, so that something is visible while dragging
    timeline_.seek(seconds, *frame, now);
    pump_.doubt(drawn_extent());
    forget_what_follows();
    if (!has_feedback())
        return;
    shown_.current = false;
    if (*frame == 0)
        return stage_->reset();
    render::FrameState state = shown_.state;
    state.extent = stage_->extent();
    state.time.reset();
    state.time_delta.reset();
    state.fps = settings_.frames.state.fps;
    const auto states = [state, fill = recorder_.filler()](int number) {
        render::FrameState seen = state.at_frame(number);
        fill(seen);
        return seen;
    };
    pump_.seek(*stage_, states, *frame - 1, seconds);
}

void Viewer::carry_out(const live::Seek& command) {
    timeline_.fit_bar();
    seek(command.seconds, now_seconds());
}

void Viewer::carry_out(const live::HoldBar& command) {
    command.held ? timeline_.hold_bar(shown_.state.seconds()) : timeline_.release_bar();
}

/// Draws a few more frames of a seek, then the bar. At the end, time continues from there.
void Viewer::advance_seek() {
    constexpr double k_seconds = 1 / 30.0;
    if (!pump_.seeking() || !make_way())
        return;
    if (const auto seconds = pump_.advance_seek(k_seconds)) {
        timeline_.seek(*seconds, timeline_.next_frame_number(), now_seconds());
        pump_.ask();
    }
    overlay_.mark_changed();
}

void Viewer::carry_out(const live::GiveUpSeek&) {
    if (!pump_.seeking())
        return;
    const int next = pump_.seek_next();
    cancel_frame();
    timeline_.pause_at(next, now_seconds());
    pump_.ask();
}

void Viewer::carry_out(const live::SetPlaying& command) {
    if (command.on == timeline_.paused())
        carry_out(live::TogglePause{});
}

void Viewer::go_round(double now) {
    if (!pump_.moving(around()) || pump_.drawing() || recorder_.mode() == Recorder::Mode::recording)
        return;
    if (const auto there = timeline_.loop_jump(now))
        seek(*there, now);
}

// Commands

void Viewer::carry_out_all(const live::Commands& commands) {
    edited_ |= !commands.empty();
    for (const live::Command& command : commands)
        std::visit([this](const auto& wanted) { carry_out(wanted); }, command);
}

/// Takes messages of live inputs. The knobs that they change have their latest values, which may not be in a
/// frame yet.
void Viewer::take_inputs() {
    if (!inputs_ || !stage_ || !inputs_->any())
        return;
    render::FrameState state;
    controls_.fill(state);
    std::vector<scene::Knob> knobs = stage_->renderer().scene().knobs;
    for (scene::Knob& knob : knobs)
        knob.value = value_after(knob, state.knobs);
    carry_out_all(inputs_->take(std::move(knobs), overlay_.controllers()));
}

/// Opens or closes the controls. An optimised program contains the knobs' values, so the text is compiled as
/// written while they may change.
void Viewer::toggle_controls() {
    overlay_.toggle(Overlay::Panel::controls);
    if (!overlay_.shows(Overlay::Panel::controls)) {
        timeline_.release_bar();
        return picture_.hide_pictures();
    }
    settled_ = false;
    scene_.stop_settling();
    if (stage_ && stage_->share() && !scene_.building_since())
        scene_.build_anew(turned_scene(), view(), LiveScene::Settle::no);
}

/// Shows the help, in the terminal too, where it remains after the window.
void Viewer::toggle_help() {
    overlay_.toggle(Overlay::Panel::help);
    if (overlay_.shows(Overlay::Panel::help))
        say(key_table());
}

void Viewer::carry_out(const live::TurnKnob& command) {
    if (!stage_)
        return;
    const auto& knobs = stage_->renderer().scene().knobs;
    const auto knob = std::ranges::find(knobs, command.name, &scene::Knob::name);
    if (knob == knobs.end())
        return; // an edit has just removed it
    scene::KnobSetting setting = setting_of(*knob, command.value);
    if (const auto value = value_for(*knob, setting.value); !value)
        return say(value.error().message);
    control(KnobTurned{std::move(setting)});
}

void Viewer::carry_out(const live::ResetKnob& command) {
    control(KnobTurned{{command.name, {}}}); // the scene's default
}

void Viewer::carry_out(const live::ResetKnobs&) {
    if (!stage_)
        return;
    for (const scene::Knob& knob : stage_->renderer().scene().knobs)
        if (value_after(knob, shown_.state.knobs) != knob.initial)
            carry_out(live::ResetKnob{knob.name});
}

void Viewer::carry_out(const live::CopyKnobs&) {
    if (!stage_)
        return;
    std::vector<std::string> words;
    for (const scene::Knob& knob : turned_scene().knobs)
        if (knob.value != knob.initial)
            words.insert(words.end(), {"--set", fmt::format("{}={}", knob.name, to_string(knob))});
    const std::string text = shell_words(words);
    screen_->set_clipboard(text);
    say(words.empty() ? "nothing to copy: every knob has the file's value" : "copied: " + text);
}

/// Writes the knobs into their files. The reload that follows finds each at its value.
void Viewer::carry_out(const live::WriteKnobs&) {
    if (!stage_)
        return;
    auto written = write_knobs(turned_scene().knobs);
    if (!written)
        return say(to_string(written.error()));
    for (const std::string& line : *written)
        say(line);
}

void Viewer::carry_out(const live::OpenEditor& command) {
    if (auto opened = open_editor(command.where); !opened)
        say(to_string(opened.error()));
}

void Viewer::carry_out(const live::LearnController& command) {
    overlay_.controllers().learn({command.knob, command.component});
    overlay_.mark_changed();
}

void Viewer::carry_out(const live::ForgetController& command) {
    overlay_.controllers().forget({command.knob, command.component});
    overlay_.mark_changed();
}

// The moment on show as a value: copied as a command, saved with pictures, kept and restored.

Moment Viewer::moment() const {
    if (const Frozen* frozen = picture_.frozen())
        return frozen->moment;
    FrameSequence sequence = settings_.frames;
    if (recorder_.mode() == Recorder::Mode::recording)
        sequence.input_file = recorder_.file().string();
    render::FrameState state = shown_.state;
    state.pass = sequence.state.pass;
    if (!timeline_.by_frames())
        sequence.lead_in_fps = sequence.state.fps;
    return moment_of(scene_.request(), sequence, std::move(state));
}

/// Returns the picture on show, with the metadata that reproduces it.
KeptPicture Viewer::read_picture() const {
    const render::Renderer& renderer = stage_->renderer();
    const auto fingerprint = Fingerprint::of_scene(renderer.scene(), scene_.request().defines,
                                                   settings_.frames, gl::query_capabilities());
    KeptPicture picture{
        shown_.state.frame,
        renderer.read_back(),
        {image::SampleDepth::u8, metadata_of(renderer.scene(), moment()), image::Transfer::srgb}};
    picture.format.metadata.emplace_back(k_fingerprint, fingerprint.text());
    count_not_finite(renderer, picture.pixels); // removes the marks from alpha
    return picture;
}

/// Returns whether a frame of the current text is on show; prints a line if not.
bool Viewer::has_frame() {
    if (!shown_.current && !picture_.frozen()) {
        say("no frame is drawn yet");
        tell("frame", "no frame is drawn yet");
    }
    return shown_.current || picture_.frozen();
}

void Viewer::save_picture() {
    const Frozen* frozen = picture_.frozen();
    if (!shown_.current && !frozen) {
        recorder_.save_next();
        tell("saved", "no frame is drawn yet: the first one is saved");
        return say("no frame is drawn yet: the first one is saved");
    }
    const auto saved =
        recorder_.save(frozen ? frozen->picture : read_picture(), settings_.scene.path, scene_files());
    const std::string line = saved ? fmt::format("saving {}", *saved) : to_string(saved.error());
    say(line);
    tell("saved", line);
}

/// Copies the capture command, with rounded numbers of the camera if the scene uses it. Leaves out the rate
/// of the window's clock, and the date unless the user gave one.
void Viewer::copy_moment() {
    if (!has_frame())
        return;
    Moment copied = moment();
    render::FrameState& state = copied.sequence.state;
    state.fps = settings_.frames.state.fps;
    state.date = settings_.frames.state.date;
    if (stage_ && uses_camera(stage_->renderer())) {
        state.camera = rounded(state.camera);
    } else {
        state.camera = {};
        state.initial_camera.reset();
    }
    const std::string command = capture_command(copied);
    screen_->set_clipboard(command);
    say("copied: " + command);
    tell("copied", "copied the command that captures this moment");
}

void Viewer::keep_moment() {
    if (!has_frame())
        return;
    const std::string line = "kept: " + overlay_.keep(moment());
    edited_ = true;
    say(line);
    tell("kept", line + "; Tab lists the views");
}

/// Goes to a kept view as the time bar does; its definitions are compiled first.
void Viewer::carry_out(const live::GoToView& command) {
    if (command.index >= overlay_.views().size())
        return;
    if (recorder_.mode() != Recorder::Mode::live)
        return say("kept views are off during a replay");
    const Moment& kept = overlay_.views()[command.index];
    const render::FrameState& state = kept.sequence.state;
    controls_.adopt(state);
    controls_.stretch(state.extent, drawn_extent());
    if (stage_)
        release_knobs();
    shown_.state.knobs.clear();
    controls_.fill(shown_.state);
    const double now = now_seconds();
    touched_at_ = now;
    pump_.ask();
    if (kept.scene.defines == scene_.request().defines)
        return seek(state.seconds(), now);
    timeline_.begin_next_scene_at(state.seconds());
    scene_.hold(kept.scene.defines, view());
}

/// Restores the state of the last window.
void Viewer::take_up(const Remembered& left) {
    overlay_.restore(left.controls_open, left.views, left.controllers);
    if (!left.moment)
        return;
    render::FrameState state = left.moment->sequence.state;
    state.mouse = {};
    controls_.adopt(state);
    timeline_.begin_next_scene_at(state.seconds());
    say(fmt::format("restored: {}; --fresh starts anew", words_of(left)));
}

std::optional<Remembered> Viewer::state() const {
    if (!stage_)
        return settings_.left;
    return Remembered{moment(),          screen_->place(),
                      picture_.scale(),  overlay_.shows(Overlay::Panel::controls),
                      overlay_.views(),  overlay_.controllers().bindings(),
                      timeline_.paused()};
}

// Undo and redo

Edits Viewer::edits() const {
    render::FrameState state;
    controls_.fill(state);
    Edits now{.camera = state.camera, .defines = scene_.request().defines, .views = overlay_.kept_views()};
    if (stage_)
        for (const scene::Knob& knob : stage_->renderer().scene().knobs)
            if (const auto value = value_after(knob, state.knobs); value != knob.initial)
                now.knobs.push_back(setting_of(knob, value));
    return now;
}

void Viewer::follow_edits(double now) {
    if (std::exchange(edited_, false) && stage_ && recorder_.mode() == Recorder::Mode::live)
        history_.follow(edits(), now, !buttons_.empty());
}

/// Restores the edits of another step; none: reports that there is none. `done` is the verb for the message.
void Viewer::go_to(const std::optional<Edits>& wanted, const char* done) {
    if (recorder_.mode() != Recorder::Mode::live)
        return tell("undo", "undo is off while recording or replaying");
    if (!wanted || !stage_)
        return tell("undo", fmt::format("nothing more to be {}", done));
    const Edits before = edits();
    render::FrameState state;
    controls_.fill(state);
    state.knobs = wanted->knobs;
    state.camera = wanted->camera;
    controls_.adopt(state);
    release_knobs();
    shown_.state.knobs.clear();
    controls_.fill(shown_.state);
    overlay_.set_views(wanted->views);
    if (wanted->defines != before.defines)
        scene_.hold(wanted->defines, view());
    touched_at_ = now_seconds();
    pump_.ask();
    pump_.doubt(drawn_extent());
    history_.adopt(edits());
    tell("undo", fmt::format("{}: {}", done, changed_words(before, *wanted)));
}

} // namespace tidemark::cli
