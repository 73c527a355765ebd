#include "cli/capture_frames.hpp"

#include "base/encoding.hpp"
#include "base/extent.hpp"
#include "host/json.hpp"
#include "host/scene_report.hpp"
#include "render/frame_state.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace tidemark::cli {

using namespace host;
namespace {

/// Returns the differences of successive frames.
std::vector<int> strides_of(const std::vector<int>& frames) {
    std::vector<int> strides;
    for (size_t i = 1; i < frames.size(); ++i)
        strides.push_back(frames[i] - frames[i - 1]);
    return strides;
}

constexpr int k_gap = 8; ///< pixels
/// Grey of the gaps: neither black nor white, which are common at the edges of scenes.
constexpr uint8_t k_grey = 0x20;
constexpr size_t k_most_cells = 1000;
constexpr int k_most_shards = 1'000'000;
constexpr int k_most_frames_of_time = 10'000'000; ///< as many as --frames may name

/// Returns an opaque grey picture.
image::Image blank(Extent extent, image::SampleType type) {
    image::Image picture(extent, 4, type);
    for (size_t i = 0; i < picture.samples(); ++i) {
        const uint8_t sample = i % 4 == 3 ? 0xff : k_grey;
        if (type == image::SampleType::u8)
            picture.u8()[i] = sample;
        else
            picture.f32()[i] = float(sample) / 255;
    }
    return picture;
}

Result<int> slurm_number(const char* name, std::optional<int> otherwise = {}) {
    const char* const text = std::getenv(name);
    const std::optional<int> number = text ? number_from<int>(text) : otherwise;
    if (!number)
        return fail(ErrorCode::usage,
                    fmt::format("--shard slurm: {} is {}; start this command as a task of `sbatch --array`",
                                name, text ? fmt::format("'{}'", text) : "not set"));
    return *number;
}

Result<Shard> shard_of_slurm() {
    const int id = TRY(slurm_number("SLURM_ARRAY_TASK_ID"));
    const int count = TRY(slurm_number("SLURM_ARRAY_TASK_COUNT"));
    const int first = TRY(slurm_number("SLURM_ARRAY_TASK_MIN", 0));
    const int step = TRY(slurm_number("SLURM_ARRAY_TASK_STEP", 1));
    if (step < 1 || id < first || (id - first) % step != 0 || (id - first) / step >= count)
        return fail(ErrorCode::usage, fmt::format("--shard slurm: task {} does not fit an array of {} tasks "
                                                  "that starts at {}; give --array without gaps, as in 0-7",
                                                  id, count, first));
    return Shard{(id - first) / step, count};
}

} // namespace

std::vector<int> evenly(const std::vector<int>& frames, size_t count) {
    count = std::min(count, frames.size());
    std::vector<int> chosen;
    for (size_t i = 0; i < count; ++i)
        chosen.push_back(frames[count == 1 ? 0 : i * (frames.size() - 1) / (count - 1)]);
    return chosen;
}

std::string counted_frames(size_t count) {
    return fmt::format("{} frame{}", count, count == 1 ? "" : "s");
}

Result<TimePart> part_of(const TimeSpan& span, std::optional<double> default_length) {
    const auto refuse = [](std::string_view why) { return fail(ErrorCode::usage, std::string(why)); };
    const double begin = span.from.value_or(0);
    if (!(begin >= 0) || !std::isfinite(begin))
        return refuse("--from: give a number of seconds from 0 up");
    if (span.to && span.duration)
        return refuse("give --to or --duration, not both");
    if (span.to && !(*span.to > begin && std::isfinite(*span.to)))
        return refuse(fmt::format("--to {}: give a time after the beginning at {} s", *span.to, begin));
    if (span.duration && !(*span.duration > 0 && std::isfinite(*span.duration)))
        return refuse(fmt::format("--duration {}: give a number of seconds above 0", *span.duration));
    if (span.to)
        return TimePart{begin, *span.to - begin};
    if (!span.duration && !default_length)
        return refuse(fmt::format("--from {}: also give --to or --duration", begin));
    return TimePart{begin, span.duration ? *span.duration : *default_length};
}

Result<std::string> frames_in(const TimePart& part, double fps) {
    const double first = std::round(part.begin * fps);
    const double last = std::max(first, std::round((part.begin + part.length) * fps) - 1);
    if (last > render::k_last_frame || last - first >= double(k_most_frames_of_time))
        return fail(
            ErrorCode::usage,
            fmt::format("{} s from {} s on at {} frames per second are too many frames: at most {}, up "
                        "to frame {}",
                        part.length, part.begin, fps, k_most_frames_of_time, render::k_last_frame));
    return fmt::format("{}-{}", int(first), int(last));
}

std::vector<int> beginnings(const TimePart& part, double fps, size_t count) {
    std::vector<int> frames;
    for (size_t i = 0; i < count; ++i)
        frames.push_back(int(std::floor(part.begin * fps + part.length * fps * double(i) / double(count))));
    return frames;
}

VideoPace pace_of(const std::vector<int>& frames, double fps) {
    const std::vector<int> strides = strides_of(frames);
    if (strides.empty())
        return {fps};
    const auto [least, most] = std::ranges::minmax(strides);
    if (least > 0) {
        const int tick = std::reduce(strides.begin(), strides.end(), 0, std::gcd<int, int>);
        return {fps / tick, tick, most > tick};
    }
    if (least == most && least < 0)
        return {fps / -least, 0, false, "its frames are in descending order"};
    return {fps, 0, false, "its frames are not in ascending order; they are shown one after another"};
}

std::vector<int> ticks_of(const std::vector<int>& frames, const VideoPace& pace) {
    std::vector<int> ticks(frames.size(), 1);
    const std::vector<int> strides = strides_of(frames);
    for (size_t i = 0; pace.holds && i < strides.size(); ++i)
        ticks[i] = strides[i] / pace.tick;
    return ticks;
}

Extent SheetGrid::extent(Extent cell) const {
    return {columns * cell.width + (columns - 1) * k_gap, rows * cell.height + (rows - 1) * k_gap};
}

Result<SheetGrid> parse_sheet(std::string_view text) {
    const auto cells = parse_extent(text);
    if (!cells || cells->pixels() > k_most_cells)
        return fail(ErrorCode::usage,
                    fmt::format("--sheet {}: give columns and rows, as in 5x4, at most {} cells", text,
                                k_most_cells));
    return SheetGrid{cells->width, cells->height};
}

void Sheet::add(const image::Image& cell) {
    if (added_ == 0)
        picture_ = blank(grid_.extent(cell.extent), cell.type);
    assert(cell.channels == 4 && cell.type == picture_.type && grid_.extent(cell.extent) == picture_.extent);
    const int column = added_ % grid_.columns, row = added_ / grid_.columns;
    const size_t pixel = 4 * image::size_of(cell.type);
    const int left = column * (cell.extent.width + k_gap);
    const int bottom = (grid_.rows - 1 - row) * (cell.extent.height + k_gap);
    for (int y = 0; y < cell.extent.height; ++y)
        std::copy_n(cell.bytes.begin() + std::ptrdiff_t(size_t(y) * cell.row_bytes()), cell.row_bytes(),
                    picture_.bytes.begin() +
                        std::ptrdiff_t(size_t(bottom + y) * picture_.row_bytes() + size_t(left) * pixel));
    ++added_;
}

Result<Shard> parse_shard(std::string_view text) {
    if (text == "slurm")
        return shard_of_slurm();
    const std::vector<int> numbers = numbers_from<int>(text, '/');
    if (numbers.size() != 2 || numbers[0] < 1 || numbers[0] > numbers[1] || numbers[1] > k_most_shards)
        return fail(ErrorCode::usage,
                    fmt::format("--shard {}: give K/N with K from 1 to N, as in 2/8, or slurm", text));
    return Shard{numbers[0] - 1, numbers[1]};
}

std::vector<int> frames_of(const Shard& shard, const std::vector<int>& frames, const scene::Scene& scene) {
    const auto index = size_t(shard.index);
    const auto count = size_t(shard.count);
    if (may_feed_back(scene)) {
        const auto place = [&](size_t k) {
            return frames.begin() + std::ptrdiff_t(frames.size() * k / count);
        };
        return {place(index), place(index + 1)};
    }
    std::vector<int> own;
    for (size_t i = index; i < frames.size(); i += count)
        own.push_back(frames[i]);
    return own;
}

std::vector<int> segments_of_shard(const Shard& shard, size_t segments, const scene::Scene& scene) {
    std::vector<int> all(segments);
    std::iota(all.begin(), all.end(), 0);
    return frames_of(shard, all, scene);
}

Result<ShardNote> read_note(const std::filesystem::path& file) {
    const std::string text = TRY(read_file(file));
    try {
        const Json json = parse_json(text);
        ShardNote note{json.at("capture").get<std::vector<std::string>>(), json.at("shards").get<int>()};
        if (note.count >= 1 && note.count <= k_most_shards)
            return note;
    } catch (const Json::exception&) { // reported below
    }
    return fail(ErrorCode::load, fmt::format("'{}' was not written by `capture --shard`", file.string()));
}

Result<void> leave_note(const OutputPath& file, const ShardNote& note) {
    std::error_code ignored;
    if (std::filesystem::exists(file.path(), ignored)) {
        if (TRY(read_note(file.path())) == note)
            return {};
        return fail(ErrorCode::usage, fmt::format("--shard: '{}' belongs to another capture: give each "
                                                  "capture its own folder, or remove that file",
                                                  file.string()));
    }
    return write_file(file, dump(Json{{"capture", note.words}, {"shards", note.count}}, 2) + "\n");
}

} // namespace tidemark::cli
