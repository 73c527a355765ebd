// Writes videos: sends frames to ffmpeg as they are drawn, in segments, each of which is written whole or not
// at all; then joins the segments, in most formats without decoding them.
#pragma once

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/process.hpp"
#include "media/image.hpp"
#include "media/picture_file.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::image {

/// The highest frame rate of a GIF: it counts hundredths of a second, and viewers slow down one hundredth.
inline constexpr double k_fastest_gif = 50;

/// Returns whether the name is one of a video: `.mp4`, `.mkv`, `.webm`, `.mov`, `.gif`, `.webp`.
bool is_video_name(const std::filesystem::path& path);

/// Returns the codecs for a video of that name, as `--codec` names them, the default first: for `.mp4` h264,
/// hevc, av1; for a `.gif` none.
std::vector<std::string_view> codecs_of(const std::filesystem::path& path);

/// Returns whether a video of that name and codec (empty: the default) has 10 bits per sample; otherwise 8.
bool has_ten_bits(const std::filesystem::path& path, std::string_view codec);

/// Returns whether a video of that name and codec (empty: the default) can hold alpha in that way: .webp and
/// VP9 straight, .mov in both.
bool video_holds_alpha(const std::filesystem::path& path, std::string_view codec, Alpha alpha);

/// Returns whether a video of that name and codec (empty: the default) has colours at full resolution (4:4:4)
/// if a side is odd.
bool odd_sides_keep_colours(const std::filesystem::path& path, std::string_view codec);

/// Returns the file extension of the segments of a video of that name: `.mp4`, or `.mov`.
std::string_view segment_extension(const std::filesystem::path& video);

/// Returns a frame rate as ffmpeg reads it: the exact fraction for 1000/1001 of a whole number, as in
/// 24000/1001, otherwise the number.
std::string rate_word(double fps);

struct VideoFormat {
    Extent extent;
    double fps = 60;
    std::string codec{};               ///< empty: the default of the name
    Alpha alpha = Alpha::where_needed; ///< where_needed: none
};

/// Writes one segment, which starts with a key frame and depends on no other.
class SegmentWriter {
public:
    /// Starts ffmpeg. `video`: the video that the segment is part of. Fails (ErrorCode::write) when ffmpeg is
    /// not installed (the error names the package) or lacks the codec.
    static Result<SegmentWriter> create(const OutputPath& segment, const std::filesystem::path& video,
                                        const VideoFormat& format);

    /// Adds a frame of four channels, in bytes or floats. Waits while the encoder is busy. Fails
    /// (ErrorCode::write) with the encoder's last message.
    Result<void> push(const Image& image);
    /// Waits for the encoder, appends `note` to the file and moves it to its place. Without this call no file
    /// remains.
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

/// Returns the note of a complete segment; nothing if it is incomplete or not ours.
std::optional<std::string> note_of_segment(const std::filesystem::path& segment);

/// Joins segments to a video, written whole or not at all (ErrorCode::write). `sound`: a WAV file to add;
/// empty: silent.
Result<void> join_segments(const OutputPath& video, std::span<const SegmentFile> segments,
                           const VideoFormat& format, const std::filesystem::path& sound);

// Stores a text at the end of an .mp4 or .mov, in a box that players skip, with a checksum of the whole file.

/// Returns the bytes to append to `video` so that `note_at_end` finds the note.
std::string note_box(std::string_view video, std::string_view note);

/// Returns the note; nothing if there is none, or the checksum does not match.
std::optional<std::string> note_at_end(std::string_view file);

} // namespace tidemark::image
