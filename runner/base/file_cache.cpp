#include "base/file_cache.hpp"

#include "base/file.hpp"
#include "base/hash.hpp"

#include <algorithm>
#include <cstdlib>
#include <span>
#include <tuple>
#include <vector>

namespace tidemark {
namespace fs = std::filesystem;
namespace {

constexpr size_t k_digest_size = 64;

std::string digest_of(std::string_view bytes) {
    return sha256(std::as_bytes(std::span(bytes)));
}

/// An absolute path that the environment names; the XDG rules want others ignored.
std::optional<fs::path> folder_in(const char* variable) {
    const char* value = std::getenv(variable);
    if (!value || *value != '/')
        return std::nullopt;
    return value;
}

} // namespace

std::optional<fs::path> user_cache_folder() {
    const char* wish = std::getenv("TIDEMARK_CACHE");
    if (wish && std::string_view(wish) == "off")
        return std::nullopt;
    if (const auto folder = folder_in("XDG_CACHE_HOME"))
        return *folder / "tidemark";
    if (const auto home = folder_in("HOME"))
        return *home / ".cache" / "tidemark";
    return std::nullopt;
}

std::optional<std::string> FileCache::find(const std::string& key) const {
    const fs::path path = folder_ / key;
    auto file = read_file(path, most_bytes_);
    if (!file || file->size() < k_digest_size)
        return std::nullopt;
    std::string bytes = file->substr(k_digest_size);
    if (file->compare(0, k_digest_size, digest_of(bytes)) != 0)
        return std::nullopt;
    std::error_code ignored;
    fs::last_write_time(path, fs::file_time_type::clock::now(), ignored); // it was asked for
    return bytes;
}

void FileCache::keep(const std::string& key, std::string_view bytes) const {
    if (bytes.size() > most_bytes_ / 2 || !make_folder(folder_))
        return;
    if (write_file(folder_ / key, digest_of(bytes).append(bytes)))
        make_room();
}

/// Files that a process left half-written go like all others.
void FileCache::make_room() const {
    struct Kept {
        fs::file_time_type asked_for;
        uint64_t size;
        fs::path path;
    };
    std::vector<Kept> files;
    uint64_t total = 0;
    std::error_code error;
    for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
        std::error_code gone; // by another process
        const uint64_t size = entry->file_size(gone);
        const auto time = gone ? fs::file_time_type() : entry->last_write_time(gone);
        if (gone)
            continue;
        files.push_back({time, size, entry->path()});
        total += size;
    }
    std::ranges::sort(files, {}, [](const Kept& kept) { return std::tie(kept.asked_for, kept.path); });
    for (const Kept& oldest : files) {
        if (total <= most_bytes_)
            return;
        std::error_code ignored;
        fs::remove(oldest.path, ignored);
        total -= oldest.size;
    }
}

} // namespace tidemark
