#include "base/descriptor.hpp"

#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace tidemark {

int Descriptor::release() {
    return std::exchange(fd_, -1);
}

int Descriptor::close() {
    const int fd = release();
    return fd < 0 || ::close(fd) == 0 ? 0 : errno;
}

tl::expected<std::string, int> read_all(int fd, size_t largest) {
    struct stat facts {};
    if (::fstat(fd, &facts) != 0)
        return tl::unexpected<int>(errno);
    if (S_ISREG(facts.st_mode) && uintmax_t(facts.st_size) > largest)
        return tl::unexpected<int>(EFBIG);
    std::string bytes;
    bytes.reserve(size_t(facts.st_size));
    char block[1 << 13]; // a thread's stack may be small
    for (;;) {           // the file may grow meanwhile, and files of /proc have size 0
        const ssize_t count = ::read(fd, block, sizeof block);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return tl::unexpected<int>(errno);
        if (count == 0)
            return bytes;
        if (size_t(count) > largest - bytes.size())
            return tl::unexpected<int>(EFBIG);
        bytes.append(block, size_t(count));
    }
}

int write_all(int fd, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(fd, bytes.data(), bytes.size());
        if (written >= 0) {
            bytes = bytes.subspan(size_t(written));
        } else if (errno == EAGAIN) {
            pollfd wait{fd, POLLOUT, 0};
            ::poll(&wait, 1, -1);
        } else if (errno != EINTR) {
            return errno;
        }
    }
    return 0;
}

} // namespace tidemark
