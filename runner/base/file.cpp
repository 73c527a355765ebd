#include "base/file.hpp"

#include "base/descriptor.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace tidemark {
namespace fs = std::filesystem;
namespace {

std::string reason(int error_number) {
    return std::generic_category().message(error_number);
}

tl::unexpected<Error> cannot_write(const fs::path& path, int error_number) {
    return fail(ErrorCode::write, fmt::format("cannot write '{}': {}", path.string(), reason(error_number)));
}

/// A device or a pipe: it takes bytes, and a file in its place would be the end of it.
bool is_stream(const fs::path& path) {
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    return fs::is_other(status) && status.type() != fs::file_type::unknown;
}

/// Errors speak of `name`, the path that was asked for.
Result<void> write_bytes(const fs::path& path, const fs::path& name, std::span<const std::byte> bytes) {
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (file.get() < 0)
        return cannot_write(name, errno);
    if (const int error = write_all(file.get(), bytes))
        return cannot_write(name, error);
    if (const int error = file.close())
        return cannot_write(name, error);
    return {};
}

/// Of a path at which there is nothing: the link on the way that leads nowhere is named.
std::string why_missing(const fs::path& path) {
    fs::path way;
    for (const fs::path& part : path) {
        way /= part;
        std::error_code ignored;
        if (!fs::is_symlink(way, ignored) || fs::exists(way, ignored))
            continue;
        const std::string target = fs::read_symlink(way, ignored).string();
        return way == path
                   ? fmt::format("it is a link to '{}', where there is nothing", target)
                   : fmt::format("'{}' is a link to '{}', where there is nothing", way.string(), target);
    }
    return "no such file";
}

/// Where a link leads, so that the file is replaced and not the link.
fs::path behind_links(fs::path path) {
    std::error_code error;
    fs::path target = fs::is_symlink(path, error) ? fs::canonical(path, error) : fs::path{};
    return target.empty() ? path : target;
}

} // namespace

std::string why_unreadable(const fs::path& path) {
    if (path.native().find('\0') != std::string::npos)
        return "there is a zero byte in its name";
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    switch (status.type()) {
    case fs::file_type::regular: return {};
    case fs::file_type::not_found: return why_missing(path);
    case fs::file_type::directory: return "it is a directory";
    default: return error ? error.message() : "it is not a regular file";
    }
}

Result<std::string> read_file(const fs::path& path, size_t largest) {
    const auto refuse = [&](std::string_view why) {
        return fail(ErrorCode::load, fmt::format("cannot read '{}': {}", path.string(), why));
    };
    if (const std::string why = why_unreadable(path); !why.empty())
        return refuse(why);
    // Without waiting: it may have become a pipe since, and files of /proc may never have anything to say.
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
    if (file.get() < 0)
        return refuse(reason(errno));
    auto bytes = read_all(file.get(), largest);
    if (bytes)
        return *std::move(bytes);
    return refuse(bytes.error() == EFBIG ? fmt::format("it is larger than {} MiB", largest >> 20)
                                         : reason(bytes.error()));
}

Result<std::string> read_text_file(const fs::path& path) {
    return read_file(path).and_then([&](std::string bytes) -> Result<std::string> {
        if (bytes.find('\0') != std::string::npos)
            return fail(ErrorCode::load,
                        fmt::format("'{}' is a binary file, not shader text", path.string()));
        return bytes;
    });
}

StagedFile::StagedFile(fs::path final_path)
    : final_(behind_links(std::move(final_path))), temporary_(final_) {
    static std::atomic<unsigned> count = 0; // two threads may write to one path
    temporary_.replace_filename(fmt::format(".{}.part-{}-{}{}", final_.stem().string(), ::getpid(), ++count,
                                            final_.extension().string()));
}

StagedFile::StagedFile(StagedFile&& other) noexcept
    : final_(std::move(other.final_)), temporary_(std::exchange(other.temporary_, {})) {}

StagedFile::~StagedFile() {
    std::error_code ignored;
    if (!temporary_.empty())
        fs::remove(temporary_, ignored);
}

Result<void> StagedFile::commit() {
    std::error_code error;
    fs::rename(temporary_, final_, error);
    if (error)
        return cannot_write(final_, error.value());
    temporary_.clear();
    return {};
}

Result<void> write_file(const fs::path& path, std::span<const std::byte> bytes) {
    if (is_stream(path))
        return write_bytes(path, path, bytes);
    StagedFile staged(path);
    return write_bytes(staged.path(), path, bytes).and_then([&] { return staged.commit(); });
}

Result<void> write_file(const fs::path& path, std::string_view text) {
    return write_file(path, std::as_bytes(std::span(text)));
}

Result<void> check_writable(const fs::path& path) {
    if (is_stream(path))
        return {};
    std::error_code ignored;
    if (fs::is_directory(path, ignored))
        return cannot_write(path, EISDIR);
    const StagedFile attempt(path);
    return write_bytes(attempt.path(), path, {});
}

Result<void> make_folder(const fs::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        return fail(ErrorCode::write,
                    fmt::format("cannot make the folder '{}': {}", folder.string(), error.message()));
    return {};
}

} // namespace tidemark
