#include "window/receiver.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <iterator>

namespace tidemark::live {

void Inbox::put(std::string_view packet) {
    bool first = false;
    {
        const std::lock_guard lock(mutex_);
        first = packets_.empty();
        packets_.emplace_back(packet);
        bytes_ += packet.size();
        while (packets_.size() > 1 && (packets_.size() > k_most_packets || bytes_ > k_most_bytes)) {
            bytes_ -= packets_.front().size();
            packets_.pop_front();
        }
    }
    if (first)
        wake_();
}

bool Inbox::empty() {
    const std::lock_guard lock(mutex_);
    return packets_.empty();
}

std::vector<std::string> Inbox::take() {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> taken(std::make_move_iterator(packets_.begin()),
                                   std::make_move_iterator(packets_.end()));
    packets_.clear();
    bytes_ = 0;
    return taken;
}

namespace {

/// The largest UDP packet, in bytes.
constexpr size_t k_longest_packet = 1 << 16;

/// Returns whether the descriptor is a socket: an empty read is then an empty packet, not the end of a file.
bool is_socket(int descriptor) {
    struct stat status {};
    return ::fstat(descriptor, &status) == 0 && S_ISSOCK(status.st_mode);
}

} // namespace

Receiver::Receiver(int from, Inbox& into)
    : from_(from), stop_(::eventfd(0, EFD_CLOEXEC)), thread_([this, &into] { receive(into); }) {}

Receiver::~Receiver() {
    (void)::eventfd_write(stop_.get(), 1);
    thread_.join();
}

void Receiver::receive(Inbox& into) const {
    std::string bytes(k_longest_packet, '\0');
    std::array<pollfd, 2> waited{{{from_.get(), POLLIN, 0}, {stop_.get(), POLLIN, 0}}};
    while (true) {
        if (::poll(waited.data(), waited.size(), -1) < 0 && errno != EINTR)
            return;
        if (waited[1].revents != 0)
            return;
        const ssize_t size = ::read(from_.get(), bytes.data(), bytes.size());
        if (size > 0)
            into.put({bytes.data(), size_t(size)});
        else if (size < 0 ? errno != EAGAIN && errno != EINTR : !is_socket(from_.get()))
            return;
    }
}

} // namespace tidemark::live
