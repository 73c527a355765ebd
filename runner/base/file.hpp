// Reads and writes whole files. Reading explains what is wrong with a path; writing makes a file appear whole
// or not at all. Does not interpret the bytes.
#pragma once

#include "base/leftovers.hpp"
#include "base/output_path.hpp"
#include "base/result.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace tidemark {

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
    /// Returns a running process that has a file of this very output under construction, other than this one;
    /// 0 if there is none.
    static pid_t other_maker_of(const OutputPath& output);
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
