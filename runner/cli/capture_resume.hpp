// What an interrupted capture leaves for `--resume`: the identity of the run, saved states, segments of a
// video, and the frames that are already on disk.
#pragma once

#include "base/error.hpp"
#include "base/file.hpp"
#include "cli/capture_plan.hpp"
#include "host/fingerprint.hpp"
#include "host/frame_files.hpp"
#include "media/video_output.hpp"
#include "render/pass_state.hpp"
#include "render/renderer.hpp"
#include "shader/specialise.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

/// Returns the fingerprint that all frames of a capture share, for no device yet; for a plan of all its
/// frames. Reads the files that the scene reads.
host::Fingerprint identity_of_run(const CapturePlan& plan);

// The state for continuing an interrupted capture: the buffers before a frame, and the program that draws it.
// It is stored next to the frames as `frame_0120.png.state`, written whole or not at all, with a checksum at
// its end.

struct SavedState {
    int frame = 0; ///< the next frame to draw
    glsl::Specialise program = glsl::Specialise::nothing;
    render::BufferState buffers{}; ///< empty: as before frame 0
};

/// The largest buffer that can be saved, in bytes: the most that a driver reads back in one call.
inline constexpr size_t k_largest_saved_buffer = 0x7fffffff;

/// Returns the file of the state before a frame. A video has one file for all.
OutputPath state_file(const host::OutputName& output, int frame);

/// Returns the existing state files of an output, the latest frame first.
std::vector<std::filesystem::path> find_states(const host::OutputName& output);

/// Removes all files that `find_states` finds.
void remove_states(const host::OutputName& output);

/// Reads the state if the file is complete, at most `most_bytes` long, and was written with the fingerprint
/// that `fingerprint_of` returns for its frame. Otherwise only the first line is read.
std::optional<SavedState> read_state(const std::filesystem::path& file,
                                     const std::function<host::Fingerprint(int frame)>& fingerprint_of,
                                     uint64_t most_bytes);

// Saves the states that `--resume` needs, while a capture draws: the chosen program before the first frame,
// and the buffers at regular intervals. The previous state is removed once the next one is on disk.

class StateSaver {
public:
    /// The plan and the renderer must outlive it.
    StateSaver(const CapturePlan& plan, const render::Renderer& renderer)
        : plan_(plan), renderer_(renderer) {}

    /// Saves the result of a trial, which another run might decide differently. Call it before the first
    /// frame.
    Result<void> save_program();
    /// Returns true if the buffers, which are ready for that frame, should be saved.
    bool is_due(int frame) const;
    Result<void> save_buffers(int frame);
    /// Registers the state that the capture was started from, which already exists on disk.
    void found(int frame) { last_ = frame; }

private:
    Result<void> save(const SavedState& state);

    const CapturePlan& plan_;
    const render::Renderer& renderer_;
    std::optional<int> last_{}; ///< frame of the newest state on disk
};

// Writes a video in segments, which lie next to it until they are joined: an interrupted capture loses at
// most one segment.

/// `length`: frames in each segment except the last; 0: the default.
std::vector<VideoSegment> segments_of(const std::vector<int>& frames, const VideoPace& pace, int length);

/// Returns for example `wave.mp4.segment-0003.mp4`.
OutputPath segment_file(const host::OutputName& video, size_t index);

/// Returns the fingerprint that a segment stores as its note.
std::string note_of(const CapturePlan& plan, const VideoSegment& segment);

class SegmentedVideo {
public:
    /// `plan` must outlive it. Starts the first encoder if there is anything to encode. Fails
    /// (ErrorCode::write) while another process makes the same video, or the same shard of it.
    static Result<SegmentedVideo> create(const CapturePlan& plan, Extent extent);

    /// Encodes the next frame of those that are not kept.
    Result<void> push(const image::Image& image);
    /// Drops the current segment.
    void drop() { writer_.reset(); }
    /// Returns the number of frames in segments that this run wrote to disk.
    size_t written() const { return written_; }
    /// Joins the segments, with the WAV file `sound` if it is not empty, and removes them.
    Result<void> finish(const std::filesystem::path& sound);

private:
    SegmentedVideo(const CapturePlan& plan, Extent extent) : plan_(plan), extent_(extent) {}
    Result<void> claim();
    Result<void> open_next();
    Result<void> close();
    image::VideoFormat format() const {
        return {extent_, plan_.video.pace.fps, plan_.video.codec, plan_.encoding.alpha};
    }
    void remove_segments() const;

    const CapturePlan& plan_;
    Extent extent_;
    size_t next_ = 0; ///< the next segment to begin
    size_t written_ = 0;
    size_t pushed_ = 0; ///< frames of the current segment
    std::optional<image::SegmentWriter> writer_;
    std::optional<StagedFile> claim_; ///< marks the video as being made by this process; never committed
};

/// Joins segments that all exist.
Result<void> join(CapturePlan plan, const std::filesystem::path& sound);

// Finds frames of an interrupted capture that are already on disk: `--resume` draws the plan without them. A
// frame is kept if its file is complete and has the fingerprint that it would be drawn with.

struct KeptFrames {
    std::vector<int> frames;       ///< in the order of the plan
    std::vector<std::string> said; ///< messages: the frames that are drawn again, and why
};

/// Removes kept frames from the plan, and marks the kept segments of a video. Changes no file.
KeptFrames leave_out_kept(CapturePlan& plan);

/// Files with the same problem.
struct Wrong {
    std::string what;
    std::string first; ///< file
    size_t count = 0;
};

/// Counts a file with a problem.
void note(std::vector<Wrong>& all, std::string what, const std::string& file);

/// Returns the files of a frame: one picture, or the six faces of a cube.
std::vector<std::filesystem::path> files_of(const host::OutputName& output, int frame);

} // namespace tidemark::cli
