#include "render/channel_textures.hpp"

#include "media/generated_textures.hpp"
#include "media/picture_file.hpp"
#include "media/sound_file.hpp"
#include "media/texture_files.hpp"
#include "media/video_input.hpp"
#include "render/gl_context.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>
#include <string>

namespace tidemark::render {
namespace {

using image::Image;
using image::SampleType;

struct TextureFormat {
    GLenum internal;
    GLenum external;
    GLenum type;
};

TextureFormat format_of(SampleType type, int channels) {
    constexpr GLenum k_external[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
    constexpr GLenum k_bytes[] = {GL_R8, GL_RG8, GL_RGB8, GL_RGBA8};
    constexpr GLenum k_floats[] = {GL_R32F, GL_RG32F, GL_RGB32F, GL_RGBA32F};
    const auto index = size_t(channels - 1);
    return {type == SampleType::u8 ? k_bytes[index] : k_floats[index], k_external[index],
            GLenum(type == SampleType::u8 ? GL_UNSIGNED_BYTE : GL_FLOAT)};
}

/// Repeats grey as red, green and blue, as a browser does when it passes a grey picture to WebGL.
void spread_grey(const gl::Texture& texture, int channels) {
    if (channels > 2)
        return;
    gl::set_swizzle(texture, {GL_RED, GL_RED, GL_RED, channels == 2 ? GL_GREEN : GL_ONE});
}

/// iChannelTime of the site's silent input at iTime 0, in seconds.
constexpr double k_silence_starts = 10;

/// Returns the signal of an input without a sound file: the microphone, else silence.
sound::SignalBytes heard(const FrameInputs& inputs) {
    return inputs.live && inputs.live->microphone ? *inputs.live->microphone
                                                  : sound::silent_signal(inputs.time);
}

/// A texture that `Loader` has made for an input.
struct Loaded {
    gl::Texture texture;
    TextureUpdate update{};
    std::optional<Playback> playback{};
};

/// Fills a texture of one channel with `bytes`, unless they are those of the last call.
class ByteUpload {
public:
    bool operator()(const gl::Texture& texture, std::span<const std::byte> bytes) {
        if (std::ranges::equal(bytes, last_))
            return false;
        gl::upload(texture, 0, GL_RED, GL_UNSIGNED_BYTE, bytes);
        last_.assign(bytes.begin(), bytes.end());
        return true;
    }

private:
    std::vector<std::byte> last_; ///< empty before the first call
};

/// Makes the texture of each kind of input; one object per channel.
class Loader {
public:
    explicit Loader(const scene::Sampling& sampling)
        : sampling_(sampling), levels_(sampling.mipmaps == scene::Mipmaps::none ? 1 : 0) {}

    /// A missing texture is (0,0,0,1), as in WebGL.
    Result<Loaded> operator()(const scene::Unbound&) const {
        Image black({1, 1}, 4, SampleType::u8);
        black.u8()[3] = 255;
        return flat(std::move(black));
    }

    Result<Loaded> operator()(const scene::PassOutput&) const {
        assert(false && "the renderer owns the pictures of passes");
        return flat(Image({1, 1}, 4, SampleType::u8));
    }

    Result<Loaded> operator()(const scene::Picture& picture) const {
        auto image = TRY(image::read_picture(picture.file));
        TRY(check_size(image.extent, picture.file));
        return picture.one_channel ? red_alone(std::move(image)) : flat(std::move(image));
    }

    Result<Loaded> operator()(const scene::Noise& noise) const {
        using scene::NoiseKind;
        switch (noise.kind) {
        case NoiseKind::rgba_256: return flat(image::make_noise(image::NoiseTexture::rgba_256));
        case NoiseKind::rgba_64: return flat(image::make_noise(image::NoiseTexture::rgba_64));
        case NoiseKind::grey_256: return one_channel(image::make_noise(image::NoiseTexture::grey_256));
        case NoiseKind::grey_64: return one_channel(image::make_noise(image::NoiseTexture::grey_64));
        case NoiseKind::blue_1024: return flat(image::make_noise(image::NoiseTexture::blue_1024));
        case NoiseKind::bayer_8: return one_channel(image::make_noise(image::NoiseTexture::bayer_8));
        case NoiseKind::grey_volume_32: return volume(image::make_noise_volume(image::NoiseVolume::grey_32));
        case NoiseKind::rgba_volume_32: return volume(image::make_noise_volume(image::NoiseVolume::rgba_32));
        }
        return flat(image::make_noise());
    }

    Result<Loaded> operator()(const scene::Cubemap& cubemap) const {
        auto faces = TRY(image::read_cubemap(cubemap.files));
        return cube(faces);
    }

    Result<Loaded> operator()(const scene::Volume& input) const {
        auto data = TRY(image::read_volume(input.file));
        return volume(data);
    }

    Result<Loaded> operator()(const scene::StandIn& stand_in) const {
        const std::string name = fmt::format("{}x{}x{}", stand_in.width, stand_in.height, stand_in.channels);
        using Kind = scene::StandIn::Kind;
        if (stand_in.kind == Kind::cubemap)
            return cube(image::make_stand_in_cube(name, stand_in.width, stand_in.channels));
        if (stand_in.kind == Kind::volume)
            return volume(image::make_stand_in_volume(name, stand_in.width, stand_in.height, stand_in.height,
                                                      stand_in.channels));
        Image picture =
            image::make_stand_in_picture(name, {stand_in.width, stand_in.height}, stand_in.channels);
        return stand_in.channels == 1 ? red_alone(std::move(picture)) : flat(std::move(picture));
    }

    Result<Loaded> operator()(const scene::Constant& constant) const {
        using Kind = scene::Constant::Kind;
        const bool single = constant.kind == Kind::texel;
        Image image(single ? Extent{1, 1} : Extent{64, 64}, 4, SampleType::f32);
        const float value = single                         ? 0.5f
                            : constant.kind == Kind::white ? 1.0f
                            : constant.kind == Kind::nan   ? std::numeric_limits<float>::quiet_NaN()
                                                           : 0.0f;
        for (size_t i = 0; i < image.samples(); ++i)
            image.f32()[i] = i % 4 == 3 && constant.kind != Kind::nan ? 1.0f : value;
        return flat(std::move(image));
    }

    Result<Loaded> operator()(const scene::Keyboard& keyboard) const {
        return Loaded{gl::make_texture({256, keyboard.rows}, GL_R8, 1),
                      [upload = ByteUpload()](const gl::Texture& texture, const FrameInputs& inputs) mutable {
                          const auto texels = std::as_bytes(std::span(inputs.keyboard));
                          return upload(texture, texels.first(texture.extent.pixels()));
                      }};
    }

    Result<Loaded> operator()(const scene::Music& music) const {
        std::shared_ptr<sound::Spectrum> spectrum;
        if (!music.file.empty()) {
            const auto sound = sound::read_sound(music.file);
            if (!sound)
                return fail(sound.error());
            spectrum = std::make_shared<sound::Spectrum>(*sound);
        }
        const Playback playback =
            spectrum ? Playback{0, spectrum->duration()} : Playback{k_silence_starts, 0};
        return Loaded{gl::make_texture({sound::k_signal_width, 2}, GL_R8, 1),
                      [spectrum, playback, upload = ByteUpload()](const gl::Texture& texture,
                                                                  const FrameInputs& inputs) mutable {
                          const auto bytes =
                              spectrum ? spectrum->at(playback.time_at(inputs.time)) : heard(inputs);
                          return upload(texture, std::as_bytes(std::span(bytes)));
                      },
                      playback};
    }

    Result<Loaded> operator()(const scene::Video& video) const {
        if (video.file.empty())
            return webcam();
        auto opened = TRY(image::VideoFrames::open(video.file));
        TRY(check_size(opened.extent(), video.file));
        const auto frames = std::make_shared<image::VideoFrames>(std::move(opened));
        return Loaded{gl::make_texture(frames->extent(), GL_RGBA8, levels_),
                      [frames, vflip = sampling_.vflip, shown = std::optional<size_t>()](
                          const gl::Texture& texture, const FrameInputs& inputs) mutable {
                          const size_t index = frames->index_at(inputs.time);
                          if (shown == index)
                              return false;
                          const auto frame = frames->at(inputs.time);
                          if (!frame) // keep the last picture
                              return false;
                          shown = index;
                          const Image image = vflip ? *frame : image::flipped(*frame);
                          gl::upload(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, image.bytes);
                          gl::make_mipmaps(texture);
                          return true;
                      },
                      frames->duration() > 0 ? std::optional(Playback{0, frames->duration()}) : std::nullopt};
    }

private:
    Result<void> check_size(Extent extent, const std::filesystem::path& file) const {
        const int limit = gl::query_capabilities().largest_target;
        if (std::max(extent.width, extent.height) <= limit)
            return {};
        return fail(ErrorCode::load,
                    fmt::format("'{}' is {}x{} pixels: this driver takes at most {} on a side", file.string(),
                                extent.width, extent.height, limit));
    }

    /// Shows a stand-in until the camera delivers a picture.
    Loaded webcam() const {
        Loaded loaded = flat(image::make_stand_in_camera());
        loaded.update = [vflip = sampling_.vflip, shown = std::shared_ptr<const Image>()](
                            const gl::Texture& texture, const FrameInputs& inputs) mutable {
            if (!inputs.live || !inputs.live->webcam || inputs.live->webcam == shown)
                return false;
            shown = inputs.live->webcam;
            gl::upload(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                       vflip ? shown->bytes : image::flipped(*shown).bytes);
            gl::make_mipmaps(texture);
            return true;
        };
        return loaded;
    }

    Loaded one_channel(Image image) const {
        if (!sampling_.vflip)
            image = image::flipped(image);
        const TextureFormat format = format_of(image.type, image.channels);
        gl::Texture texture = gl::make_texture(image.extent, format.internal, levels_);
        gl::upload(texture, 0, format.external, format.type, image.bytes);
        gl::make_mipmaps(texture);
        return {std::move(texture)};
    }

    Loaded red_alone(Image image) const {
        Loaded loaded = one_channel(std::move(image));
        gl::set_swizzle(loaded.texture, {GL_RED, GL_ZERO, GL_ZERO, GL_ONE});
        return loaded;
    }

    Loaded flat(Image image) const {
        const int channels = image.channels;
        Loaded loaded = one_channel(std::move(image));
        spread_grey(loaded.texture, channels);
        return loaded;
    }

    Loaded cube(const image::CubeFaces& from) const {
        const image::CubeFaces faces = sampling_.vflip ? image::vflipped(from) : from;
        const TextureFormat format = format_of(faces[0].type, faces[0].channels);
        gl::Texture texture = gl::make_cube_texture(faces[0].extent.width, format.internal, levels_);
        for (int face = 0; face < 6; ++face)
            gl::upload(texture, face, format.external, format.type, faces[size_t(face)].bytes);
        gl::make_mipmaps(texture);
        spread_grey(texture, faces[0].channels);
        return {std::move(texture)};
    }

    Loaded volume(const image::VolumeData& data) const {
        const TextureFormat format = format_of(data.type, data.channels);
        gl::Texture texture =
            gl::make_volume_texture({data.width, data.height}, data.depth, format.internal, levels_);
        const size_t slice = data.bytes.size() / size_t(data.depth);
        for (int z = 0; z < data.depth; ++z)
            gl::upload(texture, z, format.external, format.type,
                       std::span(data.bytes).subspan(size_t(z) * slice, slice));
        gl::make_mipmaps(texture);
        return {std::move(texture)};
    }

    scene::Sampling sampling_;
    int levels_;
};

tl::unexpected<Error> refuse(const gl::Texture& texture) {
    while (glGetError() != GL_NO_ERROR) { // reported below
    }
    return fail(ErrorCode::load,
                fmt::format("this driver has no memory for a texture of {}x{}x{}; give a smaller one",
                            texture.extent.width, texture.extent.height, texture.depth));
}

std::vector<std::string> sampler_names(int unit) {
    if (unit == k_keyboard_unit)
        return {"iKeyboard"};
    return {fmt::format("iChannel{}", unit), fmt::format("iCh{}.sampler", unit)};
}

} // namespace

Result<ChannelTextures::Index> ChannelTextures::require(const scene::Channel& channel) {
    const bool mipmaps = channel.sampling.mipmaps != scene::Mipmaps::none;
    const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
        return entry.input == channel.input && entry.vflip == channel.sampling.vflip &&
               entry.mipmaps == mipmaps;
    });
    if (known != entries_.end())
        return Index(known - entries_.begin());
    auto loaded = std::visit(Loader(channel.sampling), channel.input);
    if (loaded && !gl::has_storage(loaded->texture))
        loaded = refuse(loaded->texture);
    if (loaded && loaded->texture.es && loaded->texture.internal_format == GL_RGB32F &&
        loaded->texture.levels > 1)
        loaded = fail(ErrorCode::load, "OpenGL ES makes no mipmaps of floats with three channels: give a "
                                       "file with one or four, or of bytes");
    if (!loaded && !channel.where.file.empty()) // name the directive
        return fail(error_at(channel.where, loaded.error().message));
    if (!loaded)
        return fail(std::move(loaded.error()));
    entries_.push_back({channel.input, channel.sampling.vflip, mipmaps, std::move(loaded->texture),
                        std::move(loaded->update), loaded->playback});
    return Index(entries_.size() - 1);
}

void ChannelTextures::update(const FrameInputs& inputs) {
    for (Entry& entry : entries_)
        if (entry.update && entry.update(entry.texture, inputs))
            ++entry.generation;
}

bool ChannelTextures::follow_clock() const {
    return std::ranges::any_of(entries_, [](const Entry& entry) {
        return traits_of(entry.input).changes == scene::Changes::with_clock;
    });
}

double Playback::time_at(double now) const {
    return start + (duration > 0 && now >= 0 ? std::fmod(now, duration) : now);
}

ChannelFact ChannelTextures::fact(Index index, const FrameInputs& inputs) const {
    const Entry& entry = entries_[size_t(index)];
    const gl::Texture& texture = entry.texture;
    if (!traits_of(entry.input).loaded)
        return {};
    ChannelFact fact{
        {double(texture.extent.width), double(texture.extent.height), double(texture.depth)}, 0, true};
    if (texture.target == GL_TEXTURE_CUBE_MAP) // ShaderToy reports no size for cubemap files
        fact.resolution = {};
    if (entry.playback)
        fact.time = entry.playback->time_at(inputs.time);
    return fact;
}

size_t ChannelTextures::bytes() const {
    size_t bytes = 0;
    for (const Entry& entry : entries_)
        bytes += gl::bytes_of(entry.texture);
    return bytes;
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

Result<BoundChannel> make_channel(const gl::Program& program, int unit, const scene::Channel& channel,
                                  ChannelTextures& textures) {
    // Every sample of the single black texel is the same, and the code of a plain sampler is a tenth of that
    // of a filtered one with mipmaps, which llvmpipe compiles for each read.
    constexpr scene::Sampling k_plain{scene::Filter::nearest, scene::Filter::nearest, scene::Mipmaps::none,
                                      scene::Wrap::repeat, true};
    const bool unbound = channel.input.index() == scene::k_kind<scene::Unbound>;
    BoundChannel bound{unit, make_sampler(unbound ? k_plain : channel.sampling), {}};
    if (const size_t* pass = source_pass(channel.input)) {
        bound.source = scene::PassOutput{*pass};
    } else {
        bound.source = TRY(textures.require(channel));
    }
    point_samplers(program, unit);
    return bound;
}

void point_samplers(const gl::Program& program, int unit) {
    const double number[] = {double(unit)};
    for (const std::string& name : sampler_names(unit))
        if (const gl::Uniform* sampler = program.reflection().find(name))
            gl::set_uniform(program, *sampler, number);
}

void bind(const BoundChannel& channel, const gl::Texture& texture) {
    if (texture.target == GL_TEXTURE_CUBE_MAP && !texture.es)
        glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS); // as WebGL 2 and OpenGL ES always do
    gl::bind_texture(GLuint(channel.unit), texture);
    glBindSampler(GLuint(channel.unit), channel.sampler.id());
}

} // namespace tidemark::render
