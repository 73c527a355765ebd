#include "cli/capture/shard.hpp"

#include "base/try.hpp"
#include "cli/scene_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <numeric>

namespace tidemark::cli {
namespace {

/// Parses the whole text as an integer.
std::optional<int> number_in(std::string_view text) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

Result<int> slurm_number(const char* name, std::optional<int> otherwise = {}) {
    const char* const text = std::getenv(name);
    const std::optional<int> number = text ? number_in(text) : otherwise;
    if (!number)
        return fail(ErrorCode::usage,
                    fmt::format("--shard slurm: {} is {}; start it as a task of `sbatch --array`", name,
                                text ? fmt::format("'{}'", text) : "not set"));
    return *number;
}

Result<Shard> shard_of_slurm() {
    const int id = TRY(slurm_number("SLURM_ARRAY_TASK_ID"));
    const int count = TRY(slurm_number("SLURM_ARRAY_TASK_COUNT"));
    const int first = TRY(slurm_number("SLURM_ARRAY_TASK_MIN", 0));
    const int step = TRY(slurm_number("SLURM_ARRAY_TASK_STEP", 1));
    if (step < 1 || id < first || (id - first) % step != 0 || (id - first) / step >= count)
        return fail(ErrorCode::usage,
                    fmt::format("--shard slurm: task {} of {} from {} on: give --array as 0-7, without gaps",
                                id, count, first));
    return Shard{(id - first) / step, count};
}

} // namespace

Result<Shard> parse_shard(std::string_view text) {
    if (text == "slurm")
        return shard_of_slurm();
    const size_t slash = std::min(text.find('/'), text.size());
    const auto number = number_in(text.substr(0, slash));
    const auto count = number_in(text.substr(std::min(slash + 1, text.size())));
    if (!number || !count || *number < 1 || *number > *count || *count > k_most_shards)
        return fail(ErrorCode::usage,
                    fmt::format("--shard {}: give K/N, K from 1 to N, as in 2/8, or slurm", text));
    return Shard{*number - 1, *count};
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

} // namespace tidemark::cli
