// Files of frames: their names, existing sequences, and writing them on worker threads.
//
// File names for frames: `out/wave.%04d.png`, `out/wave.####.png`, one name for one picture or a video, and
// `sky_{}.png` for the six faces of a cube.
#pragma once

#include "base/error.hpp"
#include "base/file.hpp"
#include "media/image.hpp"
#include "media/picture_file.hpp"

#include <array>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace tidemark::host {

/// Names of the cube's faces, in OpenGL's order.
inline constexpr std::array<std::string_view, 6> k_face_names{"px", "nx", "py", "ny", "pz", "nz"};

class OutputName {
public:
    /// Parses `pattern`, which holds at most one frame number: `%d`, `%04d`, or two or more `#` (one
    /// digit each); `%%` is a percent sign, and a single `#` is a character. Fails (ErrorCode::usage) on an
    /// unknown file format or form of number, and on several frames with one name. `option` precedes the
    /// pattern in the error.
    static Result<OutputName> parse(std::string_view pattern, size_t frame_count,
                                    std::string_view option = "-o ");

    /// Returns the default name for a scene: `wave.png`, or `wave.0007.png` for several frames. Pattern
    /// characters in the scene's name stand for themselves.
    static OutputName of_scene(const std::filesystem::path& scene, size_t frame_count);

    OutputPath of_frame(int frame) const;
    /// Replaces `{}` by px, nx, py, ny, pz or nz, as in the names of cubemaps that scenes read.
    OutputPath of_face(int frame, size_t face) const;
    /// True for `-`: raw frames on standard output.
    bool standard_output() const { return standard_output_; }
    /// True if the name of a picture has a frame number.
    bool numbered() const { return numbered_; }
    /// True if all frames go into one file.
    bool video() const { return video_; }
    /// True if a picture's name contains `{}`: each face of a cube is one file.
    bool six_faces() const { return six_faces_; }
    const std::filesystem::path& pattern() const { return pattern_; }
    /// Sets the files that are read and must not be replaced.
    void spare(std::vector<std::filesystem::path> files) { spared_ = std::move(files); }
    /// Marks the name as read from a file: at most its folder was typed by the user, so a symbolic link at
    /// the name is not followed.
    void came_from_a_file();

private:
    OutputPath output_of(const std::string& name) const;

    std::filesystem::path pattern_;
    std::string before_;
    std::string after_;
    int digits_ = 0;
    bool numbered_ = false;
    bool standard_output_ = false;
    bool video_ = false;
    bool six_faces_ = false;
    /// Offset of the first part of the name that the user did not type literally; npos: none.
    size_t chosen_from_ = std::string::npos;
    std::vector<std::filesystem::path> spared_;
};

/// Returns the scene's name with this ending, at most as long as a file name may be (255 bytes).
std::string name_after_scene(const std::filesystem::path& scene, std::string_view ending);

// Finds existing pictures: one file, or all files of a numbered sequence.

class OutputName;

/// Returns the frame number in a file's name, if the name fits the pattern: one of its runs of digits.
std::optional<int> frame_of(const std::filesystem::path& file, const OutputName& pattern);

/// By frame number, ascending; a single file has the key nullopt.
using Sequence = std::map<std::optional<int>, std::filesystem::path>;

/// Finds the files of `name`: one file, or all existing files of `wave.%04d.png` or `wave.####.png`. Fails
/// (ErrorCode::load) if there is none, and (ErrorCode::usage) on an unknown pattern.
Result<Sequence> find_sequence(std::string_view name);

// Encodes frames on worker threads while the next ones are drawn. The queue of waiting frames is bounded, and
// so is the memory for it.

struct FrameFile {
    int frame = 0;
    OutputPath output;
    image::Image image;
    image::PictureFormat format;
    std::vector<image::PictureLayer> layers{}; ///< written instead of `image`, for a file with several layers
};

class FrameWriter {
public:
    /// `waiting`: the largest number of frames that no worker has taken yet.
    FrameWriter(unsigned workers, unsigned waiting);
    explicit FrameWriter(unsigned workers) : FrameWriter(workers, workers + 1) {}
    ~FrameWriter();
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;

    /// Queues a frame; waits while the queue is full. Returns false once a frame could not be written: the
    /// remaining ones need not be drawn.
    bool push(FrameFile frame);

    /// Waits until all queued frames are written; returns false once one could not be.
    bool drain();

    /// Returns the number of pictures written so far.
    size_t written();

    /// Waits for all frames; returns the error of the earliest frame that failed.
    Result<void> finish();

private:
    void work();
    /// Writes a frame with the lock released.
    void write(const FrameFile& frame, std::unique_lock<std::mutex>& lock);

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<FrameFile> queue_;
    size_t capacity_;
    size_t written_ = 0;
    size_t writing_ = 0; ///< frames that workers are writing
    bool closed_ = false;
    std::vector<std::pair<int, Error>> errors_;
    std::vector<std::thread> workers_;
};

} // namespace tidemark::host
