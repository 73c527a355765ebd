#include "base/overloaded.hpp"
#include "base/printable.hpp"
#include "base/try.hpp"
#include "scene/host_uniforms.hpp"
#include "scene/json_text.hpp"
#include "scene/pass_names.hpp"
#include "scene/project_files.hpp"
#include "scene/stated_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace tidemark::scene {
namespace {

constexpr int k_buffers = 4;

/// ShaderToy's own files for the textures that Tidemark generates, as its API names them.
struct NoiseFile {
    NoiseKind kind;
    int id;
    const char* ctype;
    const char* file;
};
constexpr NoiseFile k_noise_files[] = {
    {NoiseKind::rgba_256, 30, "texture",
     "f735bee5b64ef98879dc618b016ecf7939a5756040c2cde21ccb15e69a6e1cfb.png"},
    {NoiseKind::rgba_64, 16, "texture",
     "3083c722c0c738cad0f468383167a0d246f91af2bfa373e9c5c094fb8c8413e0.png"},
    {NoiseKind::grey_256, 17, "texture",
     "0c7bf5fe9462d5bffbd11126e82908e39be3ce56220d900f633d58fb432e56f5.png"},
    {NoiseKind::grey_64, 15, "texture",
     "0a40562379b63dfb89227e6d172f39fdce9022cba76623f1054a2c83d6c0ba5d.png"},
    {NoiseKind::blue_1024, 14854, "texture",
     "cb49c003b454385aa9975733aff4571c62182ccdda480aaba9a8d250014f00ec.png"},
    {NoiseKind::bayer_8, 28, "texture",
     "85a6d68622b36995ccb98a89bbb119edf167c914660e4450d313de049320005c.png"},
    {NoiseKind::grey_volume_32, 39, "volume",
     "27012b4eadd0c3ce12498b867058e4f717ce79e10a99568cca461682d84a4b04.bin"},
    {NoiseKind::rgba_volume_32, 40, "volume",
     "aea6b99da1d53055107966b59ac5444fc8bc7b3ce2d0bbb6a4a3cbae1d97f3aa.bin"},
};

class ProjectWriter {
public:
    ProjectWriter(const Scene& scene, std::vector<Diagnostic>& warnings)
        : scene_(scene), warnings_(warnings) {}

    Result<Json> write() {
        TRY(number_buffers());
        Json passes = Json::array();
        for (const Pass& pass : scene_.passes)
            if (pass.kind == PassKind::image)
                passes.push_back(image_of(pass));
        const std::string common = knobs_as_constants(scene_) + scene_.common.text();
        if (!common.empty())
            passes.push_back({{"inputs", Json::array()},
                              {"outputs", Json::array()},
                              {"code", common},
                              {"name", "Common"},
                              {"description", ""},
                              {"type", "common"}});
        for (size_t i = 0; i < scene_.passes.size(); ++i) {
            const Pass& pass = scene_.passes[i];
            if (pass.kind == PassKind::buffer)
                passes.push_back(pass_of(pass, "buffer", buffer_name(numbers_[i]), 257 + numbers_[i]));
            else if (pass.kind == PassKind::cubemap)
                passes.push_back(pass_of(pass, "cubemap", "Cube A", 41));
            else if (pass.kind == PassKind::sound)
                passes.push_back(pass_of(pass, "sound", "Sound", 38));
        }
        const Json info = {
            {"id", ""}, {"name", valid_utf8(scene_.name())}, {"description", ""}, {"tags", Json::array()}};
        return Json{{"Shader", {{"ver", "0.1"}, {"info", info}, {"renderpass", std::move(passes)}}}};
    }

private:
    /// Gives each buffer the letter in its name; the others get the free letters, in drawing order.
    Result<void> number_buffers() {
        numbers_.assign(scene_.passes.size(), -1);
        std::array<bool, k_buffers> taken{};
        for (const bool named : {true, false})
            for (size_t i = 0; i < numbers_.size(); ++i) {
                const auto name = parse_pass_name(scene_.passes[i].name);
                if (scene_.passes[i].kind != PassKind::buffer || numbers_[i] >= 0 || (named && !name))
                    continue;
                int number = named ? name->number : 0;
                while (!named && number < k_buffers && taken[size_t(number)])
                    ++number;
                if (number == k_buffers)
                    return fail(ErrorCode::load,
                                fmt::format("'{}' has more than {} buffers, which is all that "
                                            "ShaderToy has",
                                            scene_.file.string(), k_buffers));
                numbers_[i] = number;
                taken[size_t(number)] = true;
            }
        return {};
    }

    void warn(const SourceLocation& where, std::string message) {
        warnings_.push_back({where.file.empty() ? SourceLocation{scene_.file.string()} : where,
                             Severity::warning, std::move(message)});
    }

    /// Adds `size`: ShaderToy has no such field and ignores it, but an import reads it here.
    Json image_of(const Pass& pass) {
        Json json = pass_of(pass, "image", "Image", 37);
        if (scene_.size)
            json["size"] = to_string(*scene_.size);
        return json;
    }

    Json pass_of(const Pass& pass, const char* type, const std::string& name, int output) {
        if (pass.keyboard_helpers)
            warn({}, fmt::format("'{}' says #iKeyboard: ShaderToy has no isKeyDown and the like", pass.name));
        const std::string camera(k_camera_uniform);
        if (pass.text.text().find(camera) != std::string::npos ||
            scene_.common.text().find(camera) != std::string::npos)
            warn({}, fmt::format("'{}' says {}: ShaderToy has no such uniform, and it is all zeros there",
                                 pass.name, camera));
        Json inputs = Json::array();
        for (size_t i = 0; i < pass.channels.size(); ++i) {
            const std::string channel = fmt::format("iChannel{}", i);
            const bool mentioned = pass.text.text().find(channel) != std::string::npos ||
                                   scene_.common.text().find(channel) != std::string::npos;
            if (mentioned && i >= size_t(k_site_channel_count))
                warn(pass.channels[i].where,
                     fmt::format("'{}' reads {}: ShaderToy has four channels", pass.name, channel));
            else if (mentioned && !traits_of(pass.channels[i].input).site_type.empty())
                inputs.push_back(input_of(pass.channels[i], int(i)));
        }
        return {{"inputs", std::move(inputs)}, {"outputs", Json::array({{{"id", output}, {"channel", 0}}})},
                {"code", pass.text.text()},    {"name", name},
                {"description", ""},           {"type", type}};
    }

    Json input_of(const Channel& channel, int number) {
        const Sampling& sampling = channel.sampling;
        Json input = source_of(channel);
        input["channel"] = number;
        input["sampler"] = {{"filter", sampling.mipmaps != Mipmaps::none     ? "mipmap"
                                       : sampling.magnify == Filter::nearest ? "nearest"
                                                                             : "linear"},
                            {"wrap", sampling.wrap == Wrap::clamp ? "clamp" : "repeat"},
                            {"vflip", sampling.vflip ? "true" : "false"},
                            {"srgb", "false"},
                            {"internal", "byte"}};
        input["published"] = 1;
        return input;
    }

    Json source_of(const Channel& channel) {
        return std::visit(
            Overloaded{[&](const PassOutput& output) { return output_of(output.pass); },
                       [&](const Noise& noise) { return noise_of(noise, channel); },
                       [](const Keyboard&) -> Json {
                           return {{"id", 33}, {"src", "/presets/tex00.jpg"}, {"ctype", "keyboard"}};
                       },
                       [&](const Music& music) { return live_or_file(music, 32, "mic", channel); },
                       [&](const Video& video) { return live_or_file(video, 31, "webcam", channel); },
                       [&](const auto&) { return own_file(channel); }},
            channel.input);
    }

    /// Returns the live microphone or webcam for an input without a file, since ShaderToy uses those.
    template <class Played>
    Json live_or_file(const Played& input, int id, std::string_view type, const Channel& channel) {
        if (!input.file.empty())
            return own_file(channel);
        return {{"id", id}, {"src", fmt::format("/presets/{}.png", type)}, {"ctype", type}};
    }

    Json noise_of(const Noise& noise, const Channel& channel) {
        for (const NoiseFile& file : k_noise_files)
            if (file.kind == noise.kind)
                return {
                    {"id", file.id}, {"src", fmt::format("/media/a/{}", file.file)}, {"ctype", file.ctype}};
        return own_file(channel);
    }

    Json output_of(size_t pass) const {
        if (scene_.passes[pass].kind == PassKind::cubemap)
            return {{"id", 41}, {"src", "/media/previz/cubemap00.png"}, {"ctype", "cubemap"}};
        return {{"id", 257 + numbers_[pass]},
                {"src", fmt::format("/media/previz/buffer0{}.png", numbers_[pass])},
                {"ctype", "buffer"}};
    }

    /// Returns a file of the scene's own, with a warning: ShaderToy does not have it.
    Json own_file(const Channel& channel) {
        const auto files = input_files(channel.input);
        const std::string source =
            files.empty() ? std::string(traits_of(channel.input).name) : relative(files.front());
        warn(channel.where, fmt::format("ShaderToy has no '{}': choose something there", source));
        return {{"id", 0}, {"src", source}, {"ctype", traits_of(channel.input).site_type}};
    }

    std::string relative(const std::filesystem::path& file) const {
        std::error_code ignored;
        const bool folder = std::filesystem::is_directory(scene_.file, ignored);
        return file.lexically_proximate(folder ? scene_.file : scene_.file.parent_path()).string();
    }

    const Scene& scene_;
    std::vector<Diagnostic>& warnings_;
    std::vector<int> numbers_; ///< for each pass that is a buffer; -1: no buffer
};

} // namespace

std::string knobs_as_constants(const Scene& scene) {
    std::string text;
    for (const Knob& knob : scene.knobs) {
        std::string value = to_string(knob);
        if (knob.type == KnobType::float1 && value.find_first_of(".e") == std::string::npos)
            value += ".0";
        text += fmt::format("const {} {} = {};\n", info(knob.type).glsl_name, knob.name, value);
    }
    return text;
}

Result<std::string> make_project(const Scene& scene, std::vector<Diagnostic>& warnings) {
    auto json = TRY(ProjectWriter(scene, warnings).write());
    try {
        return json.dump(k_json_indent) + "\n";
    } catch (const Json::type_error&) { // JSON must be Unicode
        return fail(ErrorCode::load,
                    fmt::format("'{}' has a text that is not UTF-8: save it as that, for JSON is",
                                scene.file.string()));
    }
}

} // namespace tidemark::scene
