// The moment on show, as a value: copied as a command, saved with pictures, kept and gone back to.
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

/// Of the frame on show, with all that draws it again.
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
    count_not_finite(stage_->renderer(), picture.pixels); // its marks are no alpha
    return picture;
}

/// Of the text as it is: else there is no moment.
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

/// The rate of the window's own clock is nobody's wish, and the date is left to the capture unless somebody
/// gave one.
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

/// As the bar of time goes to a moment; definitions are compiled first.
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

/// As the last window of the scene was left.
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

/// For the next window of the scene.
void Viewer::leave() const {
    if (settings_.remembers && stage_)
        remember(settings_.scene.path, *state());
}

} // namespace tidemark::cli
