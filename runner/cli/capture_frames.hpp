// Selects frames that represent a sequence or a duration.
#pragma once

#include "base/error.hpp"
#include "base/file.hpp"
#include "media/image.hpp"
#include "scene/scene.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::cli {

/// Returns `count` of the frames, evenly spread, including the first and the last; at most all of them.
std::vector<int> evenly(const std::vector<int>& frames, size_t count);

/// Returns `1 frame`, `2 frames`.
std::string counted_frames(size_t count);

/// The time that a capture covers, in seconds, as --from, --to and --duration give it.
struct TimeSpan {
    std::optional<double> from{};
    std::optional<double> to{};
    std::optional<double> duration{};

    bool given() const { return from || to || duration; }
};

/// A part of the scene's time, in seconds.
struct TimePart {
    double begin = 0;
    double length = 0;
};

/// Returns the part that the options select. Fails (ErrorCode::usage) if its end is not after its beginning,
/// or if it is missing and there is no default length.
Result<TimePart> part_of(const TimeSpan& span, std::optional<double> default_length = {});

/// Returns the frames of a part, without the one at its end, as --frames accepts them: `60-89` for 2 s to 3 s
/// at 30 frames a second. Its ends are rounded to frames; it has at least one.
Result<std::string> frames_in(const TimePart& part, double fps);

/// Returns the frames at which `count` equal parts of that part begin.
std::vector<int> beginnings(const TimePart& part, double fps, size_t count);

// The frame rate of a video, and how long each frame is shown.

struct VideoPace {
    double fps = 60;    ///< ticks a second of the video
    int tick = 1;       ///< frames of the scene per tick; 0: one frame after another, regardless of time
    bool holds = false; ///< some frame is shown for several ticks
    std::string not_in_time{}; ///< why the video does not run in the scene's time; empty: it does
};

/// Chooses the frame rate. Ascending frames are shown at their time, each until the next one; evenly spaced
/// ones, for example `0-118x2`, take one tick each. Other sequences are shown one after another, `fps` a
/// second; evenly descending ones take as long as ascending ones.
VideoPace pace_of(const std::vector<int>& frames, double fps);

/// Returns how many ticks each frame is shown. The last one takes one tick.
std::vector<int> ticks_of(const std::vector<int>& frames, const VideoPace& pace);

// A contact sheet: moments of a scene in one picture, row by row from the top left.

struct SheetGrid {
    int columns = 1;
    int rows = 1;

    size_t cells() const { return size_t(columns) * size_t(rows); }
    /// Returns the size of the sheet for cells of this size, including the gaps.
    Extent extent(Extent cell) const;
};

/// Parses columns and rows, for example `5x4`.
Result<SheetGrid> parse_sheet(std::string_view text);

class Sheet {
public:
    explicit Sheet(SheetGrid grid) : grid_(grid) {}

    /// Adds the next cell; all have the same size and type and four channels.
    void add(const image::Image& cell);
    const image::Image& picture() const { return picture_; }

private:
    SheetGrid grid_;
    int added_ = 0;
    image::Image picture_;
};

// Divides a capture among several processes, on one or several machines: selects the frames of each shard.

struct Shard {
    int index = 0; ///< from 0
    int count = 1;
};

/// Parses `2/8`, counted from 1, or `slurm`: the variables of a Slurm array task (ErrorCode::usage if they
/// are missing).
Result<Shard> parse_shard(std::string_view text);

/// Returns every N-th frame; if the scene has buffers, whose frames may depend on earlier ones, a contiguous
/// run of frames.
std::vector<int> frames_of(const Shard& shard, const std::vector<int>& frames, const scene::Scene& scene);

/// Does the same for segments of a video, counted from 0.
std::vector<int> segments_of_shard(const Shard& shard, size_t segments, const scene::Scene& scene);

// A file that the shards of a capture leave in their folder for `gather`: the arguments of their common
// command.

inline constexpr const char* k_shard_note = "shards.json";

struct ShardNote {
    std::vector<std::string> words; ///< arguments of `tidemark capture`, without --shard, --resume and --json
    int count = 1;

    bool operator==(const ShardNote&) const = default;
};

/// Writes the note. Fails (ErrorCode::usage) if the folder has the note of another capture.
Result<void> leave_note(const OutputPath& file, const ShardNote& note);

/// Reads the note. Fails (ErrorCode::load) if there is none, or if it is not a shard note.
Result<ShardNote> read_note(const std::filesystem::path& file);

} // namespace tidemark::cli
