// A capture that several processes make together, on one machine or on many: which frames are one's own.
#pragma once

#include "base/result.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::cli {

struct Shard {
    int index = 0; ///< from 0
    int count = 1;
};

inline constexpr int k_most_shards = 1'000'000;

/// `2/8`, from 1; `slurm`: what Slurm says to a task of an array (ErrorCode::usage where it says nothing).
Result<Shard> parse_shard(std::string_view text);

/// Every so-manieth frame; of a scene whose passes read passes, which may need the frame before, a run of
/// them.
std::vector<int> frames_of(const Shard& shard, const std::vector<int>& frames, const scene::Scene& scene);

/// The same of so many segments of a video, counted from 0.
std::vector<int> segments_of_shard(const Shard& shard, size_t segments, const scene::Scene& scene);

} // namespace tidemark::cli
