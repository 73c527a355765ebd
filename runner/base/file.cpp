#include "base/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

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

private:
    int fd_;
};

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

} // namespace tidemark
