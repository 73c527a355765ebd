// What the shards of a capture leave in their folder for `gather`: the words of the command that all of them
// were started with.
#pragma once

#include "base/output_path.hpp"
#include "base/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tidemark::cli {

inline constexpr const char* k_shard_note = "shards.json";

struct ShardNote {
    std::vector<std::string> words; ///< behind `tidemark capture`, without --shard and --resume
    int count = 1;

    bool operator==(const ShardNote&) const = default;
};

/// Fails (ErrorCode::usage) where the folder has the note of another capture.
Result<void> leave_note(const OutputPath& file, const ShardNote& note);

/// Fails (ErrorCode::load) where there is none, or it is none of ours.
Result<ShardNote> read_note(const std::filesystem::path& file);

} // namespace tidemark::cli
