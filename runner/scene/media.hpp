// ShaderToy's own media: pictures, cubemaps, volumes, videos and music that its projects name by file or by
// number. Names and sizes only; where a file of that name is, or what stands in for it, is found here too,
// but no file is opened.
#pragma once

#include "scene/channel.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::scene {

enum class MediaKind { picture, cubemap, volume, video, music };

struct Media {
    std::string_view title;
    std::string_view hash;    ///< how its file under /media/a begins
    std::string_view preset;  ///< its name before 2017, without what follows a `_` or `.`
    std::string_view number;  ///< its id in the API
    std::string_view site_id; ///< its id in the site's own JSON; empty where we do not know it
    MediaKind kind;
    int width;
    int height;
    int channels;
    std::optional<NoiseKind> noise; ///< what we can generate in its place
};

/// By the name of its file, in whatever folder: `/media/a/<hash>.png`, `/presets/tex16.png`.
const Media* find_media(std::string_view source);
/// By its id in the API or in the site's own JSON.
const Media* find_media_by_id(std::string_view id);

/// Files of ShaderToy's media under the folder that --media names; an empty folder has none.
class MediaFolder {
public:
    explicit MediaFolder(std::filesystem::path folder);

    /// The file for `source`: under its whole path, then its base name, then by what ShaderToy called it
    /// later or earlier. Empty when there is none.
    std::filesystem::path find(std::string_view source) const;
    /// The six faces +x -x +y -y +z -z (`x.png`, `x_1.png` … `x_5.png`), or one file with all of them when
    /// there are no faces. Empty when there is none.
    std::vector<std::filesystem::path> find_cubemap(std::string_view source) const;

private:
    std::filesystem::path by_name(std::string_view base_name) const;
    std::filesystem::path by_beginning(std::string_view beginning) const;

    std::filesystem::path folder_;
    std::vector<std::filesystem::path> files_; ///< sorted by their name
};

/// What a channel reads instead of what is not to be had.
struct Substitute {
    ChannelInput input;
    std::string name; ///< "a generated picture of 512x512"; empty: it is as good as what it stands for
};
Substitute substitute_for(MediaKind kind, const Media* media);

} // namespace tidemark::scene
