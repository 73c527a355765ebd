#include "base/folders.hpp"

#include "base/encoding.hpp"
#include "base/file.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <system_error>
#include <tuple>
#include <vector>

namespace tidemark {
namespace fs = std::filesystem;

fs::path program_folder() {
    std::error_code ignored;
    return fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

namespace {

fs::path beside_program(const char* name) {
    return program_folder() / name;
}

fs::path installed_folder(const char* name) {
    return (program_folder() / "../share/tidemark" / name).lexically_normal();
}

fs::path beside_or_installed(const char* name) {
    std::error_code ignored;
    fs::path beside = fs::canonical(beside_program(name), ignored);
    return beside.empty() ? installed_folder(name) : beside;
}

constexpr const char* k_library = "shaders/lib";

} // namespace

fs::path library_folder() {
    return beside_or_installed(k_library);
}

fs::path conformance_folder() {
    return beside_or_installed("conformance");
}

std::string why_no_library() {
    std::error_code ignored;
    if (fs::is_directory(library_folder(), ignored))
        return {};
    return fmt::format(
        "tidemark's shader library was found neither in '{}' nor in '{}': install tidemark again",
        beside_program(k_library).string(), installed_folder(k_library).string());
}

ScratchFolder::ScratchFolder() {
    std::error_code failed;
    std::string name = (fs::temp_directory_path(failed) / "tidemark-XXXXXX").string();
    if (::mkdtemp(name.data()))
        path_ = std::move(name);
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty())
        fs::remove_all(path_, ignored);
}

namespace {

constexpr size_t k_digest_size = 64;

/// Includes the key, so that an entry stored under another key is not accepted.
std::string digest_of(std::string_view key, std::string_view bytes) {
    Sha256 hash;
    hash.add(std::as_bytes(std::span(key)));
    hash.add(std::as_bytes(std::span(bytes)));
    return hash.digits();
}

bool is_key(std::string_view name) {
    return name.size() == k_digest_size &&
           name.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// Part of the name of a file while it is written: `.KEY.part-PID-COUNT`.
constexpr std::string_view k_half_written = ".part-";

bool is_ours_by_name(std::string_view name) {
    const bool half = name.starts_with('.');
    name.remove_prefix(half ? 1 : 0);
    return is_key(name.substr(0, k_digest_size)) &&
           (half ? name.substr(k_digest_size).starts_with(k_half_written) : name.size() == k_digest_size);
}

bool is_ours(const struct stat& facts) {
    return facts.st_uid == ::geteuid() && (facts.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

/// Reads the file of that name in the folder; nullopt if it is not a regular file of this user. Never blocks.
std::optional<std::string> read_entry(int folder, const std::string& name, uint64_t largest) {
    const Descriptor file(::openat(folder, name.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    struct stat facts {};
    if (file.get() < 0 || ::fstat(file.get(), &facts) != 0 || !S_ISREG(facts.st_mode) || !is_ours(facts))
        return std::nullopt;
    auto bytes = read_all(file.get(), largest);
    if (!bytes)
        return std::nullopt;
    ::futimens(file.get(), nullptr); // marks it as recently used
    return *std::move(bytes);
}

struct CloseFolder {
    void operator()(DIR* folder) const { ::closedir(folder); }
};

/// Returns the absolute path in an environment variable; the XDG rules say to ignore relative ones.
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
    std::error_code ignored;
    if (const auto home = folder_in("HOME"); home && fs::is_directory(*home, ignored))
        return *home / ".cache" / "tidemark";
    return std::nullopt;
}

/// Returns -1 if others may write to the folder, or if it is a link.
int FileCache::open_folder() const {
    Descriptor folder(::open(folder_.c_str(), O_RDONLY | O_CLOEXEC | O_DIRECTORY | O_NOFOLLOW));
    struct stat facts {};
    if (folder.get() < 0 || ::fstat(folder.get(), &facts) != 0 || !is_ours(facts))
        return -1;
    return folder.release();
}

std::optional<std::string> FileCache::find(const std::string& key) const {
    const Descriptor folder(open_folder());
    if (folder.get() < 0 || !is_key(key))
        return std::nullopt;
    auto entry = read_entry(folder.get(), key, most_bytes_);
    if (!entry || entry->size() < k_digest_size)
        return std::nullopt;
    const std::string digest = entry->substr(0, k_digest_size);
    entry->erase(0, k_digest_size);
    if (digest != digest_of(key, *entry))
        return std::nullopt;
    return entry;
}

void FileCache::keep(const std::string& key, std::string_view bytes) const {
    if (bytes.size() > most_bytes_ / 2 || !is_key(key) || !make_folder(folder_.parent_path()))
        return;
    ::mkdir(folder_.c_str(), 0700);
    const Descriptor folder(open_folder());
    if (folder.get() < 0)
        return;
    static std::atomic<unsigned> count = 0; // two threads may keep the same key
    const std::string half = fmt::format(".{}{}{}-{}", key, k_half_written, ::getpid(), ++count);
    Descriptor file(
        ::openat(folder.get(), half.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600));
    if (file.get() < 0)
        return;
    const std::string entry = digest_of(key, bytes).append(bytes);
    const bool whole = write_all(file.get(), std::as_bytes(std::span(entry))) == 0 && file.close() == 0;
    if (!whole || ::renameat(folder.get(), half.c_str(), folder.get(), key.c_str()) != 0)
        ::unlinkat(folder.get(), half.c_str(), 0);
    else if (key.front() == '0' || entry.size() > most_bytes_ / 64)
        make_room(folder.get()); // looks at all files, which takes longer than to keep this one
}

/// Removes the least recently used files beyond the limit, unfinished ones included, but only files of ours.
void FileCache::make_room(int folder) const {
    struct Kept {
        int64_t asked_for;
        int64_t nanoseconds;
        std::string name;
        uint64_t size;
    };
    const std::unique_ptr<DIR, CloseFolder> entries(
        ::fdopendir(::openat(folder, ".", O_RDONLY | O_CLOEXEC | O_DIRECTORY)));
    std::vector<Kept> files;
    uint64_t total = 0;
    for (const dirent* entry = nullptr; entries && (entry = ::readdir(entries.get()));) {
        struct stat facts {};
        if (!is_ours_by_name(entry->d_name) ||
            ::fstatat(folder, entry->d_name, &facts, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISREG(facts.st_mode) ||
            !is_ours(facts))
            continue;
        files.push_back(
            {facts.st_mtim.tv_sec, facts.st_mtim.tv_nsec, entry->d_name, uint64_t(facts.st_size)});
        total += files.back().size;
    }
    std::ranges::sort(files, {},
                      [](const Kept& kept) { return std::tie(kept.asked_for, kept.nanoseconds, kept.name); });
    for (const Kept& oldest : files) {
        if (total <= most_bytes_)
            return;
        ::unlinkat(folder, oldest.name.c_str(), 0);
        total -= oldest.size;
    }
}

} // namespace tidemark
