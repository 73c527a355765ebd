// Videos out: frames go to ffmpeg as they are drawn, and the file appears whole or not at all.
#pragma once

#include "base/file.hpp"
#include "base/result.hpp"
#include "image/files/child_process.hpp"
#include "image/image.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace tidemark::image {

/// The most frames a second that a GIF can show: it counts in hundredths, and viewers slow one hundredth
/// down.
inline constexpr double k_fastest_gif = 50;

/// Whether the name is one of a video: `.mp4`, `.webm`, `.gif`.
bool is_video_name(const std::filesystem::path& path);

struct VideoFormat {
    Extent extent;
    double fps = 60;
    std::filesystem::path sound{}; ///< a WAV file to go with it; empty: silent
};

/// H.264 (with AAC) in .mp4, VP9 (with Opus) in .webm; colours as BT.709. A GIF has a palette for each frame.
class VideoWriter {
public:
    /// Starts ffmpeg. Fails (ErrorCode::write) when it is not installed, naming the package.
    static Result<VideoWriter> create(const OutputPath& output, const VideoFormat& format);

    /// RGBA8, alpha ignored. Waits while the encoder is busy. ErrorCode::write has the encoder's last words.
    Result<void> push(const Image& image);
    /// Waits for the encoder and moves the file to its place. Without it nothing is left behind.
    Result<void> finish();

private:
    VideoWriter(std::filesystem::path path, StagedFile staged, ChildProcess encoder)
        : path_(std::move(path)), staged_(std::move(staged)), encoder_(std::move(encoder)) {}
    tl::unexpected<Error> failure() const;

    std::filesystem::path path_;
    StagedFile staged_;
    ChildProcess encoder_;
    std::string words_;
};

} // namespace tidemark::image
