#include "cli/capture/shard_note.hpp"

#include "base/file.hpp"
#include "base/try.hpp"
#include "cli/capture/shard.hpp"
#include "cli/json_dump.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tidemark::cli {

Result<ShardNote> read_note(const std::filesystem::path& file) {
    const std::string text = TRY(read_file(file));
    try {
        const Json json = parse_json(text);
        ShardNote note{json.at("capture").get<std::vector<std::string>>(), json.at("shards").get<int>()};
        if (note.count >= 1 && note.count <= k_most_shards)
            return note;
    } catch (const Json::exception&) { // reported below
    }
    return fail(ErrorCode::load, fmt::format("'{}' is not of `capture --shard`", file.string()));
}

Result<void> leave_note(const OutputPath& file, const ShardNote& note) {
    std::error_code ignored;
    if (std::filesystem::exists(file.path(), ignored)) {
        if (TRY(read_note(file.path())) == note)
            return {};
        return fail(ErrorCode::usage,
                    fmt::format("--shard: '{}' is of another capture: give a folder of its own, or remove it",
                                file.string()));
    }
    return write_file(file, dump(Json{{"capture", note.words}, {"shards", note.count}}, 2) + "\n");
}

} // namespace tidemark::cli
