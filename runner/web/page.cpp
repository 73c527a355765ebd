// A channel's input as JSON: files of the scene embedded whole in base 64, generated pictures as PNG.

#include "web/page.hpp"

#include "base/encoding.hpp"
#include "base/file.hpp"
#include "lab/report_page.hpp"
#include "media/generated_textures.hpp"
#include "media/picture_codecs.hpp"
#include "media/picture_file.hpp"
#include "media/texture_files.hpp"
#include "scene/channel.hpp"
#include "scene/host_uniforms.hpp"
#include "shader/pass_reading.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cassert>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::web {
namespace {

/// Bytes of the largest file that is embedded in a page.
constexpr size_t k_largest_file = size_t{64} << 20;

Json numbers(const scene::KnobValue& value, int count) {
    return Json(std::vector<double>(value.begin(), value.begin() + count));
}

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
        return fail(ErrorCode::load, fmt::format("cannot write a texture as PNG: {}", png.error()));
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

/// Returns an object whose `kind` determines the other members (host/inputs.js). Not for a PassOutput. Fails
/// (ErrorCode::load) on a file that cannot be read or is too large.
Result<Json> input_data(const scene::Channel& channel) {
    auto data = std::visit(Embedder(channel.sampling.vflip), channel.input);
    if (!data && !channel.where.file.empty()) // report the directive that names the file
        return fail(error_at(channel.where, data.error().message));
    return data;
}

std::string_view name_of(scene::PassKind kind) {
    switch (kind) {
    case scene::PassKind::buffer: return "buffer";
    case scene::PassKind::cubemap: return "cubemap";
    case scene::PassKind::sound: return "sound";
    default: return "image";
    }
}

/// Returns GLSL ES 3.00 without initialisers: WebGL sets variables to zero, as shaders written for it expect,
/// and the page sets uniforms to the values of their knobs.
text::MappedText web_source(const glsl::PassReading& reading, const std::vector<scene::Knob>& knobs) {
    const auto dialects = reading.dialects(glsl::Precision::single);
    glsl::Dialect dialect = *std::ranges::find(dialects, glsl::Version::es_300, &glsl::Dialect::version);
    dialect.initialise = false;
    text::MappedText source = reading.assemble(dialect)->source; // fails only in double precision
    source.apply(scene::without_plain_defaults(source.text(), knobs));
    return source;
}

/// Returns the path relative to the scene, so that a page does not reveal its author's folders.
std::string shown_name(const std::filesystem::path& file, const scene::Scene& scene) {
    const auto relative =
        file.lexically_normal().lexically_relative(scene.file.parent_path().lexically_normal());
    return relative.empty() || *relative.begin() == ".." ? file.filename().string() : relative.string();
}

/// Returns [line of the source, file, line in the file] for each line at which a run of a file begins;
/// generated lines have an empty file.
Json line_runs(const text::MappedText& source, const scene::Scene& scene) {
    Json runs = Json::array();
    SourceLocation last;
    for (int line = 1; line <= source.line_count(); ++line) {
        const SourceLocation here = source.lines().locate(line);
        const bool goes_on = here.file == last.file && (here.file.empty() || here.line == last.line + 1);
        if (line == 1 || !goes_on)
            runs.push_back({line, here.file.empty() ? "" : shown_name(here.file, scene), here.line});
        last = here;
    }
    return runs;
}

/// Returns `name`, `kind`, `source` (GLSL ES 3.00: the author's text and the host's around it), `lines`
/// (which lines of the source come from which file), `discards`, and `foreign` (it may use other hosts'
/// uniforms).
Json pass_data(const scene::Scene& scene, const scene::Pass& pass) {
    const glsl::PassReading reading(scene, pass);
    const text::MappedText source = web_source(reading, scene.knobs);
    return {{"name", pass.name},
            {"kind", name_of(pass.kind)},
            {"source", source.text()},
            {"lines", line_runs(source, scene)},
            {"discards", reading.discards()},
            {"foreign", pass.bare_file || reading.has_own_main()}};
}

/// Returns the channels that the text may read, ascending.
std::vector<size_t> channels_named(const scene::Scene& scene, const scene::Pass& pass) {
    const glsl::PassReading reading(scene, pass);
    const auto named = [&](std::string_view name) { return reading.place_of(name).has_value(); };
    // Sizes and times are indexed by a number that only a compiler can evaluate, so the first four count.
    const bool asks = named("iChannelResolution") || named("iChannelTime") || named("iChannel");
    std::vector<size_t> channels;
    for (size_t i = 0; i < scene::k_channel_count; ++i)
        if ((asks && i < scene::k_site_channel_count) || named(fmt::format("iChannel{}", i)) ||
            named(fmt::format("iCh{}", i)))
            channels.push_back(i);
    return channels;
}

using scene::PassKind;

/// Leaves a Sound pass only inputs that never change, like ShaderToy.
scene::Channel heard(const scene::Scene& scene, scene::Channel channel) {
    if (traits_of(channel.input).changes != scene::Changes::never)
        channel.input = scene::Unbound{texture_kind(scene, channel.input)};
    return channel;
}

Json sampler_of(const scene::Sampling& sampling) {
    constexpr std::string_view k_filter[] = {"nearest", "linear"};
    constexpr std::string_view k_mipmaps[] = {"none", "nearest", "linear"};
    constexpr std::string_view k_wrap[] = {"repeat", "clamp", "mirror"};
    return {{"magnify", k_filter[size_t(sampling.magnify)]},
            {"minify", k_filter[size_t(sampling.minify)]},
            {"mipmaps", k_mipmaps[size_t(sampling.mipmaps)]},
            {"wrap", k_wrap[size_t(sampling.wrap)]}};
}

class Collector {
public:
    explicit Collector(const scene::Scene& scene)
        : scene_(scene), named_(scene.passes.size()), place_(scene.passes.size(), k_nowhere) {}

    Result<Json> collect() {
        need(scene_.image_index());
        if (const scene::Pass* sound = scene_.find(PassKind::sound))
            need(size_t(sound - scene_.passes.data()));
        number_passes();
        Json passes = Json::array();
        for (size_t pass = 0; pass < place_.size(); ++pass) {
            if (place_[pass] == k_nowhere)
                continue;
            Json data = pass_data(scene_, scene_.passes[pass]);
            data["channels"] = TRY(channels_of(pass));
            passes.push_back(std::move(data));
        }
        Json knobs = Json::array();
        for (const scene::Knob& knob : scene_.knobs)
            knobs.push_back(knob_data(knob));
        Json data{{"name", scene_.name()},
                  {"passes", std::move(passes)},
                  {"inputs", std::move(inputs_)},
                  {"knobs", std::move(knobs)},
                  {"followsPointer", glsl::PassReading(scene_, scene_.image()).mouse_follows_pointer()}};
        if (scene_.size)
            data["size"] = {scene_.size->width, scene_.size->height};
        return data;
    }

private:
    static constexpr size_t k_nowhere = size_t(-1);
    static constexpr size_t k_needed = 0;

    void need(size_t pass) {
        if (place_[pass] == k_needed)
            return;
        place_[pass] = k_needed;
        named_[pass] = channels_named(scene_, scene_.passes[pass]);
        for (const size_t channel : named_[pass])
            if (const size_t* source = source_pass(scene_.passes[pass].channels[channel].input))
                need(*source);
    }

    /// Numbers the needed passes in their order on the page.
    void number_passes() {
        size_t count = 0;
        for (size_t& place : place_)
            if (place == k_needed)
                place = count++;
    }

    Result<Json> channels_of(size_t pass) {
        Json channels = Json::array();
        for (const size_t number : named_[pass]) {
            const scene::Channel& given = scene_.passes[pass].channels[number];
            const scene::Channel channel =
                scene_.passes[pass].kind == PassKind::sound ? heard(scene_, given) : given;
            Json data = {{"number", number}, {"sampler", sampler_of(channel.sampling)}};
            if (const size_t* source = source_pass(channel.input))
                data["pass"] = place_[*source];
            else
                data["input"] = TRY(place_of(channel));
            channels.push_back(std::move(data));
        }
        return channels;
    }

    /// Returns the index among the inputs; several channels share an equal input.
    Result<size_t> place_of(const scene::Channel& channel) {
        const auto known = std::ranges::find_if(known_, [&](const scene::Channel& other) {
            return other.input == channel.input && other.sampling.vflip == channel.sampling.vflip;
        });
        if (known != known_.end())
            return size_t(known - known_.begin());
        inputs_.push_back(TRY(input_data(channel)));
        known_.push_back(channel);
        return known_.size() - 1;
    }

    const scene::Scene& scene_;
    std::vector<std::vector<size_t>> named_; ///< channels that each pass's text names
    std::vector<size_t> place_;              ///< index of each pass on the page
    std::vector<scene::Channel> known_;
    Json inputs_ = Json::array();
};

/// Leaves out passes that are not needed and inputs that no text names. Fails like `make_page`.
Result<Json> scene_data(const scene::Scene& scene, const Json& numbers) {
    auto data = TRY(Collector(scene).collect());
    data["numbers"] = numbers;
    return data;
}

/// Escapes everything to ASCII, since the page around a figure need not be in UTF-8; invalid bytes are
/// replaced.
std::string in_script(const nlohmann::ordered_json& data) {
    return report::in_script(data.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace));
}

std::string_view name_of(scene::Follows follows) {
    switch (follows) {
    case scene::Follows::nothing: return "nothing";
    case scene::Follows::clock: return "clock";
    case scene::Follows::mouse: return "mouse";
    case scene::Follows::camera: return "camera";
    }
    return "";
}

/// Returns the names in quotes, without the empty ones.
std::string quoted(std::span<const std::string_view> names) {
    std::string text;
    for (const std::string_view name : names)
        if (!name.empty())
            text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", name);
    return text;
}

/// Returns the rows of HOST_UNIFORMS (host/uniforms.js).
std::string uniform_rows() {
    std::string rows = "// scene/host_uniforms.hpp\n";
    for (const scene::HostUniform& row : scene::k_host_uniforms)
        if (!row.script.empty())
            rows += fmt::format("    {{names: [{}], others: [{}], follows: \"{}\",{}\n"
                                "     value: (moment, size, channels) => {}}},\n",
                                quoted({&row.name, 1}), quoted(row.other_names), name_of(row.follows),
                                row.length > 0 ? fmt::format(" width: {},", component_count(row)) : "",
                                row.script);
    return rows;
}

} // namespace

Json knob_data(const scene::Knob& knob) {
    const scene::KnobTypeInfo& type = info(knob.type);
    Json data = {{"name", knob.name},
                 {"colour", knob.type == scene::KnobType::color3},
                 {"whole", type.whole},
                 {"value", numbers(knob.value, type.components)}};
    if (knob.range) {
        data["low"] = numbers(knob.range->low, type.components);
        data["high"] = numbers(knob.range->high, type.components);
    }
    if (knob.step)
        data["step"] = numbers(*knob.step, type.components);
    return data;
}

Result<std::string> make_page(const scene::Scene& scene, PageForm form, const Json& numbers) {
    const auto data = TRY(scene_data(scene, numbers));
    const std::string host = report::filled(k_host, {{"// {{uniforms}}\n", uniform_rows()}});
    const bool whole = form == PageForm::whole;
    const std::string figure = report::filled(k_figure, {{"{{moment}}", whole ? "" : " data-moment=\"\""},
                                                         {"{{style}}", k_style},
                                                         {"{{scene}}", in_script(data)},
                                                         {"{{host}}", host}});
    if (!whole)
        return figure;
    const std::string title = report::escaped(scene.name());
    return report::filled(k_page, {{"{{title}}", title}, {"{{heading}}", title}, {"{{figure}}", figure}});
}

} // namespace tidemark::web
