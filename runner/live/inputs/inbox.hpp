// What arrives from outside, handed from the threads that receive it to the one that owns the window.
#pragma once

#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::live {

class Inbox {
public:
    /// `wake` is called, on the thread of `put`, when there is something to take where nothing was.
    explicit Inbox(std::function<void()> wake) : wake_(std::move(wake)) {}

    /// One packet, whole. Of more than nobody takes in time the oldest go.
    void put(std::string_view packet);

    bool empty();
    /// In the order of their arrival.
    std::vector<std::string> take();

private:
    static constexpr size_t k_most_packets = 4096;
    static constexpr size_t k_most_bytes = 1 << 20; ///< read in some 20 ms

    std::function<void()> wake_;
    std::mutex mutex_;
    std::deque<std::string> packets_; ///< under the mutex
    size_t bytes_ = 0;                ///< of them, likewise
};

} // namespace tidemark::live
