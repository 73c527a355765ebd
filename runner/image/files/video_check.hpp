// Whether a video's file has the length that it speaks of: ffmpeg shows what is there of one that was cut.
// MP4 and MOV, WebM and Matroska, Ogg, GIF and AVI; the others know no length. Reads some bytes, decodes
// nothing.
#pragma once

#include <filesystem>
#include <string_view>

namespace tidemark::image {

/// True also of what cannot be read or told.
bool is_whole_video(const std::filesystem::path& path);

/// Whether the file is whole and of the kind that ffmpeg calls so: `mp4`, `mov`, `matroska`, `webm`, `gif`,
/// `webp`. Of MP4 and MOV it must say where its pictures are.
bool is_video_of(const std::filesystem::path& path, std::string_view muxer);

} // namespace tidemark::image
