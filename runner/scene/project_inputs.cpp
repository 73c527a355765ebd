#include "scene/project_inputs.hpp"

#include "base/try.hpp"
#include "scene/pass_names.hpp"
#include "scene/sources.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::scene {
namespace fs = std::filesystem;
namespace {

/// Returns the buffer of ShaderToy's preview picture: `/media/previz/buffer02.png` is C.
std::optional<int> previz_buffer(std::string_view source) {
    constexpr std::string_view k_name = "previz/buffer0";
    const size_t at = source.find(k_name);
    if (at == std::string_view::npos || at + k_name.size() >= source.size())
        return std::nullopt;
    const char digit = source[at + k_name.size()];
    return digit >= '0' && digit <= '3' ? std::optional(digit - '0') : std::nullopt;
}

/// Also matches `/media/a//media/previz/cubemap00.png`.
bool is_previz_cube(std::string_view source) {
    return source.find("previz/cubemap0") != std::string_view::npos;
}

bool is_remote(std::string_view source) {
    return source.find("://") != std::string_view::npos || source.starts_with("data:") ||
           source.starts_with("//");
}

bool is_there(const fs::path& file) {
    std::error_code ignored;
    return fs::exists(file, ignored);
}

/// Shortens a name for messages: a source may be a whole picture in base 64.
std::string shown(const ProjectInput& input) {
    const std::string& name = input.source.empty() ? input.id : input.source;
    return name.size() <= 120 ? name : name.substr(0, 120) + "...";
}

} // namespace

InputReader::Kind InputReader::kind_of(const ProjectInput& input) {
    constexpr std::pair<std::string_view, Kind> k_types[] = {
        {"texture", Kind::picture},   {"buffer", Kind::buffer},     {"cubemap", Kind::cubemap},
        {"volume", Kind::volume},     {"keyboard", Kind::keyboard}, {"music", Kind::music},
        {"musicstream", Kind::music}, {"mic", Kind::microphone},    {"video", Kind::video},
        {"webcam", Kind::webcam},
    };
    constexpr std::pair<std::string_view, Kind> k_ids[] = {
        {"33", Kind::keyboard}, {"4dXGRr", Kind::keyboard}, {"31", Kind::webcam}, {"32", Kind::microphone}};
    for (const auto& [word, kind] : k_types)
        if (input.type == word)
            return kind;
    if (buffer_number(input.id) || previz_buffer(input.source))
        return Kind::buffer;
    if (is_cube_id(input.id) || is_previz_cube(input.source))
        return Kind::cubemap;
    for (const auto& [id, kind] : k_ids)
        if (input.id == id)
            return kind;
    constexpr Kind k_media_kinds[] = {Kind::picture, Kind::cubemap, Kind::volume, Kind::video, Kind::music};
    if (const Media* media = media_of(input))
        return k_media_kinds[size_t(media->kind)];
    if (const auto named = parse_pass_name(input.source))
        return named->kind == ProjectPass::Kind::cubemap ? Kind::cubemap : Kind::buffer;
    if (input.source.empty())
        return Kind::none;
    return k_media_kinds[size_t(media_kind_of(fs::path(input.source)))];
}

const Media* InputReader::media_of(const ProjectInput& input) {
    const Media* media = find_media(input.source);
    return media || !input.source.empty() ? media : find_media_by_id(input.id);
}

Sampling InputReader::sampling_of(const ProjectInput& input, Kind kind) {
    if (kind == Kind::keyboard)
        return k_keyboard_sampling;
    if (kind == Kind::music ||
        kind == Kind::microphone) // ShaderToy ignores the sampler for these
        return k_buffer_sampling;
    Sampling sampling = kind == Kind::picture   ? k_texture_sampling
                        : kind == Kind::volume  ? k_volume_sampling
                        : kind == Kind::cubemap ? k_cubemap_sampling
                                                : k_buffer_sampling;
    if (input.filter == "nearest")
        sampling.magnify = sampling.minify = Filter::nearest;
    else if (input.filter == "linear" || input.filter == "mipmap")
        sampling.magnify = sampling.minify = Filter::linear;
    if (!input.filter.empty())
        sampling.mipmaps = input.filter == "mipmap" ? Mipmaps::linear : Mipmaps::none;
    if (input.wrap == "repeat")
        sampling.wrap = Wrap::repeat;
    else if (input.wrap == "clamp")
        sampling.wrap = Wrap::clamp;
    if (!input.vflip.empty())
        sampling.vflip = input.vflip == "true";
    return sampling;
}

Result<Channel> InputReader::read(const ProjectInput& input) {
    const Kind kind = kind_of(input);
    auto what = TRY(input_of(input, kind));
    return Channel{std::move(what), sampling_of(input, kind), {}};
}

Result<ChannelInput> InputReader::input_of(const ProjectInput& input, Kind kind) {
    switch (kind) {
    case Kind::none: return Unbound{};
    case Kind::buffer: return output_of(input);
    case Kind::keyboard: return Keyboard{};
    case Kind::microphone: return live_input("microphone", {Music{}, "ShaderToy's signal for silence"});
    case Kind::webcam: return live_input("webcam", {Video{}, "a generated picture of 640x480"});
    case Kind::cubemap:
        if (is_cube_id(input.id) || is_previz_cube(input.source) || parse_pass_name(input.source))
            return cube_output();
        return media_input(input, MediaKind::cubemap);
    case Kind::picture: return media_input(input, MediaKind::picture);
    case Kind::volume: return media_input(input, MediaKind::volume);
    case Kind::music: return media_input(input, MediaKind::music);
    case Kind::video: return media_input(input, MediaKind::video);
    }
    return Unbound{};
}

/// Returns the buffer whose output has the input's id; else the one with that id in the other dialect, or
/// with that preview picture.
ChannelInput InputReader::output_of(const ProjectInput& input) const {
    const auto& passes = context_.project.passes;
    for (size_t i = 0; i < passes.size(); ++i)
        if (passes[i].kind == ProjectPass::Kind::buffer && !input.id.empty() && passes[i].output == input.id)
            return PassOutput{i};
    auto number = buffer_number(input.id);
    if (!number)
        number = previz_buffer(input.source);
    if (const auto named = parse_pass_name(input.source); !number && named)
        number = named->number;
    if (!number)
        return Unbound{};
    const auto& names = context_.names;
    const auto named = std::find(names.begin(), names.end(), buffer_name(*number));
    return named == names.end() ? ChannelInput(Unbound{}) : PassOutput{size_t(named - names.begin())};
}

ChannelInput InputReader::cube_output() const {
    const auto& passes = context_.project.passes;
    for (size_t i = passes.size(); i-- > 0;)
        if (passes[i].kind == ProjectPass::Kind::cubemap)
            return PassOutput{i};
    return Unbound{TextureKind::cube};
}

Result<ChannelInput> InputReader::media_input(const ProjectInput& input, MediaKind kind) {
    auto files = TRY(files_of(input, kind));
    const Media* media = media_of(input);
    if (files.empty())
        return instead_of(input, media, substitute_for(kind, media));
    switch (kind) {
    case MediaKind::picture:
        return Picture{files.front(), media && media->kind == kind && media->channels == 1};
    case MediaKind::cubemap: return Cubemap{std::move(files)};
    case MediaKind::volume: return Volume{files.front()};
    case MediaKind::video: return Video{files.front()};
    case MediaKind::music: break;
    }
    return Music{files.front()};
}

/// Returns a file of the project's own, else one of ShaderToy's media.
Result<std::vector<fs::path>> InputReader::files_of(const ProjectInput& input, MediaKind kind) const {
    const Media* media = media_of(input);
    const std::string source = input.source.empty() && media ? std::string(media->hash) : input.source;
    if (source.empty())
        return std::vector<fs::path>{};
    if (!is_remote(source) && !source.starts_with('/') && !input.source.empty()) {
        const fs::path own = (context_.folder / source).lexically_normal();
        if (auto inside = context_.bounds.check(own); !inside)
            return fail(error_at({context_.file}, inside.error().message));
        if (is_there(own))
            return std::vector{own};
    }
    if (kind == MediaKind::cubemap)
        return context_.media.find_cubemap(source);
    fs::path found = context_.media.find(source);
    return found.empty() ? std::vector<fs::path>{} : std::vector{std::move(found)};
}

/// Substitutes a live input and warns of it once: it is live only in a window that was started with that
/// option.
ChannelInput InputReader::live_input(const std::string& name, Substitute instead) {
    if (warned_.insert(name).second)
        warnings_.push_back(
            {{context_.file},
             Severity::warning,
             fmt::format("'{0}' is live: {1} stands in for it without view --{0}", name, instead.name)});
    return std::move(instead.input);
}

ChannelInput InputReader::instead_of(const ProjectInput& input, const Media* media, Substitute instead) {
    if (instead.name.empty() || !warned_.insert(input.source.empty() ? input.id : input.source).second)
        return std::move(instead.input);
    std::string what = fmt::format("'{}'", shown(input));
    if (media && !media->title.empty())
        what += fmt::format(" ({})", media->title);
    warnings_.push_back(
        {{context_.file},
         Severity::warning,
         fmt::format("{} is not here: {} stands in for it (--media DIR says where such files are)", what,
                     instead.name)});
    return std::move(instead.input);
}

} // namespace tidemark::scene
