// Whole files in and out. Reading says what is wrong with a path; writing makes a file appear whole or
// not at all. Knows nothing of what the bytes mean.
#pragma once

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
/// extension, moved onto the final name by `commit`, removed when dropped without one.
class StagedFile {
public:
    explicit StagedFile(std::filesystem::path final_path);
    StagedFile(StagedFile&& other) noexcept;
    StagedFile& operator=(StagedFile&&) = delete;
    StagedFile(const StagedFile&) = delete;
    StagedFile& operator=(const StagedFile&) = delete;
    ~StagedFile();

    const std::filesystem::path& path() const { return temporary_; }
    Result<void> commit();

private:
    std::filesystem::path final_;
    std::filesystem::path temporary_;
};

/// Writes the whole file or leaves what was there (ErrorCode::write, naming the path and the reason). A
/// device or a pipe is written to as it is.
Result<void> write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
Result<void> write_file(const std::filesystem::path& path, std::string_view text);

/// Whether `write_file` would come to writing (ErrorCode::write as there): asked before long work. Leaves
/// nothing behind.
Result<void> check_writable(const std::filesystem::path& path);

/// Makes the folder and those above it, where they are missing (ErrorCode::write, naming it and the reason).
Result<void> make_folder(const std::filesystem::path& folder);

} // namespace tidemark
