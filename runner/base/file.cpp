#include "base/file.hpp"

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

/// Owns a POSIX file descriptor.
class Descriptor {
public:
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (fd_ >= 0)
            ::close(fd_);
    }
    int get() const { return fd_; }
    /// Closes now and reports the error that a destructor could only swallow (0: none).
    int close() {
        const int fd = std::exchange(fd_, -1);
        return ::close(fd) == 0 ? 0 : errno;
    }

private:
    int fd_;
};

/// 0, or the errno of the first write that failed.
int write_all(int fd, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(fd, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            return errno;
        bytes = bytes.subspan(size_t(written));
    }
    return 0;
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

/// Where a link leads, so that the file is replaced and not the link.
fs::path behind_links(fs::path path) {
    std::error_code error;
    fs::path target = fs::is_symlink(path, error) ? fs::canonical(path, error) : fs::path{};
    return target.empty() ? path : target;
}

} // namespace

Result<std::string> read_file(const fs::path& path, size_t largest) {
    const auto refuse = [&](std::string_view why) {
        return fail(ErrorCode::load, fmt::format("cannot read '{}': {}", path.string(), why));
    };
    std::error_code status_error;
    const fs::file_status status = fs::status(path, status_error);
    if (status.type() == fs::file_type::not_found)
        return refuse("no such file");
    if (status.type() == fs::file_type::directory)
        return refuse("it is a directory");
    if (status_error)
        return refuse(status_error.message());
    if (status.type() != fs::file_type::regular)
        return refuse("it is not a regular file");
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.get() < 0)
        return refuse(reason(errno));
    std::string bytes;
    char block[1 << 16];
    for (;;) {
        const ssize_t count = ::read(file.get(), block, sizeof block);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return refuse(reason(errno));
        if (count == 0)
            return bytes;
        bytes.append(block, size_t(count));
        if (bytes.size() > largest)
            return refuse(fmt::format("it is larger than {} MiB", largest >> 20));
    }
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
