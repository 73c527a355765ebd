// Bytes that can be made again, kept from run to run. A cache is a favour: whatever goes wrong with it,
// nobody hears of it, and what it gives is what was kept or nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tidemark {

/// `$XDG_CACHE_HOME/tidemark`, else `~/.cache/tidemark`. Nothing where `TIDEMARK_CACHE` is `off` or nobody
/// has a home.
std::optional<std::filesystem::path> user_cache_folder();

/// One file for each key in a folder of its own. Several processes may use it at once.
class FileCache {
public:
    /// Holds about `most_bytes`: beyond, what was not asked for the longest goes.
    FileCache(std::filesystem::path folder, uint64_t most_bytes)
        : folder_(std::move(folder)), most_bytes_(most_bytes) {}

    /// What was kept under that key, whole. `key` is a file name.
    std::optional<std::string> find(const std::string& key) const;
    void keep(const std::string& key, std::string_view bytes) const;

private:
    void make_room() const;

    std::filesystem::path folder_;
    uint64_t most_bytes_;
};

} // namespace tidemark
