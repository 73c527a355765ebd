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

namespace tidemark::window {

using namespace host;
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

void Viewer::carry_out(const overlay::Seek& command) {
    timeline_.fit_bar();
    seek(command.seconds, now_seconds());
}

void Viewer::carry_out(const overlay::HoldBar& command) {
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

void Viewer::carry_out(const overlay::GiveUpSeek&) {
    if (!pump_.seeking())
        return;
    const int next = pump_.seek_next();
    cancel_frame();
    timeline_.pause_at(next, now_seconds());
    pump_.ask();
}

void Viewer::carry_out(const overlay::SetPlaying& command) {
    if (command.on == timeline_.paused())
        carry_out(overlay::TogglePause{});
}

void Viewer::go_round(double now) {
    if (!pump_.moving(around()) || pump_.drawing() || recorder_.mode() == Recorder::Mode::recording)
        return;
    if (const auto there = timeline_.loop_jump(now))
        seek(*there, now);
}

// Commands

void Viewer::carry_out_all(const overlay::Commands& commands) {
    edited_ |= !commands.empty();
    for (const overlay::Command& command : commands)
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
        picture_.lens().forget_front();
        picture_.lens().watch_lines(false); // the panel asks for them again
        return picture_.hide_pictures();
    }
    leave_optimised();
}

/// Has the text compiled as written, where an optimised program holds the values of knobs.
void Viewer::leave_optimised() {
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

void Viewer::carry_out(const overlay::TurnKnob& command) {
    if (!stage_)
        return;
    const auto& knobs = stage_->renderer().scene().knobs;
    const auto knob = std::ranges::find(knobs, command.name, &scene::Knob::name);
    if (knob == knobs.end())
        return; // an edit has just removed it
    scene::KnobSetting setting = setting_of(*knob, command.value);
    if (const auto value = value_for(*knob, setting.value); !value)
        return say(value.error().message);
    if (overlay_.shows(Overlay::Panel::controls))
        picture_.lens().turn_knob(command.name);
    control(KnobTurned{std::move(setting)});
}

void Viewer::carry_out(const overlay::ResetKnob& command) {
    control(KnobTurned{{command.name, {}}}); // the scene's default
}

void Viewer::carry_out(const overlay::ResetKnobs&) {
    if (!stage_)
        return;
    for (const scene::Knob& knob : stage_->renderer().scene().knobs)
        if (value_after(knob, shown_.state.knobs) != knob.initial)
            carry_out(overlay::ResetKnob{knob.name});
}

void Viewer::carry_out(const overlay::CopyKnobs&) {
    if (!stage_)
        return;
    std::vector<std::string> words;
    for (const scene::Knob& knob : turned_scene().knobs)
        if (knob.value != knob.initial)
            words.insert(words.end(), {"--set", fmt::format("{}={}", knob.name, to_string(knob))});
    if (words.empty())
        return announce("copied", "nothing to copy: every knob has the file's value");
    const std::string text = shell_words(words);
    screen_->set_clipboard(text);
    announce("copied", "copied: " + text);
}

/// Writes the knobs into their files. The reload that follows finds each at its value.
void Viewer::carry_out(const overlay::WriteKnobs&) {
    if (!stage_)
        return;
    auto written = write_knobs(turned_scene().knobs);
    if (!written)
        return announce("written", to_string(written.error()));
    for (const std::string& line : *written)
        say(line);
    tell("written", fmt::format("{}", fmt::join(*written, "\n")));
}

void Viewer::carry_out(const overlay::SetLens& command) {
    picture_.lens().choose(command.lens);
    report_lens();
}

void Viewer::carry_out(const overlay::OpenEditor& command) {
    if (auto opened = open_editor(command.where); !opened)
        announce("editor", to_string(opened.error()));
}

void Viewer::carry_out(const overlay::LearnController& command) {
    overlay_.controllers().learn({command.knob, command.component});
    overlay_.mark_changed();
}

void Viewer::carry_out(const overlay::ForgetController& command) {
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
    if (!shown_.current && !picture_.frozen())
        announce("frame", "no frame is drawn yet");
    return shown_.current || picture_.frozen();
}

void Viewer::save_picture() {
    const Frozen* frozen = picture_.frozen();
    if (!shown_.current && !frozen) {
        recorder_.save_next();
        return announce("saved", "no frame is drawn yet: the first one is saved");
    }
    const auto saved =
        recorder_.save(frozen ? frozen->picture : read_picture(), settings_.scene.path, scene_files());
    announce("saved", saved ? fmt::format("saving {}", *saved) : to_string(saved.error()));
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
    if (stage_ && reads_camera(stage_->renderer())) {
        state.camera = rounded(state.camera);
    } else {
        state.camera = {};
        state.initial_camera.reset();
    }
    std::string command = capture_command(copied);
    if (picture_.lens().on())
        command += " " + shell_words(std::vector<std::string>{"--lens", picture_.lens().chosen()});
    screen_->set_clipboard(command);
    say("copied: " + command);
    tell("copied", "copied the command that captures this moment");
}

void Viewer::keep_moment() {
    if (!has_frame())
        return;
    const std::string line = "kept " + overlay_.keep(view_on_show());
    edited_ = true;
    say(line);
    const size_t number = overlay_.views().size();
    tell("kept", number > 9 ? line : fmt::format("{} (Alt+{})", line, number));
}

/// Returns the moment on show as a view without a name.
Preset Viewer::view_on_show() const {
    constexpr Extent k_thumbnail{96, 54};
    const Frozen* const frozen = picture_.frozen();
    const Moment now = moment();
    Preset view = preset_of(now, "");
    view.knobs.clear();
    for (const scene::Knob& knob : stage_->renderer().scene().knobs)
        if (const auto value = value_after(knob, now.sequence.state.knobs); value != knob.initial)
            view.knobs.push_back(setting_of(knob, value));
    view.picture =
        thumbnail_of(frozen ? frozen->picture.pixels : stage_->renderer().read_back(), k_thumbnail);
    return view;
}

/// Reads the views of the scene's file, and those that earlier windows could not write there.
void Viewer::open_presets() {
    if (settings_.scene.path == "-")
        return;
    auto file = PresetFile::read(settings_.scene.path);
    std::vector<Preset> views;
    if (file) {
        views = file->presets();
        presets_ = *std::move(file);
    } else {
        say(fmt::format("warning: {}; views are kept on this machine only", file.error().message));
    }
    const size_t in_file = views.size();
    if (settings_.left)
        for (const Preset& other : settings_.left->views)
            if (std::ranges::find(views, other.name, &Preset::name) == views.end())
                views.push_back(other);
    if (in_file > 0)
        say(fmt::format("{} view{} in {}: Alt+1 to Alt+9 go to them", in_file, in_file > 1 ? "s" : "",
                        presets_->path().string()));
    const bool all_in_file = views.size() == in_file;
    overlay_.set_views(std::make_shared<const std::vector<Preset>>(std::move(views)));
    if (all_in_file)
        presets_written_ = overlay_.kept_views();
}

/// Writes the views to the scene's file when they have changed. If that fails, this machine keeps them.
void Viewer::write_presets() {
    if (!presets_ || overlay_.kept_views() == presets_written_)
        return;
    auto written = presets_->write(overlay_.views());
    if (!written) {
        const std::string line = written.error().message + "; views are kept on this machine only";
        say("warning: " + line);
        tell("presets", line);
        return presets_.reset();
    }
    if (presets_->presets().size() != overlay_.views().size()) // another window has added some
        overlay_.set_views(std::make_shared<const std::vector<Preset>>(presets_->presets()));
    presets_written_ = overlay_.kept_views();
}

void Viewer::carry_out(const overlay::RenameView& command) {
    if (auto renamed = overlay_.rename_view(command.index, command.name); !renamed)
        announce("presets", renamed.error().message);
}

/// Moves knobs and camera on the way to a view.
void Viewer::advance_morph(double now) {
    if (!morph_ || !stage_)
        return;
    const bool last = morph_->done(now);
    for (const scene::KnobSetting& setting : morph_->knobs(now))
        control(KnobTurned{setting});
    controls_.place_camera(morph_->camera(now));
    edited_ = true;
    touched_at_ = now;
    pump_.ask();
    if (last)
        morph_.reset();
}

/// Takes knobs, camera and mouse of a view.
void Viewer::adopt_view(const Preset& view) {
    render::FrameState state;
    state.knobs = stage_ ? settings_of(view, stage_->renderer().scene().knobs) : view.knobs;
    state.camera = view.camera;
    state.mouse = view.mouse;
    controls_.adopt(state);
    controls_.stretch(view.extent, drawn_extent());
    if (stage_)
        release_knobs();
    shown_.state.knobs.clear();
    controls_.fill(shown_.state);
}

/// Goes to a kept view as the time bar does; its definitions are compiled first. With a time for the change,
/// knobs and camera move there while iTime runs on.
void Viewer::carry_out(const overlay::GoToView& command) {
    if (command.index >= overlay_.views().size())
        return tell("view", fmt::format("there is no view {}; K keeps one", command.index + 1));
    if (recorder_.mode() != Recorder::Mode::live)
        return announce("view", "views cannot be used while recording or replaying");
    const Preset& kept = overlay_.views()[command.index];
    const double now = now_seconds();
    tell("view", fmt::format("{} {}", command.index + 1, kept.name));
    leave_optimised();
    touched_at_ = now;
    pump_.ask();
    edited_ = true;
    const bool defines_differ = kept.defines != scene_.request().defines;
    if (stage_ && overlay_.morph_seconds() > 0) {
        render::FrameState from;
        controls_.fill(from);
        std::vector<scene::Knob> knobs = stage_->renderer().scene().knobs;
        for (scene::Knob& knob : knobs)
            knob.value = value_after(knob, from.knobs);
        morph_.emplace(knobs, from.camera, kept, now, overlay_.morph_seconds());
        if (defines_differ)
            scene_.hold(kept.defines, view());
        return;
    }
    morph_.reset();
    adopt_view(kept);
    if (!defines_differ)
        return seek(kept.seconds, now);
    timeline_.begin_next_scene_at(kept.seconds);
    scene_.hold(kept.defines, view());
}

/// Restores the state of the last window.
void Viewer::take_up(const Remembered& left) {
    overlay_.restore(left.controls_open, left.morph_seconds, left.controllers);
    volume_ = left.sound;
    sound_->set_volume(volume_.heard());
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
    return Remembered{.moment = moment(),
                      .place = screen_->place(),
                      .scale = picture_.scale(),
                      .controls_open = overlay_.shows(Overlay::Panel::controls),
                      .views = presets_ ? std::vector<Preset>{} : overlay_.views(),
                      .morph_seconds = overlay_.morph_seconds(),
                      .controllers = overlay_.controllers().bindings(),
                      .paused = timeline_.paused(),
                      .sound = volume_};
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

void Viewer::follow_edits(double now, bool morphing) {
    if (std::exchange(edited_, false) && stage_ && recorder_.mode() == Recorder::Mode::live)
        history_.follow(edits(), now, !buttons_.empty() || morphing);
}

/// Restores the edits of another step; none: reports that there is none. `done` is the verb for the message.
void Viewer::go_to(const std::optional<Edits>& wanted, const char* done) {
    if (recorder_.mode() != Recorder::Mode::live)
        return tell("undo", "undo is off while recording or replaying");
    if (!wanted || !stage_)
        return tell("undo", fmt::format("nothing more to be {}", done));
    morph_.reset();
    leave_optimised();
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

void Viewer::play_sound() {
    if (settings_.sounds)
        sound_->play([this] { return screen_->create_context(); }, stage_->renderer().scene(),
                     precision_of(settings_.scene));
}

/// Returns whether iTime runs as fast as a clock.
bool Viewer::sound_runs() const {
    constexpr double k_shown_as_one = 0.005; // the controls show two digits
    return stage_ && !timeline_.paused() && std::abs(timeline_.speed() - 1) < k_shown_as_one &&
           !pump_.seeking() && pump_.flow() != FramePump::Flow::cancelled;
}

void Viewer::set_volume(const overlay::SoundField& wanted) {
    if (!sound_->plays())
        return tell("sound", "the scene has no sound");
    volume_ = wanted;
    sound_->set_volume(volume_.heard());
    tell("sound", volume_.muted ? "muted; U turns the sound on"
                                : fmt::format("volume {:.0f} %", 100 * volume_.volume));
    overlay_.mark_changed();
}

void Viewer::change_volume(int steps) {
    constexpr double k_steps = 10;
    set_volume({std::clamp((std::round(volume_.volume * k_steps) + steps) / k_steps, 0.0, 1.0), false});
}

} // namespace tidemark::window
