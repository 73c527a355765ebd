// Divides a capture among several processes, on one or several machines: selects the frames of each shard.
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

/// Parses `2/8`, counted from 1, or `slurm`: the variables of a Slurm array task (ErrorCode::usage if they
/// are missing).
Result<Shard> parse_shard(std::string_view text);

/// Returns every N-th frame; if the scene has buffers, whose frames may depend on earlier ones, a contiguous
/// run of frames.
std::vector<int> frames_of(const Shard& shard, const std::vector<int>& frames, const scene::Scene& scene);

/// Does the same for segments of a video, counted from 0.
std::vector<int> segments_of_shard(const Shard& shard, size_t segments, const scene::Scene& scene);

} // namespace tidemark::cli
