// POSIX file descriptors: an owning type, and functions that read or write whole contents. Errors are errno
// values.
#pragma once

#include <tl/expected.hpp>

#include <cstddef>
#include <span>
#include <string>

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

} // namespace tidemark
