#include "lab/march/pass_textures.hpp"

#include <fmt/format.h>

namespace tidemark::lab {
namespace {

using ir::Texels;

/// Limit for the base level. A texture of 4096 x 4096 exceeds it.
constexpr size_t k_most_texels = 8'000'000;

Texels::Kind kind_of(const gl::Texture& texture) {
    switch (texture.target) {
    case GL_TEXTURE_3D: return Texels::Kind::volume;
    case GL_TEXTURE_CUBE_MAP: return Texels::Kind::cube;
    default: return Texels::Kind::plane;
    }
}

Texels texels_of(const gl::Texture& texture, const scene::Sampling& sampling) {
    Texels texels;
    texels.kind = kind_of(texture);
    texels.wrap = Texels::Wrap(sampling.wrap);
    texels.mipmaps = Texels::Mipmaps(sampling.mipmaps);
    texels.magnify_linear = sampling.magnify == scene::Filter::linear;
    texels.minify_linear = sampling.minify == scene::Filter::linear;
    const int levels = sampling.mipmaps == scene::Mipmaps::none ? 1 : texture.levels;
    for (int level = 0; level < levels; ++level) {
        const auto [width, height, layers] = gl::level_size(texture, level);
        texels.levels.push_back({{width, height, layers}, gl::read_level(texture, level)});
    }
    return texels;
}

std::shared_ptr<const Texels> black() {
    Texels texels;
    texels.levels.push_back({{1, 1, 1}, {0, 0, 0, 1}});
    return std::make_shared<const Texels>(std::move(texels));
}

} // namespace

ir::TextureSet textures_of(const render::Renderer& renderer, size_t pass) {
    ir::TextureSet textures;
    const scene::Channels& channels = renderer.scene().passes[pass].channels;
    for (int unit = 0; unit < scene::k_channel_count; ++unit) {
        const scene::Channel& channel = channels[size_t(unit)];
        const std::string sampler = fmt::format("iChannel{}", unit);
        const size_t* source = scene::source_pass(channel.input);
        const bool gone = source && render::frame_ref(pass, *source) == render::FrameRef::previous;
        const gl::Texture* texture = renderer.texture_at(pass, unit);
        if (!texture) { // the linked program does not read it, so its value in the text does not matter
            textures.emplace(sampler, black());
            continue;
        }
        if (gone || texture->extent.pixels() * size_t(texture->depth) > k_most_texels)
            continue;
        textures.emplace(sampler, std::make_shared<const Texels>(texels_of(*texture, channel.sampling)));
    }
    return textures;
}

} // namespace tidemark::lab
