#include "scene/sources.hpp"

#include <algorithm>
#include <string>

namespace tidemark::scene {
namespace fs = std::filesystem;

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

ChannelInput input_of_file(fs::path file) {
    switch (media_kind_of(file)) {
    case MediaKind::music: return Music{std::move(file)};
    case MediaKind::video: return Video{std::move(file)};
    case MediaKind::volume: return Volume{std::move(file)};
    case MediaKind::picture:
    case MediaKind::cubemap: break;
    }
    return Picture{std::move(file)};
}

} // namespace tidemark::scene
