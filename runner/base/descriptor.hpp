// POSIX file descriptors: one that is closed by its owner, and whole contents through one. Errors are
// errno's.
#pragma once

#include <tl/expected.hpp>

#include <cstddef>
#include <span>
#include <string>

namespace tidemark {

/// Owns a file descriptor; -1: none.
class Descriptor {
public:
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { (void)close(); }

    int get() const { return fd_; }
    int release();
    /// Closes now and gives the error that the destructor swallows; 0: none.
    int close();

private:
    int fd_;
};

/// To the end, from where it stands; EFBIG where there are more than `largest` bytes, of which no more are
/// read.
tl::expected<std::string, int> read_all(int fd, size_t largest);

/// 0, or the error of the first write that failed. Waits where the descriptor itself does not.
int write_all(int fd, std::span<const std::byte> bytes);

} // namespace tidemark
