// Parts of the overlay's model that depend on the scene.

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "host/console.hpp"
#include "host/fingerprint.hpp"
#include "host/frame_files.hpp"
#include "host/moment.hpp"
#include "host/overlay_model.hpp"
#include "host/scene_report.hpp"
#include "scene/knob.hpp"
#include "scene/scene.hpp"
#include "shader/definitions.hpp"
#include "window/midi.hpp"
#include "window/source_errors.hpp"
#include "window/viewer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace tidemark::cli {

// Writes the values of knobs into the files that declare them, each file completely or not at all.

std::vector<live::KnobField> knob_fields(const scene::Scene& scene,
                                         const std::vector<scene::KnobSetting>& turned) {
    std::vector<live::KnobField> fields;
    for (const scene::Knob& knob : scene.knobs)
        fields.push_back({knob, value_after(knob, turned)});
    return fields;
}

/// Adds the MIDI binding of each component to the fields.
void add_controllers(std::vector<live::KnobField>& fields, const live::ControllerMap& map) {
    for (live::KnobField& field : fields)
        for (size_t i = 0; i < size_t(info(field.knob.type).components); ++i) {
            const live::KnobPart part{field.knob.name, i};
            const auto controller = map.controller_of(part);
            field.controllers.push_back({to_string(part, field.knob),
                                         controller ? to_string(*controller) : "", map.learning() == part});
        }
}

/// Returns the numeric definitions in the scene's texts, with the overrides of `request`.
std::vector<live::DefinitionField> definition_fields(const scene::Scene& scene, const SceneRequest& request) {
    std::vector<scene::Setting> held;
    for (const std::string& text : request.defines)
        if (const auto split = scene::split_setting(text, "--define"))
            set(held, {std::string(split->first), std::string(split->second)});
    std::vector<live::DefinitionField> fields;
    for (const glsl::NamedText& definition : glsl::plain_numbers(scene)) {
        const auto other = std::ranges::find(held, definition.name, &scene::Setting::name);
        const bool is_held = other != held.end();
        if (auto field =
                live::definition_field(definition.name, is_held ? other->value : definition.text, is_held))
            fields.push_back(*std::move(field));
    }
    return fields;
}

/// Returns labels such as `2.500 s, height = 2`.
std::vector<std::string> view_labels(const std::vector<Moment>& views) {
    std::vector<std::string> labels;
    for (const Moment& view : views) {
        const render::FrameState& state = view.sequence.state;
        labels.push_back(fmt::format("{:.3f} s", state.seconds()));
        for (const scene::KnobSetting& knob : state.knobs)
            labels.back() += fmt::format(", {} = {}", knob.name, scene::to_string(knob.value));
    }
    return labels;
}

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

} // namespace

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

// The contents of the overlay, and its commands.

/// Opens or closes the controls. An optimised program contains the knobs' values, so the text is compiled as
/// written while they may change.
void Viewer::toggle_controls() {
    controls_open_ = !controls_open_;
    stale_overlay_ = true;
    if (!controls_open_)
        return pictures_.reset();
    settled_ = false;
    scene_.stop_settling();
    if (stage_ && stage_->share() && !scene_.building_since())
        scene_.build_anew(turned_scene(), view(), LiveScene::Settle::no);
}

/// Shows a picture of the controls for digits 1 to 9; 0, or the same digit again, shows the scene's own.
void Viewer::show_picture_of(platform::Key digit) {
    if (!controls_open_ || digit < platform::Key::digit_0 || digit > platform::Key::digit_9)
        return;
    const int number = int(digit) - int(platform::Key::digit_0);
    const std::optional<size_t> index = number > 0 ? std::optional(size_t(number) - 1) : std::nullopt;
    large_ = large_ == index ? std::nullopt : index;
    stale_overlay_ = true;
}

/// Shows the help, in the terminal too, where it remains after the window.
void Viewer::toggle_help() {
    help_open_ = !help_open_;
    stale_overlay_ = true;
    if (help_open_)
        say(key_table());
}

/// Returns whether to draw the overlay without a new frame of the scene. A moving scene draws it along with
/// its frames.
bool Viewer::overlay_due() const {
    return screen_->is_watched() && (stale_overlay_ || screen_->wants_frame()) && (making_ || !moving());
}

live::Model Viewer::overlay_model() {
    live::Model model{.controls = controls_open_ && stage_,
                      .errors = errors_.fields().empty() ? origin_.fields() : errors_.fields(),
                      .magnifier = magnifier_field()};
    if (const double now = now_seconds(); draws_for_long(now)) {
        model.clock = drawing_words(now);
        clock_shown_at_ = now;
    }
    if (model.controls && !defined_)
        defined_ = definition_fields(stage_->renderer().scene(), scene_.request());
    if (model.controls) {
        const render::Renderer& renderer = stage_->renderer();
        render::FrameState turned = shown_;
        if (making_ && !replay_)
            controls_.fill(turned); // newer than the frame on show
        model.knobs = knob_fields(renderer.scene(), turned.knobs);
        if (inputs_ && inputs_->has_midi())
            add_controllers(model.knobs, controllers_);
        model.definitions = *defined_;
        look_at_pictures(model);
        model.views = view_labels(views_);
        model.time = time_field();
        model.extent = renderer.extent();
    }
    if (help_open_) {
        for (const KeyRow& row : key_rows())
            model.help.push_back({std::string(row.keys), std::string(row.meaning)});
        model.help_footer = k_keys_of_scenes;
    }
    return model;
}

void Viewer::obey_overlay() {
    for (const live::Command& command : screen_->take_commands())
        std::visit([this](const auto& wanted) { carry_out(wanted); }, command);
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
        if (value_after(knob, shown_.knobs) != knob.initial)
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

void Viewer::carry_out(const live::Define& command) {
    scene_.define(command.name, command.value, view());
}

void Viewer::carry_out(const live::Undefine& command) {
    scene_.define(command.name, std::nullopt, view());
}

/// Returns whether knobs may change soon, which would make a program that contains their values useless.
bool Viewer::knobs_may_turn() const {
    return controls_open_ || (inputs_ && settings_.inputs->turns_knobs()) ||
           (replay_ && turns_knobs(replay_->script()));
}

/// Returns the scene on show with the current values of its knobs.
scene::Scene Viewer::turned_scene() const {
    scene::Scene scene = stage_->renderer().scene();
    for (scene::Knob& knob : scene.knobs)
        knob.value = value_after(knob, shown_.knobs);
    return scene;
}

// The moment on show as a value: copied as a command, saved with pictures, kept and restored.

Moment Viewer::moment() const {
    if (frozen_)
        return frozen_->moment;
    FrameSequence sequence = settings_.frames;
    if (recording())
        sequence.input_file = settings_.record.string();
    render::FrameState state = shown_;
    state.pass = sequence.state.pass;
    if (!clock_.by_frames())
        sequence.lead_in_fps = sequence.state.fps;
    return moment_of(scene_.request(), sequence, std::move(state));
}

/// Returns the format of a saved picture, with the metadata that reproduces the frame on show.
image::PictureFormat Viewer::format_of_picture() const {
    const scene::Scene& scene = stage_->renderer().scene();
    const auto fingerprint =
        Fingerprint::of_scene(scene, scene_.request().defines, settings_.frames, gl::query_capabilities());
    image::PictureFormat format{image::SampleDepth::u8, metadata_of(scene, moment()), image::Transfer::srgb};
    format.metadata.emplace_back(k_fingerprint, fingerprint.text());
    return format;
}

Viewer::Picture Viewer::read_picture() const {
    Picture picture{shown_.frame, stage_->renderer().read_back(), format_of_picture()};
    count_not_finite(stage_->renderer(), picture.pixels); // removes the marks from alpha
    return picture;
}

/// Returns whether a frame of the current text is on show; prints a line if not.
bool Viewer::has_frame() const {
    if (!has_frame_ && !frozen_)
        say("no frame is drawn yet");
    return has_frame_ || frozen_;
}

void Viewer::save_picture() {
    if (!has_frame_ && !frozen_) {
        save_due_ = true;
        return say("no frame is drawn yet: the first one is saved");
    }
    if (!writer_)
        writer_ = std::make_unique<FrameWriter>(1U);
    Picture picture = frozen_ ? frozen_->picture : read_picture();
    const std::string name = name_after_scene(settings_.scene.path, fmt::format("-{:05}.png", picture.frame));
    if (writer_->push({picture.frame, OutputPath(name).sparing(files_read(stage_->renderer().scene())),
                       std::move(picture.pixels), std::move(picture.format)}))
        say(fmt::format("saving {}", name));
    else if (auto written = std::exchange(writer_, nullptr)->finish(); !written)
        say(to_string(written.error()));
}

/// Copies the capture command. Leaves out the rate of the window's clock, and the date unless the user gave
/// one.
void Viewer::copy_moment() {
    if (!has_frame())
        return;
    Moment copied = moment();
    render::FrameState& state = copied.sequence.state;
    state.fps = settings_.frames.state.fps;
    state.date = settings_.frames.state.date;
    const std::string command = capture_command(copied);
    screen_->set_clipboard(command);
    say("copied: " + command);
}

void Viewer::keep_moment() {
    if (!has_frame())
        return;
    views_.push_back(moment());
    stale_overlay_ = true;
    say("kept: " + view_labels(views_).back());
}

/// Goes to a kept view as the time bar does; its definitions are compiled first.
void Viewer::carry_out(const live::GoToView& command) {
    if (command.index >= views_.size())
        return;
    if (replay_)
        return say("kept views are off during a replay");
    const Moment& kept = views_[command.index];
    const render::FrameState& state = kept.sequence.state;
    controls_.adopt(state);
    controls_.stretch(state.extent, drawn_extent());
    if (stage_)
        release_knobs();
    shown_.knobs.clear();
    controls_.fill(shown_);
    const double now = now_seconds();
    touched_at_ = now;
    stale_ = true;
    if (kept.scene.defines == scene_.request().defines)
        return seek(state.seconds(), now);
    going_to_ = state.seconds();
    scene_.hold(kept.scene.defines, view());
}

void Viewer::carry_out(const live::ForgetView& command) {
    if (command.index < views_.size())
        views_.erase(views_.begin() + std::ptrdiff_t(command.index));
    stale_overlay_ = true;
}

/// Restores the state of the last window.
void Viewer::take_up(const Remembered& left) {
    views_ = left.views;
    controls_open_ = left.controls_open;
    controllers_ = live::ControllerMap(left.controllers);
    if (!left.moment)
        return;
    render::FrameState state = left.moment->sequence.state;
    state.mouse = {};
    controls_.adopt(state);
    going_to_ = state.seconds();
    say(fmt::format("restored: {}; --fresh starts anew", words_of(left)));
}

std::optional<Remembered> Viewer::state() const {
    if (!stage_)
        return settings_.left;
    return Remembered{moment(), screen_->place(), scale_, controls_open_, views_, controllers_.bindings()};
}

/// Saves the state for the next window of the scene.
void Viewer::leave() const {
    if (settings_.remembers && stage_)
        remember(settings_.scene.path, *state());
}

// The window's title: its state, or the reason why it waits.

namespace {

/// Compiling is not mentioned before this time.
constexpr double k_short_wait_seconds = 0.3;
/// Returns the first error, on one line.
std::string headline(const Error& error) {
    for (const Diagnostic& diagnostic : error.diagnostics)
        if (diagnostic.severity == Severity::error)
            return to_string(diagnostic);
    return error.message;
}

} // namespace

bool Viewer::compiles_for_long(double now) const {
    const auto since = scene_.building_since();
    return since && now - *since > k_short_wait_seconds;
}

/// Sets the title: the compile time while compiling, else the error if there is one, else the state with the
/// frame rate, which changes twice a second at most.
void Viewer::show_title(double now) {
    std::string state = stepping_ ? fmt::format("stepping to frame {}, Esc cancels", stepping_->where().last)
                        : given_up_       ? "cancelled, space continues"
                        : clock_.paused() ? fmt::format("paused at {:.3f} s", shown_.seconds())
                        : at_rest_        ? "still"
                                          : fmt::format("{:.0f} fps", clock_.frame_rate());
    if (const std::string words = drawing_words(now); !words.empty())
        state = words;
    if (scale_ != render::RenderScale())
        state += fmt::format(", scale {}", scale_.name());
    if (frozen_)
        state += ", frozen";
    if (finite_.found() > 0)
        state += fmt::format(", {} pixel{} not finite", finite_.found(), finite_.found() > 1 ? "s" : "");
    if (compiles_for_long(now))
        state = fmt::format("compiling… {:.0f} s{}", now - *scene_.building_since(),
                            stage_ ? ", Esc cancels" : "");
    else if (!stage_ && !scene_.failure())
        return;
    std::string title = scene_.failure() && !compiles_for_long(now)
                            ? (stage_ ? "" : "waiting: ") + headline(*scene_.failure())
                            : fmt::format("{} - tidemark - {}", scene_.name(), state);
    if (title == title_)
        return;
    title_ = std::move(title);
    screen_->set_title(title_);
}

} // namespace tidemark::cli
