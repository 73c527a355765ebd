// Names in scenes: passes, ShaderToy's media, inputs of directives and options.
//
// Names of passes: parses the forms used on tabs and files, and writes the standard form.
#pragma once

#include "scene/channel.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::scene {

struct PassName {
    enum class Kind { common, buffer, cubemap, image, sound }; ///< in drawing order
    Kind kind = Kind::image;
    int number = 0; ///< for a buffer: 0 is A

    bool operator==(const PassName&) const = default;
};

/// Parses `Buffer A`, `buf_a`, `BufA`, `Cube A`, `cubemap`, `Image`, `COMMON`: case, blanks, `_` and `-` are
/// ignored.
std::optional<PassName> parse_pass_name(std::string_view name);

/// Returns `Buffer A` for 0.
std::string buffer_name(int number);
/// Returns `Buffer A`, `Image`: the name that pass_names() gives the first pass of a kind.
std::string to_string(const PassName& name);
/// Returns `buffer_a.glsl` for `Buffer A`.
std::string file_name_of(std::string_view pass_name);

/// Returns whether the file's extension is one of shader files: .glsl, .frag, .fs, .txt.
bool is_shader_file(const std::filesystem::path& file);

// ShaderToy's own media: pictures, cubemaps, volumes, videos and music that its projects name by file or by
// number. Holds names and sizes; finds the file of a medium or its substitute, but opens no file.

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

// Resolves the name in a directive or on the command line to a channel's input.

/// Returns the kind by the extension; a file with an unknown one is a picture.
MediaKind media_kind_of(const std::filesystem::path& file);

/// The meaning of a file that its extension does not mark as another kind.
enum class PictureAs { flat, cubemap };

/// Resolves a name in the table of inputs (`noise`, `keyboard`), or a file relative to `folder`: picture or
/// cubemap, sound, video or volume. The name of a pass (`self`, `buffer_a`, a shader file) gives Unbound.
ChannelInput input_of_name(std::string_view name, const std::filesystem::path& folder,
                           PictureAs picture = PictureAs::flat);

/// Returns whether the name is that of a pass: `self`, `Buffer A`, `blur.glsl`.
bool names_a_pass(std::string_view name);

/// Replaces a cubemap's name with `*` or `{}` by its six faces +x -x +y -y +z -z, with the first of the VS
/// Code extension's sets of suffixes for which all files exist. Returns false if there is none.
bool find_faces(ChannelInput& input);

} // namespace tidemark::scene
