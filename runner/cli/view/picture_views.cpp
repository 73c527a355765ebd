#include "cli/view/picture_views.hpp"

#include "cli/console.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tidemark::cli {
namespace {

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

render::Look look_of(const live::LookField& field) {
    const live::ChannelChoice& choice = live::k_channel_choices[field.channels];
    return {choice.channel, choice.less, field.automatic ? 0 : field.stops, field.automatic};
}

} // namespace

/// Returns the flat view of a texture; null where it cannot be shown.
const gl::Texture* PictureViews::flat(const gl::Texture& picture, int face, std::optional<int> slice) {
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

const gl::Texture& PictureViews::looked_at(const gl::Texture& picture, live::LookField& look) {
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

std::vector<live::PictureField> PictureViews::fields(const render::Renderer& renderer, const PassCosts& costs,
                                                     Large& large, render::ShownFloats& floats,
                                                     const render::FrameInputs& inputs) {
    std::vector<live::PictureField> fields;
    for (const Source& source : sources_of(renderer)) {
        const bool is_large = large.index == fields.size();
        const gl::Texture* picture = source.texture;
        live::PictureField field{.name = source.name, .extent = {}, .size = size_of(*picture)};
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

} // namespace tidemark::cli
