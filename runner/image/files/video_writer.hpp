// Videos out: frames go to ffmpeg as they are drawn, segment by segment, each whole or not at all; segments
// are joined to a video without being decoded.
#pragma once

#include "base/child_process.hpp"
#include "base/file.hpp"
#include "base/result.hpp"
#include "image/files/picture_file.hpp"
#include "image/image.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::image {

/// The most frames a second that a GIF can show: it counts in hundredths, and viewers slow one hundredth
/// down.
inline constexpr double k_fastest_gif = 50;

/// Whether the name is one of a video: `.mp4`, `.mkv`, `.webm`, `.mov`, `.gif`, `.webp`.
bool is_video_name(const std::filesystem::path& path);

/// The codecs that a video of that name may have, as `--codec` names them, its own first: of `.mp4` h264,
/// hevc, av1; of a `.gif` none.
std::vector<std::string_view> codecs_of(const std::filesystem::path& path);

/// Whether a video of that name and codec (empty: its own) has 10 bits a sample; else it has 8.
bool has_ten_bits(const std::filesystem::path& path, std::string_view codec);

/// Whether a video of that name and codec (empty: its own) may hold alpha in that way: .webp and VP9
/// straight, .mov in both.
bool video_holds_alpha(const std::filesystem::path& path, std::string_view codec, Alpha alpha);

/// Of the segments of a video of that name: `.mp4`, or `.mov`.
std::string_view segment_extension(const std::filesystem::path& video);

struct VideoFormat {
    Extent extent;
    double fps = 60;
    std::string codec{};               ///< empty: that which the name says
    Alpha alpha = Alpha::where_needed; ///< that: none
};

/// One segment, which begins with a frame of its own and depends on no other.
class SegmentWriter {
public:
    /// Starts ffmpeg. `video`: what the segment is to become a part of. Fails (ErrorCode::write) when it is
    /// not installed, naming the package, or lacks the codec.
    static Result<SegmentWriter> create(const OutputPath& segment, const std::filesystem::path& video,
                                        const VideoFormat& format);

    /// Of four channels, in bytes or floats. Waits while the encoder is busy. ErrorCode::write has the
    /// encoder's last words.
    Result<void> push(const Image& image);
    /// Waits for the encoder, puts `note` behind the pictures and moves the file to its place. Without it
    /// nothing is left behind.
    Result<void> finish(std::string_view note);

private:
    SegmentWriter(std::filesystem::path video, bool ten_bits, Alpha alpha, StagedFile staged,
                  ChildProcess encoder)
        : video_(std::move(video)), ten_bits_(ten_bits), alpha_(alpha), staged_(std::move(staged)),
          encoder_(std::move(encoder)) {}

    std::filesystem::path video_;
    bool ten_bits_;
    Alpha alpha_;
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
Result<void> join_segments(const OutputPath& video, std::span<const SegmentFile> segments,
                           const VideoFormat& format, const std::filesystem::path& sound);

} // namespace tidemark::image
