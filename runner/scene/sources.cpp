#include "scene/sources.hpp"

#include "base/overloaded.hpp"
#include "scene/pass_names.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace tidemark::scene {
namespace fs = std::filesystem;
namespace {

/// Returns the name itself if it has neither `*` nor `{}`. Empty without a complete set of six files.
std::vector<fs::path> cubemap_faces(const fs::path& name) {
    constexpr std::array<std::string_view, 6> k_suffixes[] = {
        {"e", "w", "u", "d", "n", "s"},
        {"east", "west", "up", "down", "north", "south"},
        {"px", "nx", "py", "ny", "pz", "nz"},
        {"posx", "negx", "posy", "negy", "posz", "negz"},
    };
    const std::string text = name.string();
    const size_t braces = text.find("{}");
    const size_t at = braces != std::string::npos ? braces : text.find('*');
    if (at == std::string::npos)
        return {name};
    const size_t length = braces != std::string::npos ? 2 : 1;
    for (const auto& set : k_suffixes) {
        std::vector<fs::path> faces;
        for (const std::string_view suffix : set) {
            fs::path face = std::string(text).replace(at, length, suffix);
            std::error_code ignored;
            if (fs::is_regular_file(face, ignored))
                faces.push_back(std::move(face));
        }
        if (faces.size() == set.size())
            return faces;
    }
    return {};
}

} // namespace

MediaKind media_kind_of(const fs::path& file) {
    constexpr std::pair<std::string_view, MediaKind> k_extensions[] = {
        {".mp3", MediaKind::music},  {".ogg", MediaKind::music}, {".wav", MediaKind::music},
        {".flac", MediaKind::music}, {".mp4", MediaKind::video}, {".webm", MediaKind::video},
        {".ogv", MediaKind::video},  {".gif", MediaKind::video}, {".bin", MediaKind::volume},
    };
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    for (const auto& [known, kind] : k_extensions)
        if (extension == known)
            return kind;
    return MediaKind::picture;
}

bool names_a_pass(std::string_view name) {
    return name == "self" || parse_pass_name(name) || is_shader_file(fs::path(name));
}

ChannelInput input_of_name(std::string_view name, const fs::path& folder, PictureAs picture) {
    if (auto generated = generated_input(name))
        return *std::move(generated);
    if (names_a_pass(name))
        return Unbound{};
    fs::path file = (folder / name).lexically_normal();
    switch (media_kind_of(file)) {
    case MediaKind::music: return Music{std::move(file)};
    case MediaKind::video: return Video{std::move(file)};
    case MediaKind::volume: return Volume{std::move(file)};
    case MediaKind::picture:
    case MediaKind::cubemap: break;
    }
    return picture == PictureAs::cubemap ? ChannelInput(Cubemap{{std::move(file)}})
                                         : Picture{std::move(file)};
}

bool find_faces(ChannelInput& input) {
    return std::visit(Overloaded{[](Cubemap& cubemap) {
                                     cubemap.files = cubemap_faces(cubemap.files.front());
                                     return !cubemap.files.empty();
                                 },
                                 [](const auto&) { return true; }},
                      input);
}

} // namespace tidemark::scene
