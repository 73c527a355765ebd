#include "live/inputs/inbox.hpp"

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

} // namespace tidemark::live
