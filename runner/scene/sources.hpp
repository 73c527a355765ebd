// What kind of input a file is, by its name.
#pragma once

#include "scene/channel.hpp"
#include "scene/media.hpp"

#include <filesystem>

namespace tidemark::scene {

/// By the extension; what has none that we know is a picture.
MediaKind media_kind_of(const std::filesystem::path& file);

/// A file as an input.
ChannelInput input_of_file(std::filesystem::path file);

} // namespace tidemark::scene
