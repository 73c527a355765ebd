// Folders: of the program, temporary ones, and the cache.
//
// Locates the program and the files that come with it, in a build folder or as installed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tidemark {

/// Returns the folder of the running program, links resolved.
std::filesystem::path program_folder();

/// Returns the folder of the shader library, which `#include <tidemark/…>` reads: shaders/lib in the
/// program's folder, else the installed one (which may not exist).
std::filesystem::path library_folder();

/// Returns why the library is missing and which folders were searched; empty if it is there.
std::string why_no_library();

/// Returns the folder of the projects that test a device's conformance: conformance in the program's folder,
/// else the installed one (which may not exist).
std::filesystem::path conformance_folder();

// A temporary folder for another program's files. The destructor removes it with its contents.

class ScratchFolder {
public:
    /// Makes a folder that only its owner may open. `path` is empty if it cannot be made.
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

// Best-effort cache from run to run for bytes that can be made again. All errors are ignored; a lookup
// returns exactly the stored bytes or nothing.

/// Returns `$XDG_CACHE_HOME/tidemark`, else `~/.cache/tidemark`; nullopt if `TIDEMARK_CACHE` is `off` or
/// without a home folder.
std::optional<std::filesystem::path> user_cache_folder();

/// One file per key in a folder of its own, which the first `keep` makes. A folder that is a link or that
/// others may write to is not used. Links, pipes, other users' files and files with other names in it are
/// left alone. Several processes may use it at once.
class FileCache {
public:
    /// Holds about `most_bytes`; beyond that the least recently used entries are removed, but not at each
    /// small entry: a quarter more may be held for a while.
    FileCache(std::filesystem::path folder, uint64_t most_bytes)
        : folder_(std::move(folder)), most_bytes_(most_bytes) {}

    /// Returns the bytes stored under the key; nullopt if there are none or they are damaged. A key is a
    /// SHA-256 as returned by `sha256`.
    std::optional<std::string> find(const std::string& key) const;
    void keep(const std::string& key, std::string_view bytes) const;

private:
    int open_folder() const;
    void make_room(int folder) const;

    std::filesystem::path folder_;
    uint64_t most_bytes_;
};

} // namespace tidemark
