// Files: descriptors, paths of outputs, reading and writing whole files.
//
// POSIX file descriptors: an owning type, and functions that read or write whole contents. Errors are errno
// values.
#pragma once

#include "base/error.hpp"
#include "base/supervision.hpp"

#include <tl/expected.hpp>

#include <concepts>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace tidemark {

/// Owns a file descriptor; -1 means none.
class Descriptor {
public:
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { (void)close(); }

    int get() const { return fd_; }
    int release();
    /// Closes now and returns the errno value that the destructor ignores, 0 for none.
    int close();

private:
    int fd_;
};

/// Reads from the current position to the end. Stops and fails with EFBIG if there are more than `largest`
/// bytes.
tl::expected<std::string, int> read_all(int fd, size_t largest);

/// Writes all bytes; returns 0 or the errno of the first write that failed. Waits even if the descriptor does
/// not block.
int write_all(int fd, std::span<const std::byte> bytes);

// The path of an output: how much of it the user named, and which files it must not replace. Links in the
// part that the user named are followed. Links in the rest are refused, since the folder may belong to
// another user. Makes and opens nothing.

class OutputPath;
template <class Path>
concept PlainPath = std::constructible_from<std::filesystem::path, Path> &&
    !std::same_as<std::remove_cvref_t<Path>, OutputPath>;

class OutputPath {
public:
    OutputPath() = default;
    /// Makes a path whose last part the program chose: the user named only its folder.
    template <PlainPath Path>
    OutputPath(Path&& path) // NOLINT(bugprone-forwarding-reference-overload): of no OutputPath
        : whole_(std::forward<Path>(path)), chosen_parts_(1) {}
    /// Makes a path that the user typed, including its last part.
    static OutputPath typed(std::filesystem::path path);
    /// Returns the typed path, or the program's choice if none was typed.
    static OutputPath typed_or(const std::filesystem::path& typed, std::filesystem::path choice);

    /// Returns a path in this folder; the program chose the name.
    OutputPath operator/(const std::filesystem::path& name) const;
    /// Returns a path in the same folder, this one with `ending` appended; the program chose the name.
    OutputPath beside(std::string_view ending) const;
    /// Returns this path with input files that it, and paths made from it, must not replace.
    OutputPath sparing(const std::vector<std::filesystem::path>& files) const;

    const std::filesystem::path& path() const { return whole_; }
    std::string string() const { return whole_.string(); }
    bool empty() const { return whole_.empty(); }

    /// The resolved destination.
    struct Place {
        std::filesystem::path path{}; ///< its last part is not a link, unless `descriptor` is set
        /// the descriptor of this process that the path names: `/dev/stdout`
        std::optional<int> descriptor{};
        bool stream = false; ///< a device, a pipe or such a descriptor: written to directly
    };
    /// Resolves the destination. Fails (ErrorCode::write) on a link that the user did not name, and on a file
    /// that must not be replaced.
    Result<Place> place() const;
    /// Checks only the links, as `place` does.
    Result<void> check_links() const;

private:
    Result<void> check_spared(const std::filesystem::path& final_path) const;

    std::filesystem::path whole_;
    size_t chosen_parts_ = 0; ///< number of parts at the end of `whole_` that the program chose
    std::vector<std::filesystem::path> spared_;
};

// Reads and writes whole files. Reading explains what is wrong with a path; writing makes a file appear whole
// or not at all. Does not interpret the bytes.

/// Largest text that is read as a scene, in bytes: ten times the largest known shader. Its tokens take up to
/// fifty times as much memory.
inline constexpr size_t k_largest_text = size_t{16} << 20;

/// Returns why the path does not name a regular file, such as "it is a directory" or "Too many levels of
/// symbolic links"; empty if it does, even if the file is unreadable. Opens nothing.
std::string why_unreadable(const std::filesystem::path& path);

/// Reads a regular file. Fails (ErrorCode::load) on a missing file, a directory, an unreadable file or one
/// larger than `largest` bytes, which is not read; the message names the path. Never blocks.
Result<std::string> read_file(const std::filesystem::path& path, size_t largest = k_largest_text);

/// Like read_file, but fails on binary data, that is, if there is a NUL byte.
Result<std::string> read_text_file(const std::filesystem::path& path);

/// A file under construction in the folder of its final path. Its temporary name keeps the extension;
/// `commit` moves it to the final name. It is removed if it is dropped without a commit, or if a signal ends
/// the process. For a device or a pipe, which are never replaced, it lies in the temporary folder, and
/// `commit` copies it.
class StagedFile {
public:
    /// Creates it empty (ErrorCode::write, also from OutputPath::place). `extension` replaces the output's.
    /// Also removes the files that killed processes left for the same output, once per process and output.
    static Result<StagedFile> create(const OutputPath& output, std::string_view extension = {});
    /// Removes again the files that killed processes left for this output, since a process may die slowly. It
    /// is unknown whether a process of another machine still runs: pass `all` only if none does.
    enum class Machines { ours, all };
    static void remove_abandoned(const OutputPath& output, Machines machines = Machines::ours);
    struct Maker {
        pid_t process;
        bool ends; ///< it was killed, or has ended while a program that it was starting keeps the file open
    };
    /// Returns the process that has a file of this very output under construction, other than this one.
    static std::optional<Maker> other_maker_of(const OutputPath& output);
    StagedFile(StagedFile&& other) noexcept;
    StagedFile& operator=(StagedFile&&) = delete;
    StagedFile(const StagedFile&) = delete;
    StagedFile& operator=(const StagedFile&) = delete;
    ~StagedFile();

    const std::filesystem::path& path() const { return temporary_; }
    /// Fails (ErrorCode::write) if the file or its folder was removed or renamed.
    Result<void> check_is_there() const;
    /// Open for reading and writing until `commit`; this object owns it.
    int descriptor() const { return descriptor_; }
    Result<void> write(std::span<const std::byte> bytes);
    Result<void> commit();

private:
    StagedFile(OutputPath output, OutputPath::Place place)
        : output_(std::move(output)), place_(std::move(place)) {}
    Result<void> open(const std::filesystem::path& folder, const std::string& stem,
                      const std::string& extension);

    OutputPath output_;
    OutputPath::Place place_;
    std::filesystem::path temporary_;
    int descriptor_ = -1;
    Leftover leftover_;
};

/// Writes the whole file or leaves the old one (ErrorCode::write, naming the path and the reason). Writes
/// directly to a device or a pipe; fails if a pipe has no reader for 10 s.
Result<void> write_file(const OutputPath& output, std::span<const std::byte> bytes);
Result<void> write_file(const OutputPath& output, std::string_view text);

/// Replaces the text of a user's file, which keeps its mode, its owner and its hard links. Fails
/// (ErrorCode::write) and changes nothing if its bytes are no longer `before`, or if it is read-only.
Result<void> replace_text(const OutputPath& output, std::string_view before, std::string_view after);

/// Checks, before long work, whether `write_file` could start to write (ErrorCode::write). Leaves no file.
Result<void> check_writable(const OutputPath& output);

/// Makes the folder and its missing parents (ErrorCode::write, naming the folder and the reason, or a link
/// that the user did not name).
Result<void> make_folder(const OutputPath& folder);

} // namespace tidemark
