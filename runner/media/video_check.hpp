// Checks that a video's file is as long as it declares, because ffmpeg plays the rest of a truncated file
// without an error. Handles MP4 and MOV, WebM and Matroska, Ogg, GIF and AVI; other formats do not declare a
// length. Reads some bytes, decodes nothing.
#pragma once

#include <filesystem>
#include <string_view>

namespace tidemark::image {

/// Returns whether the video is complete; also true for unreadable files and other formats.
bool is_whole_video(const std::filesystem::path& path);

/// Returns whether the file is complete and of the format that ffmpeg calls `mp4`, `mov`, `matroska`, `webm`,
/// `gif` or `webp`. MP4 and MOV must contain an index (`moov`).
bool is_video_of(const std::filesystem::path& path, std::string_view muxer);

} // namespace tidemark::image
