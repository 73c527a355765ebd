// Whole files in and out. Reading says what is wrong with a path; writing makes a file appear whole or
// not at all. Knows nothing of what the bytes mean.
#pragma once

#include "base/leftovers.hpp"
#include "base/output_path.hpp"
#include "base/result.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace tidemark {

/// The largest text that is read as a scene, ten times the largest shader we know of. Its tokens take up to
/// fifty times as much memory.
inline constexpr size_t k_largest_text = size_t{16} << 20;

/// Why there is no regular file at that path, as "it is a directory" or "Too many levels of symbolic links";
/// empty where there is one, which may still not be ours to read. Opens nothing.
std::string why_unreadable(const std::filesystem::path& path);

/// The bytes of a regular file. Fails (ErrorCode::load) on a missing file, a directory, an unreadable file
/// or one larger than `largest` bytes, which is not read; the message names the path. Never waits.
Result<std::string> read_file(const std::filesystem::path& path, size_t largest = k_largest_text);

/// As read_file, but the bytes must be text: a NUL byte means that the file is binary.
Result<std::string> read_text_file(const std::filesystem::path& path);

/// A file under construction beside its final place: written under a temporary name that keeps the
/// extension, moved onto the final name by `commit`, removed when dropped without one, or when the process is
/// ended by a signal. Of a device or a pipe, which are never replaced, it lies in the folder for temporary
/// files, and `commit` copies it.
class StagedFile {
public:
    /// Makes it, empty (ErrorCode::write: OutputPath::place). `extension`: instead of the output's. Removes
    /// what a process that was killed left of the same output.
    static Result<StagedFile> create(const OutputPath& output, std::string_view extension = {});
    /// Looks again for what a process that was killed left of this output: one may have died slowly. Of
    /// another machine's nobody knows whether it lives: `all` where none does.
    enum class Machines { ours, all };
    static void remove_abandoned(const OutputPath& output, Machines machines = Machines::ours);
    /// Another process that lives and has a file of this very output under construction; 0: there is none.
    static pid_t other_maker_of(const OutputPath& output);
    StagedFile(StagedFile&& other) noexcept;
    StagedFile& operator=(StagedFile&&) = delete;
    StagedFile(const StagedFile&) = delete;
    StagedFile& operator=(const StagedFile&) = delete;
    ~StagedFile();

    const std::filesystem::path& path() const { return temporary_; }
    /// Fails (ErrorCode::write) where the file or its folder was removed or renamed.
    Result<void> check_is_there() const;
    /// Open for reading and writing, until `commit`.
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

/// Writes the whole file or leaves what was there (ErrorCode::write, naming the path and the reason). A
/// device or a pipe is written to as it is; a pipe that nobody reads is given up after a while.
Result<void> write_file(const OutputPath& output, std::span<const std::byte> bytes);
Result<void> write_file(const OutputPath& output, std::string_view text);

/// Puts a text in the place of the one that a file of a person's has, which keeps its mode, its owner and its
/// names. Fails (ErrorCode::write) and changes nothing where its bytes are not `before` any more, and where
/// it is read-only.
Result<void> replace_text(const OutputPath& output, std::string_view before, std::string_view after);

/// Whether `write_file` would come to writing (ErrorCode::write as there): asked before long work. Leaves
/// nothing behind.
Result<void> check_writable(const OutputPath& output);

/// Makes the folder and those above it, where they are missing (ErrorCode::write, naming it and the reason,
/// or the link that was not named).
Result<void> make_folder(const OutputPath& folder);

} // namespace tidemark
