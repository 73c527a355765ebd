// What a channel reads, by the name that a directive or the command line gives.
#pragma once

#include "scene/channel.hpp"
#include "scene/media.hpp"

#include <filesystem>
#include <string_view>
#include <vector>

namespace tidemark::scene {

/// By the extension; what has none that we know is a picture.
MediaKind media_kind_of(const std::filesystem::path& file);

/// What a file is that no extension says to be something else.
enum class PictureAs { flat, cubemap };

/// A name of the table of inputs (`noise`, `keyboard`), or a file relative to `folder`: picture or cubemap,
/// sound, video or volume. What names a pass (`self`, `buffer_a`, a shader's file) is Unbound.
ChannelInput input_of_name(std::string_view name, const std::filesystem::path& folder,
                           PictureAs picture = PictureAs::flat);

/// Whether the name is that of a pass: `self`, `Buffer A`, `blur.glsl`.
bool names_a_pass(std::string_view name);

/// Puts the six faces +x -x +y -y +z -z that fit a cubemap's name with `*` or `{}` in its place, by the first
/// of the extension's sets of suffixes of which all files are there. False: none fits.
bool find_faces(ChannelInput& input);

} // namespace tidemark::scene
