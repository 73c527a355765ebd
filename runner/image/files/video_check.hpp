// Whether a video's file has the length that it speaks of: ffmpeg shows what is there of one that was cut.
// MP4 and MOV, WebM and Matroska, Ogg, GIF and AVI; the others know no length. Reads some bytes, decodes
// nothing.
#pragma once

#include <filesystem>

namespace tidemark::image {

/// True also of what cannot be read or told.
bool is_whole_video(const std::filesystem::path& path);

} // namespace tidemark::image
