// Inspecting the picture: the pictures of passes and inputs, the magnifier, marks of pixels that are not
// finite or below zero, and the origin of such pixels.
#include "cli/console.hpp"
#include "cli/not_finite.hpp"
#include "cli/view/viewer.hpp"

#include <fmt/format.h>

namespace tidemark::cli {

void Viewer::toggle_magnifier() {
    magnifier_.toggle();
    forget_looking();
    stale_overlay_ = true;
}

void Viewer::toggle_marks() {
    marks_shown_ = !marks_shown_;
    if (marks_shown_ && drawing_would_hold())
        say("marks rest while a frame takes more than a second");
    forget_looking();
    stale_overlay_ = true;
}

render::ShownFloats& Viewer::floats() {
    if (!floats_)
        floats_.emplace();
    return *floats_;
}

std::optional<live::MagnifierField> Viewer::magnifier_field() {
    if (!magnifier_.is_open() || !stage_ || stepping_ || frozen_)
        return std::nullopt;
    return magnifier_.field(stage_->renderer(), inputs_on_show(), screen_->extent(), floats());
}

/// Returns the texture that the marks are drawn from, after drawing Image once more as a whole; null: no
/// marks.
const gl::Texture* Viewer::marked_picture() {
    if (!marks_shown_ || !stage_ || stepping_ || frozen_ || making_ || drawing_would_hold() ||
        stage_->renderer().target().texture.target != GL_TEXTURE_2D)
        return nullptr;
    if (!marks_) {
        auto made = render::NumberMarks::create();
        if (!made) {
            marks_shown_ = false;
            say(to_string(made.error()));
            return nullptr;
        }
        marks_.emplace(*std::move(made));
    }
    const render::Renderer& renderer = stage_->renderer();
    return &floats().draw(renderer, inputs_on_show(), {0, 0, renderer.target().extent()});
}

void Viewer::look_at_pictures(live::Model& model) {
    if (!pictures_)
        pictures_.emplace();
    PictureViews::Large large{large_, look_, screen_->extent()};
    model.pictures = pictures_->fields(stage_->renderer(), costs_, large, floats(), inputs_on_show());
    if (large_ && *large_ < model.pictures.size())
        model.large = large_;
    model.look = large.look;
}

/// Deletes objects that live in the Stage's context.
void Viewer::forget_looking() {
    pictures_.reset();
    floats_.reset();
    marks_.reset();
}

/// Traces the NaN of the magnified pixel; a second press hides the result.
void Viewer::trace_pixel() {
    if (!magnifier_.is_open() || !stage_ || frozen_)
        return;
    if (origin_.show(nullptr) || search_) {
        search_.reset();
        stale_overlay_ = true;
        return;
    }
    const Rectangle pixel = magnifier_.pixel(stage_->renderer().target().extent(), screen_->extent());
    std::vector<std::string> words = trace_words();
    words.insert(words.end(), {"--pixel", fmt::format("{},{}", pixel.x, pixel.y), "--json"});
    auto started = OriginSearch::start(words, [&on = *screen_] { on.wake(); });
    if (!started)
        return say(to_string(started.error()));
    search_ = *std::move(started);
    say(fmt::format("tracing pixel {},{}: Enter gives up", pixel.x, pixel.y));
}

void Viewer::take_origin() {
    const auto printed = search_ ? search_->take() : std::nullopt;
    if (!printed)
        return;
    search_.reset();
    const Error error = origin_of(*printed);
    stale_overlay_ |= origin_.show(&error);
    say(to_string(error));
}

} // namespace tidemark::cli
