// The moment on show as a value: copied as a command, saved with pictures, kept and restored.
#include "cli/console.hpp"
#include "cli/fingerprint.hpp"
#include "cli/not_finite.hpp"
#include "cli/output_name.hpp"
#include "cli/picture_facts.hpp"
#include "cli/view/overlay_fields.hpp"
#include "cli/view/viewer.hpp"

#include <fmt/format.h>

namespace tidemark::cli {

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
        return say("a recording moves the scene: it stays there");
    const Moment& kept = views_[command.index];
    const render::FrameState& state = kept.sequence.state;
    controls_.adopt(state);
    controls_.stretch(state.extent, drawn_extent());
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
    say(fmt::format("as you left it: {}; --fresh starts anew", words_of(left)));
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

} // namespace tidemark::cli
