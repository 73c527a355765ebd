#include "cli/view/magnifier.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::cli {
namespace {

constexpr Extent k_cells{15, 9};

/// Fills the cells with `part`, as far as it lies within the texture.
void show_cells(const gl::Texture& texture, const Rectangle& part, live::MagnifierField& field) {
    const Rectangle known = part.within({0, 0, texture.extent});
    const std::vector<float> values = gl::read_part(texture, 0, known);
    field.cells = part.extent;
    field.colours.assign(part.extent.pixels(), std::nullopt);
    for (int row = 0; row < known.extent.height; ++row)
        for (int column = 0; column < known.extent.width; ++column) {
            const size_t cell = size_t(known.y - part.y + row) * size_t(part.extent.width) +
                                size_t(known.x - part.x + column);
            const size_t texel = size_t(row) * size_t(known.extent.width) + size_t(column);
            field.colours[cell] = live::colour_of(&values[4 * texel]);
        }
}

live::PixelValue value_at(const scene::Pass& pass, const gl::Texture& texture, const Rectangle& pixel) {
    live::PixelValue value{pass.name, gl::read_part(texture, 0, pixel)};
    if (pass.kind == scene::PassKind::image)
        value.channels.pop_back();
    return value;
}

} // namespace

bool Magnifier::follow(const platform::InputEvent& event) {
    const auto* moved = std::get_if<platform::PointerMoved>(&event);
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

std::optional<live::MagnifierField> Magnifier::field(const render::Renderer& renderer,
                                                     const render::FrameInputs& inputs, Extent window,
                                                     render::ShownFloats& floats) const {
    const Extent picture = renderer.target().extent();
    const Rectangle under = pixel(picture, window);
    if (!open_ || !Rectangle{0, 0, picture}.contains(under.x, under.y))
        return std::nullopt;
    const Rectangle part{under.x - k_cells.width / 2, under.y - k_cells.height / 2, k_cells};
    const gl::Texture& shown = floats.draw(renderer, inputs, part);
    live::MagnifierField field{.pointer = pointer_, .x = under.x, .y = under.y};
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

} // namespace tidemark::cli
