#include "render/channel_textures.hpp"

#include "gl/capabilities.hpp"
#include "image/noise.hpp"
#include "image/picture_file.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::render {
namespace {

using image::Image;
using image::SampleType;

struct TextureFormat {
    GLenum internal;
    GLenum external;
};

TextureFormat format_of(const Image& image) {
    constexpr GLenum k_external[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
    constexpr GLenum k_bytes[] = {GL_R8, GL_RG8, GL_RGB8, GL_RGBA8};
    constexpr GLenum k_floats[] = {GL_R32F, GL_RG32F, GL_RGB32F, GL_RGBA32F};
    const auto channels = size_t(image.channels - 1);
    return {image.type == SampleType::u8 ? k_bytes[channels] : k_floats[channels], k_external[channels]};
}

/// A browser hands a grey picture to WebGL as red = green = blue.
void spread_grey(const gl::Texture& texture, int channels) {
    if (channels > 2)
        return;
    const GLint swizzle[] = {GL_RED, GL_RED, GL_RED, channels == 2 ? GL_GREEN : GL_ONE};
    glTextureParameteriv(texture.id(), GL_TEXTURE_SWIZZLE_RGBA, swizzle);
}

gl::Texture make_texture(const Image& image, bool mipmaps) {
    const TextureFormat format = format_of(image);
    gl::Texture texture = gl::make_texture(image.extent, format.internal, mipmaps ? 0 : 1);
    gl::upload(texture, format.external, image.type == SampleType::u8 ? GL_UNSIGNED_BYTE : GL_FLOAT,
               image.bytes);
    spread_grey(texture, image.channels);
    return texture;
}

Image black() {
    Image opaque({1, 1}, 4, SampleType::u8);
    opaque.u8()[3] = 255;
    return opaque;
}

Result<Image> load_image(const scene::Channel& channel) {
    if (std::holds_alternative<scene::Noise>(channel.input))
        return image::make_noise();
    const auto* picture = std::get_if<scene::Picture>(&channel.input);
    if (!picture)
        return black();
    auto loaded = image::read_picture(picture->file);
    if (!loaded && !channel.where.file.empty()) // say which directive asked for it
        return fail(error_at(channel.where, loaded.error().message));
    if (loaded) {
        const int limit = gl::query_capabilities().largest_target;
        if (std::max(loaded->extent.width, loaded->extent.height) > limit)
            return fail(ErrorCode::load,
                        fmt::format("'{}' is {}x{} pixels: this driver takes at most {} on a side",
                                    picture->file.string(), loaded->extent.width, loaded->extent.height,
                                    limit));
    }
    return loaded;
}

} // namespace

Result<size_t> ChannelTextures::require(const scene::Channel& channel) {
    const bool mipmaps = channel.sampling.mipmaps != scene::Mipmaps::none;
    const auto known = std::find_if(textures_.begin(), textures_.end(), [&](const Entry& entry) {
        return entry.input == channel.input && entry.vflip == channel.sampling.vflip &&
               entry.mipmaps == mipmaps;
    });
    if (known != textures_.end())
        return size_t(known - textures_.begin());
    auto image = load_image(channel);
    if (!image)
        return fail(std::move(image.error()));
    if (!channel.sampling.vflip)
        *image = image::flipped(*image);
    textures_.push_back({channel.input, channel.sampling.vflip, mipmaps, make_texture(*image, mipmaps)});
    return textures_.size() - 1;
}

Result<Extent> ChannelTextures::size_of(const scene::Channel& channel) {
    if (std::holds_alternative<scene::Picture>(channel.input))
        return require(channel).map([&](size_t index) { return textures_[index].texture.extent; });
    const bool asked_for = !channel.where.file.empty();
    if (std::holds_alternative<scene::Noise>(channel.input) && asked_for)
        return Extent{image::k_noise_side, image::k_noise_side};
    return Extent{};
}

gl::SamplerHandle make_sampler(const scene::Sampling& sampling) {
    using scene::Filter;
    using scene::Mipmaps;
    constexpr GLenum k_minify[2][3] = {
        {GL_NEAREST, GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST_MIPMAP_LINEAR},
        {GL_LINEAR, GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR_MIPMAP_LINEAR},
    };
    constexpr GLenum k_wrap[] = {GL_REPEAT, GL_CLAMP_TO_EDGE, GL_MIRRORED_REPEAT};
    return gl::make_sampler(k_minify[size_t(sampling.minify)][size_t(sampling.mipmaps)],
                            sampling.magnify == Filter::linear ? GL_LINEAR : GL_NEAREST,
                            k_wrap[size_t(sampling.wrap)]);
}

} // namespace tidemark::render
