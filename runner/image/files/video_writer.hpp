// Videos out: frames go to ffmpeg as they are drawn, segment by segment, each whole or not at all; segments
// are joined to a video without being decoded.
#pragma once

#include "base/child_process.hpp"
#include "base/file.hpp"
#include "base/result.hpp"
#include "image/image.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace tidemark::image {

/// The most frames a second that a GIF can show: it counts in hundredths, and viewers slow one hundredth
/// down.
inline constexpr double k_fastest_gif = 50;

/// Whether the name is one of a video: `.mp4`, `.webm`, `.mov`, `.gif`, `.webp`.
bool is_video_name(const std::filesystem::path& path);

struct VideoFormat {
    Extent extent;
    double fps = 60;
};

/// One segment, which begins with a frame of its own and depends on no other.
class SegmentWriter {
public:
    /// Starts ffmpeg. `video`: what the segment is to become a part of. Fails (ErrorCode::write) when it is
    /// not installed, naming the package.
    static Result<SegmentWriter> create(const OutputPath& segment, const std::filesystem::path& video,
                                        const VideoFormat& format);

    /// RGBA8, alpha ignored. Waits while the encoder is busy. ErrorCode::write has the encoder's last words.
    Result<void> push(const Image& image);
    /// Waits for the encoder, puts `note` behind the pictures and moves the file to its place. Without it
    /// nothing is left behind.
    Result<void> finish(std::string_view note);

private:
    SegmentWriter(std::filesystem::path video, StagedFile staged, ChildProcess encoder)
        : video_(std::move(video)), staged_(std::move(staged)), encoder_(std::move(encoder)) {}

    std::filesystem::path video_;
    StagedFile staged_;
    ChildProcess encoder_;
    std::string words_;
};

struct SegmentFile {
    std::filesystem::path path;
    size_t frames = 0;
};

/// The note of a segment that is whole; nothing where it is not, or is none of ours.
std::optional<std::string> note_of_segment(const std::filesystem::path& segment);

/// `sound`: a WAV file to go with it; empty: silent. Whole or not at all (ErrorCode::write).
Result<void> join_segments(const OutputPath& video, std::span<const SegmentFile> segments, double fps,
                           const std::filesystem::path& sound);

} // namespace tidemark::image
