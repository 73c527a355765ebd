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

/// `noise`, `keyboard`, or a file relative to `folder`: picture, sound, video or volume. What names a pass
/// (`self`, `buffer_a`, a shader's file) is Unbound.
ChannelInput input_of_name(std::string_view name, const std::filesystem::path& folder);

/// Whether the name is that of a pass: `self`, `Buffer A`, `blur.glsl`.
bool names_a_pass(std::string_view name);

/// The six faces +x -x +y -y +z -z that fit a name with `*` or `{}` in it, by the first of the extension's
/// sets of suffixes of which all files are there; the name alone when it has neither. Empty: none fits.
std::vector<std::filesystem::path> cubemap_faces(const std::filesystem::path& name);

} // namespace tidemark::scene
