// A queue of received packets, from the receiving threads to the thread that owns the window.
#pragma once

#include "base/file.hpp"

#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace tidemark::live {

class Inbox {
public:
    /// `wake` is called on the thread of `put` when a packet arrives in the empty queue.
    explicit Inbox(std::function<void()> wake) : wake_(std::move(wake)) {}

    /// Adds one whole packet. Drops the oldest ones beyond 4,096 packets or 1 MiB.
    void put(std::string_view packet);

    bool empty();
    /// Removes all packets and returns them in the order of arrival.
    std::vector<std::string> take();

private:
    static constexpr size_t k_most_packets = 4096;
    static constexpr size_t k_most_bytes = 1 << 20; ///< parsed in about 20 ms

    std::function<void()> wake_;
    std::mutex mutex_;
    std::deque<std::string> packets_; ///< guarded by mutex_
    size_t bytes_ = 0;                ///< total size of packets_, guarded by mutex_
};

// A thread that reads packets from a descriptor (a socket, a pipe, a device) and puts them into an Inbox.

class Receiver {
public:
    /// Takes ownership of the descriptor. Each read is one packet. The thread ends at the end of the input.
    Receiver(int from, Inbox& into);
    ~Receiver();
    Receiver(const Receiver&) = delete;
    Receiver& operator=(const Receiver&) = delete;

private:
    void receive(Inbox& into) const;

    Descriptor from_;
    Descriptor stop_; ///< an eventfd that becomes readable when the thread must end
    std::thread thread_;
};

} // namespace tidemark::live
