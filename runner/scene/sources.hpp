// Resolves the name in a directive or on the command line to a channel's input.
#pragma once

#include "scene/channel.hpp"
#include "scene/media.hpp"

#include <filesystem>
#include <string_view>
#include <vector>

namespace tidemark::scene {

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
