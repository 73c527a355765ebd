// Bytes that can be made again, kept from run to run. A cache is a favour: whatever goes wrong with it,
// nobody hears of it, and what it gives is what was kept or nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tidemark {

/// `$XDG_CACHE_HOME/tidemark`, else `~/.cache/tidemark`. Nothing where `TIDEMARK_CACHE` is `off` or there is
/// no home.
std::optional<std::filesystem::path> user_cache_folder();

/// One file for each key in a folder of its own, which is made when there is something to keep. A folder that
/// others may write to, or that is a link, is left alone; so is what does not look like ours in it: links,
/// pipes, other people's files, files with other names. Several processes may use it at once.
class FileCache {
public:
    /// Holds about `most_bytes`: beyond, what was not asked for the longest goes.
    FileCache(std::filesystem::path folder, uint64_t most_bytes)
        : folder_(std::move(folder)), most_bytes_(most_bytes) {}

    /// What was kept under that very key, whole. A key is a SHA-256 as `sha256` writes it.
    std::optional<std::string> find(const std::string& key) const;
    void keep(const std::string& key, std::string_view bytes) const;

private:
    int open_folder() const;
    void make_room(int folder) const;

    std::filesystem::path folder_;
    uint64_t most_bytes_;
};

} // namespace tidemark
