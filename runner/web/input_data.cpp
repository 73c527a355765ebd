#include "web/input_data.hpp"

#include "base/base64.hpp"
#include "base/file.hpp"
#include "base/try.hpp"
#include "image/files/cubemap_file.hpp"
#include "image/files/picture_file.hpp"
#include "image/files/png_codec.hpp"
#include "image/made/noise.hpp"
#include "image/made/stand_in.hpp"
#include "image/volume.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cassert>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace tidemark::web {
namespace {

using image::Image;
using image::SampleType;

std::string base64_of(std::span<const std::byte> bytes) {
    return base64({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// Returns whether a photograph has camera data: browsers rotate by its orientation, the program does not.
bool has_camera_data(std::string_view jpeg) {
    return jpeg.substr(0, size_t{64} << 10).find("Exif") != std::string_view::npos;
}

/// Returns the type of a file that browsers decode like the program does, so that it can be embedded
/// unchanged; otherwise empty.
std::string_view type_of(std::string_view file) {
    if (file.starts_with("\x89PNG"))
        return "image/png";
    return file.starts_with("\xff\xd8\xff") && !has_camera_data(file) ? "image/jpeg" : "";
}

/// `flip`: the texture's first row is the picture's last.
Json picture_file(std::string_view type, std::string_view bytes, bool flip) {
    return {{"kind", "picture"}, {"type", type}, {"flip", flip}, {"data", base64(bytes)}};
}

/// Embeds samples; the image's first row becomes the texture's first row.
Result<Json> samples_of(const Image& image) {
    if (image.type == SampleType::f32)
        return Json{{"kind", "floats"},
                    {"width", image.extent.width},
                    {"height", image.extent.height},
                    {"channels", image.channels},
                    {"data", base64_of(image.bytes)}};
    const auto png = image::encode_png(
        {image::FileFormat::png, image::SampleDepth::u8, image.extent, image.channels, image.bytes, {}});
    if (!png)
        return fail(ErrorCode::load, fmt::format("a texture cannot be made a PNG: {}", png.error()));
    return picture_file("image/png", {reinterpret_cast<const char*>(png->data()), png->size()}, true);
}

Json red_alone(Json picture) {
    picture["red"] = true;
    return picture;
}

Json volume_of(const image::VolumeData& data) {
    return {{"kind", "volume"},
            {"size", {data.width, data.height, data.depth}},
            {"channels", data.channels},
            {"floats", data.type == SampleType::f32},
            {"data", base64_of(data.bytes)}};
}

Json media_file(std::string_view kind, std::string_view bytes) {
    return {{"kind", kind}, {"data", base64(bytes)}};
}

/// Makes one JSON object per channel.
class Embedder {
public:
    explicit Embedder(bool vflip) : vflip_(vflip) {}

    Result<Json> operator()(const scene::Unbound&) const { return Json{{"kind", "none"}}; }

    Result<Json> operator()(const scene::PassOutput&) const {
        assert(false && "what a pass draws lies in no page");
        return Json{};
    }

    Result<Json> operator()(const scene::Picture& picture) const {
        // checked here, since a browser would not report what is wrong
        const auto image = TRY(image::read_picture(picture.file));
        const auto file = TRY(read_file(picture.file, k_largest_file));
        const std::string_view type = type_of(file);
        const bool as_it_is = !type.empty() && image.type == SampleType::u8;
        Json data = as_it_is ? picture_file(type, file, vflip_) : TRY(flat(image));
        return picture.one_channel ? red_alone(std::move(data)) : data;
    }

    Result<Json> operator()(const scene::Noise& noise) const {
        using image::NoiseTexture;
        using scene::NoiseKind;
        switch (noise.kind) {
        case NoiseKind::rgba_256: return flat(image::make_noise(NoiseTexture::rgba_256));
        case NoiseKind::rgba_64: return flat(image::make_noise(NoiseTexture::rgba_64));
        case NoiseKind::grey_256: return flat(image::make_noise(NoiseTexture::grey_256)).map(red_alone);
        case NoiseKind::grey_64: return flat(image::make_noise(NoiseTexture::grey_64)).map(red_alone);
        case NoiseKind::blue_1024: return flat(image::make_noise(NoiseTexture::blue_1024));
        case NoiseKind::bayer_8: return flat(image::make_noise(NoiseTexture::bayer_8)).map(red_alone);
        case NoiseKind::grey_volume_32:
            return volume_of(image::make_noise_volume(image::NoiseVolume::grey_32));
        case NoiseKind::rgba_volume_32:
            return volume_of(image::make_noise_volume(image::NoiseVolume::rgba_32));
        }
        return flat(image::make_noise());
    }

    Result<Json> operator()(const scene::Cubemap& cubemap) const {
        const auto faces = TRY(image::read_cubemap(cubemap.files));
        return cube(faces);
    }

    Result<Json> operator()(const scene::Volume& input) const {
        return image::read_volume(input.file).map(volume_of);
    }

    Result<Json> operator()(const scene::StandIn& stand_in) const {
        const std::string name = fmt::format("{}x{}x{}", stand_in.width, stand_in.height, stand_in.channels);
        using Kind = scene::StandIn::Kind;
        if (stand_in.kind == Kind::cubemap)
            return cube(image::make_stand_in_cube(name, stand_in.width, stand_in.channels));
        if (stand_in.kind == Kind::volume)
            return volume_of(image::make_stand_in_volume(name, stand_in.width, stand_in.height,
                                                         stand_in.height, stand_in.channels));
        auto data =
            flat(image::make_stand_in_picture(name, {stand_in.width, stand_in.height}, stand_in.channels));
        return stand_in.channels == 1 ? std::move(data).map(red_alone) : data;
    }

    Result<Json> operator()(const scene::Constant& constant) const {
        using Kind = scene::Constant::Kind;
        Image image({1, 1}, 4, SampleType::f32);
        const float value = constant.kind == Kind::white   ? 1.0f
                            : constant.kind == Kind::texel ? 0.5f
                            : constant.kind == Kind::nan   ? std::numeric_limits<float>::quiet_NaN()
                                                           : 0.0f;
        std::ranges::fill(image.f32(), value);
        return samples_of(image);
    }

    Result<Json> operator()(const scene::Keyboard& keyboard) const {
        return Json{{"kind", "keyboard"}, {"rows", keyboard.rows}};
    }

    Result<Json> operator()(const scene::Music& music) const {
        if (music.file.empty())
            return Json{{"kind", "silence"}};
        const auto file = TRY(read_file(music.file, k_largest_file));
        return media_file("music", file);
    }

    Result<Json> operator()(const scene::Video& video) const {
        if (video.file.empty())
            return flat(image::make_stand_in_camera());
        const auto file = TRY(read_file(video.file, k_largest_file));
        Json data = media_file("video", file);
        data["flip"] = vflip_;
        return data;
    }

private:
    Result<Json> flat(const Image& image) const { return samples_of(vflip_ ? image : image::flipped(image)); }

    Result<Json> cube(const image::CubeFaces& from) const {
        Json faces = Json::array();
        for (const Image& face : vflip_ ? image::vflipped(from) : from)
            faces.push_back(TRY(samples_of(face)));
        return Json{{"kind", "cubemap"}, {"side", from[0].extent.width}, {"faces", std::move(faces)}};
    }

    bool vflip_;
};

} // namespace

Result<Json> input_data(const scene::Channel& channel) {
    auto data = std::visit(Embedder(channel.sampling.vflip), channel.input);
    if (!data && !channel.where.file.empty()) // report the directive that names the file
        return fail(error_at(channel.where, data.error().message));
    return data;
}

} // namespace tidemark::web
