#include "window/picture_view.hpp"

#include "base/error.hpp"
#include "host/console.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace tidemark::window {

using namespace host;
namespace {

constexpr int k_smallest = -3;
constexpr int k_largest = 1;

/// The median of five frames ignores two slow ones.
constexpr size_t k_frames_down = 5;
constexpr size_t k_frames_up = 30;
/// Fractions of the budget. Between the two the scale stays: frames that take the whole budget occasionally
/// measure up to a tenth more or a fifth less.
constexpr double k_too_slow = 1.1;
constexpr double k_fast_enough = 0.8;

double median_of_last(const std::deque<double>& values, size_t count) {
    std::vector<double> last(values.end() - std::ptrdiff_t(count), values.end());
    const auto middle = last.begin() + std::ptrdiff_t(count / 2);
    std::ranges::nth_element(last, middle);
    return *middle;
}

/// Pixels along a side of a cube's face in a thumbnail, and the most in a large picture.
constexpr int k_small_face = 64;
constexpr int k_large_face = 512;

/// Returns the side of a cube's face for the window, which shows four by three. More pixels cost time and
/// cannot be seen.
int face_in(Extent window) {
    return std::clamp(std::min(window.width / 4, window.height / 3), 1, k_large_face);
}

struct Source {
    std::string name;
    const gl::Texture* texture;
    std::optional<size_t> pass{}; ///< the pass that draws it
};

std::vector<Source> sources_of(const render::Renderer& renderer) {
    std::vector<Source> sources;
    const std::vector<scene::Pass>& passes = renderer.scene().passes;
    for (const render::PlannedPass& planned : renderer.plan().passes)
        sources.push_back(
            {passes[planned.pass].name, &renderer.target_of(planned.pass).texture, planned.pass});
    for (const render::PlannedPass& planned : renderer.plan().passes)
        for (const int channel : planned.channels) {
            const scene::Pass& pass = passes[planned.pass];
            const gl::Texture* texture = renderer.texture_at(planned.pass, channel);
            if (texture && !source_pass(pass.channels[size_t(channel)].input))
                sources.push_back({fmt::format("{} iChannel{}", pass.name, channel), texture});
        }
    return sources;
}

std::string size_of(const gl::Texture& texture) {
    const std::string size = fmt::format("{}x{}", texture.extent.width, texture.extent.height);
    return texture.target == GL_TEXTURE_CUBE_MAP ? "6 of " + size
           : texture.target == GL_TEXTURE_3D     ? fmt::format("{}x{}", size, texture.depth)
                                                 : size;
}

render::Look look_of(const overlay::LookField& field) {
    const overlay::ChannelChoice& choice = overlay::k_channel_choices[field.channels];
    return {choice.channel, choice.less, field.automatic ? 0 : field.stops, field.automatic};
}

constexpr Extent k_cells{15, 9};

/// Fills the cells with `part`, as far as it lies within the texture.
void show_cells(const gl::Texture& texture, const Rectangle& part, overlay::MagnifierField& field) {
    const Rectangle known = part.within({0, 0, texture.extent});
    const std::vector<float> values = gl::read_part(texture, 0, known);
    field.cells = part.extent;
    field.colours.assign(part.extent.pixels(), std::nullopt);
    for (int row = 0; row < known.extent.height; ++row)
        for (int column = 0; column < known.extent.width; ++column) {
            const size_t cell = size_t(known.y - part.y + row) * size_t(part.extent.width) +
                                size_t(known.x - part.x + column);
            const size_t texel = size_t(row) * size_t(known.extent.width) + size_t(column);
            field.colours[cell] = overlay::colour_of(&values[4 * texel]);
        }
}

overlay::PixelValue value_at(const scene::Pass& pass, const gl::Texture& texture, const Rectangle& pixel) {
    overlay::PixelValue value{pass.name, gl::read_part(texture, 0, pixel)};
    if (pass.kind == scene::PassKind::image)
        value.channels.pop_back();
    return value;
}

} // namespace

gl::Texture texture_of(const image::Image& picture) {
    gl::Texture texture = gl::make_texture(picture.extent, GL_RGBA8, 1);
    gl::upload(texture, 0, picture.channels == 3 ? GL_RGB : GL_RGBA, GL_UNSIGNED_BYTE, picture.bytes);
    return texture;
}

std::vector<RenderScale> RenderScale::all() {
    std::vector<RenderScale> scales;
    for (int exponent = k_smallest; exponent <= k_largest; ++exponent)
        scales.push_back(RenderScale(exponent));
    return scales;
}

std::optional<RenderScale> RenderScale::named(std::string_view name) {
    const std::vector<RenderScale> scales = all();
    const auto found = std::ranges::find(scales, name, &RenderScale::name);
    return found == scales.end() ? std::nullopt : std::optional(*found);
}

std::string RenderScale::name() const {
    return exponent_ < 0 ? fmt::format("1/{}", 1 << -exponent_) : fmt::format("{}", 1 << exponent_);
}

Extent RenderScale::drawn(Extent window) const {
    const auto scaled = [this](int length) {
        return std::max(1, int(std::lround(std::ldexp(double(length), exponent_))));
    };
    return {scaled(window.width), scaled(window.height)};
}

RenderScale RenderScale::stepped(int steps) const {
    return RenderScale(std::clamp(exponent_ + steps, k_smallest, k_largest));
}

RenderScale AdaptiveScale::after_frame(RenderScale scale, double milliseconds) {
    recent_.push_back(milliseconds);
    if (recent_.size() > k_frames_up)
        recent_.pop_front();
    auto wanted = lower(scale);
    if (wanted && before_step_up_) // a step that is undone shows its cost
        growth_ = std::max(growth_, median_of_last(recent_, k_frames_down) / *before_step_up_);
    if (wanted || recent_.size() == k_frames_up)
        before_step_up_.reset();
    if (!wanted)
        wanted = higher(scale);
    if (!wanted)
        return scale;
    recent_.clear();
    return *wanted;
}

void AdaptiveScale::forget() {
    recent_.clear();
    before_step_up_.reset();
    growth_ = k_pixels;
}

/// Returns the next scale whose frames may be quick enough. The time falls at most in proportion to the
/// pixels, so the scale is not lower than necessary.
std::optional<RenderScale> AdaptiveScale::lower(RenderScale scale) const {
    if (recent_.size() < k_frames_down)
        return std::nullopt;
    double expected = median_of_last(recent_, k_frames_down);
    if (expected <= k_too_slow * budget_)
        return std::nullopt;
    RenderScale wanted = scale;
    while (expected > budget_ && wanted.stepped(-1) != wanted) {
        wanted = wanted.stepped(-1);
        expected /= k_pixels;
    }
    return wanted == scale ? std::nullopt : std::optional(wanted);
}

std::optional<RenderScale> AdaptiveScale::higher(RenderScale scale) {
    if (recent_.size() < k_frames_up || scale.stepped(1) == scale)
        return std::nullopt;
    const double now = median_of_last(recent_, k_frames_up);
    if (now * growth_ > k_fast_enough * budget_)
        return std::nullopt;
    before_step_up_ = now;
    return scale.stepped(1);
}

/// Returns the flat view of a texture; null where it cannot be shown.
const gl::Texture* PassPictures::flat(const gl::Texture& picture, int face, std::optional<int> slice) {
    auto view = flat_.find(picture.id());
    if (view == flat_.end()) {
        auto made = render::FlatView::create(picture);
        if (!made) {
            say(to_string(made.error()));
            return nullptr;
        }
        view = flat_.emplace(picture.id(), *std::move(made)).first;
    }
    return view->second.draw(picture, slice.value_or(picture.depth / 2), face);
}

const gl::Texture& PassPictures::looked_at(const gl::Texture& picture, overlay::LookField& look) {
    const render::Look wanted = look_of(look);
    if (wanted.is_plain())
        return picture;
    if (!look_) {
        auto made = render::PictureLook::create();
        if (!made) {
            say(to_string(made.error()));
            look = {.slice = look.slice};
            return picture;
        }
        look_ = *std::move(made);
    }
    const gl::Texture* drawn = look_->draw(picture, wanted);
    look.stops = look_->stops();
    return drawn ? *drawn : picture;
}

std::vector<overlay::PictureField> PassPictures::fields(const render::Renderer& renderer,
                                                        const PassCosts& costs, Large& large,
                                                        render::ShownFloats& floats,
                                                        const render::FrameInputs& inputs) {
    std::vector<overlay::PictureField> fields;
    for (const Source& source : sources_of(renderer)) {
        const bool is_large = large.index == fields.size();
        const gl::Texture* picture = source.texture;
        overlay::PictureField field{.name = source.name, .extent = {}, .size = size_of(*picture)};
        if (source.pass)
            field.milliseconds = costs.of(*source.pass);
        if (picture->target == GL_TEXTURE_3D)
            field.slices = picture->depth;
        if (render::FlatView::is_needed(*picture))
            picture = flat(*picture, is_large ? face_in(large.window) : k_small_face, large.look.slice);
        else if (is_large && source.pass == renderer.shown_index() && !look_of(large.look).is_plain())
            picture = &floats.draw(renderer, inputs, {0, 0, picture->extent});
        if (is_large && picture)
            picture = &looked_at(*picture, large.look);
        if (picture) {
            field.texture = picture->id();
            field.extent = picture->extent;
        }
        fields.push_back(std::move(field));
    }
    return fields;
}

bool Magnifier::follow(const host::InputEvent& event) {
    const auto* moved = std::get_if<host::PointerMoved>(&event);
    if (moved)
        pointer_ = moved->at;
    return moved && open_;
}

Rectangle Magnifier::pixel(Extent picture, Extent window) const {
    const auto at = [](double place, int pixels, int length) {
        return int(std::floor(place * pixels / std::max(length, 1)));
    };
    return {
        at(pointer_.x, picture.width, window.width), at(pointer_.y, picture.height, window.height), {1, 1}};
}

std::optional<overlay::MagnifierField> Magnifier::field(const render::Renderer& renderer,
                                                        const render::FrameInputs& inputs, Extent window,
                                                        render::ShownFloats& floats) const {
    const Extent picture = renderer.target().extent();
    const Rectangle under = pixel(picture, window);
    if (!open_ || !Rectangle{0, 0, picture}.contains(under.x, under.y))
        return std::nullopt;
    const Rectangle part{under.x - k_cells.width / 2, under.y - k_cells.height / 2, k_cells};
    const gl::Texture& shown = floats.draw(renderer, inputs, part);
    overlay::MagnifierField field{.pointer = pointer_, .x = under.x, .y = under.y};
    show_cells(shown, part, field);
    field.values.push_back(value_at(renderer.shown_pass(), shown, under));
    for (const render::PlannedPass& planned : renderer.plan().passes) {
        const scene::Pass& pass = renderer.scene().passes[planned.pass];
        const gl::Texture& texture = renderer.target_of(planned.pass).texture;
        if (planned.pass != renderer.shown_index() && texture.target == GL_TEXTURE_2D)
            field.values.push_back(value_at(pass, texture, under));
    }
    return field;
}

ControlEvent PictureView::in_picture(const ControlEvent& event, Extent window) const {
    const Extent picture = drawn(window);
    return std::visit(
        [&](auto happened) -> ControlEvent {
            if constexpr (requires { happened.at; }) {
                happened.at.x *= double(picture.width) / std::max(window.width, 1);
                happened.at.y *= double(picture.height) / std::max(window.height, 1);
            }
            return happened;
        },
        event);
}

void PictureView::adapt_to(std::optional<double> fps) {
    adaptive_.reset();
    if (fps)
        adaptive_.emplace(*fps);
}

RenderScale PictureView::scale_after(double milliseconds) {
    return adaptive_ ? adaptive_->after_frame(scale_, milliseconds) : scale_;
}

void PictureView::forget_times() {
    if (adaptive_)
        adaptive_->forget();
}

void PictureView::toggle_marks() {
    marks_shown_ = !marks_shown_;
    forget_objects();
}

const gl::Texture* PictureView::marked(const render::Renderer& renderer, const render::FrameInputs& inputs) {
    if (renderer.target().texture.target != GL_TEXTURE_2D)
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
    return &floats().draw(renderer, inputs, {0, 0, renderer.target().extent()});
}

void PictureView::toggle_magnifier() {
    magnifier_.toggle();
    forget_objects();
}

void PictureView::choose(int number) {
    const auto index = number > 0 ? std::optional(size_t(number) - 1) : std::nullopt;
    large_ = large_ == index ? std::nullopt : index;
}

void PictureView::add_pictures(overlay::Model& model, const render::Renderer& renderer,
                               const PassCosts& costs, const render::FrameInputs& inputs, Extent window) {
    if (!pictures_)
        pictures_.emplace();
    PassPictures::Large large{large_, look_, window};
    model.pictures = pictures_->fields(renderer, costs, large, floats(), inputs);
    if (large_ && *large_ < model.pictures.size())
        model.large = large_;
    model.look = large.look;
}

void PictureView::add_thumbnails(overlay::Model& model,
                                 const std::shared_ptr<const std::vector<Preset>>& views) {
    if (std::exchange(thumbnails_of_, views) != views) {
        thumbnails_.clear();
        for (const Preset& view : *views) {
            thumbnails_.emplace_back();
            if (view.picture.extent.pixels() > 0)
                thumbnails_.back() = texture_of(view.picture);
        }
    }
    for (size_t i = 0; i < std::min(model.views.size(), thumbnails_.size()); ++i)
        if (thumbnails_[i]) {
            model.views[i].texture = thumbnails_[i]->id();
            model.views[i].extent = thumbnails_[i]->extent;
        }
}

std::optional<overlay::LensField> PictureView::legend(Extent window) const {
    const Extent extent = lens_.extent();
    if (extent.pixels() == 0)
        return lens_.field(std::nullopt);
    const Rectangle pixel = magnifier_.pixel(extent, window);
    const bool inside = pixel.x >= 0 && pixel.y >= 0 && pixel.x < extent.width && pixel.y < extent.height;
    return lens_.field(inside ? std::optional(std::array{pixel.x, pixel.y}) : std::nullopt);
}

void PictureView::leave_context() {
    forget_objects();
    lens_.leave_context();
    if (frozen_)
        frozen_->target.framebuffer = {}; // its texture is shared with the next context
}

void PictureView::enter_context() {
    if (frozen_)
        frozen_->target = gl::attach(std::move(frozen_->target.texture));
}

render::ShownFloats& PictureView::floats() {
    if (!floats_)
        floats_.emplace();
    return *floats_;
}

void PictureView::forget_objects() {
    pictures_.reset();
    floats_.reset();
    marks_.reset();
    thumbnails_of_.reset();
    thumbnails_.clear();
}

} // namespace tidemark::window
