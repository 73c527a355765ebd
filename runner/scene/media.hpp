// ShaderToy's own media: pictures, cubemaps, volumes, videos and music that its projects name by file or by
// number. Holds names and sizes; finds the file of a medium or its substitute, but opens no file.
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
    std::string_view hash;    ///< beginning of its file name under /media/a
    std::string_view preset;  ///< its name before 2017, up to the first `_` or `.`
    std::string_view number;  ///< its id in the API
    std::string_view site_id; ///< its id in the site's own JSON; empty if unknown
    MediaKind kind;
    int width;
    int height;
    int channels;
    std::optional<NoiseKind> noise; ///< the generated texture that replaces it
};

/// Finds a medium by its file name, in any folder: `/media/a/<hash>.png`, `/presets/tex16.png`.
const Media* find_media(std::string_view source);
/// Finds a medium by its id in the API or in the site's own JSON.
const Media* find_media_by_id(std::string_view id);

/// Files of ShaderToy's media under the --media folder; none if `folder` is empty.
class MediaFolder {
public:
    explicit MediaFolder(std::filesystem::path folder);

    /// Finds the file for `source`: first by its whole path, then by its base name, then by the name that
    /// ShaderToy gave it later or earlier. Empty if there is none.
    std::filesystem::path find(std::string_view source) const;
    /// Returns the six faces +x -x +y -y +z -z (`x.png`, `x_1.png` … `x_5.png`), or one file with all of them
    /// if only the first face file exists. Empty if none exists.
    std::vector<std::filesystem::path> find_cubemap(std::string_view source) const;

private:
    std::filesystem::path by_name(std::string_view base_name) const;
    std::filesystem::path by_beginning(std::string_view beginning) const;

    std::filesystem::path folder_;
    std::vector<std::filesystem::path> files_; ///< sorted by file name
};

/// An input in place of a medium whose file is missing.
struct Substitute {
    ChannelInput input;
    std::string name; ///< "a generated picture of 512x512"; empty: equivalent to the original
};
Substitute substitute_for(MediaKind kind, const Media* media);

} // namespace tidemark::scene
