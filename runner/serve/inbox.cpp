#include "serve/inbox.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace tidemark::serve {
namespace {

constexpr size_t k_most_waiting = 4096;
constexpr double k_as_good_as_forever = 1e6;

} // namespace

bool Inbox::is_full() const {
    const std::lock_guard lock(mutex_);
    return content_.events.size() + content_.commands.size() >= k_most_waiting;
}

void Inbox::add(const platform::InputEvent& event) {
    const auto moves = [](const platform::InputEvent& other) {
        return std::holds_alternative<platform::PointerMoved>(other);
    };
    const std::lock_guard lock(mutex_);
    auto& events = content_.events;
    if (!events.empty() && moves(events.back()) && moves(event))
        events.pop_back();
    events.push_back(event);
    changed_.notify_one();
}

void Inbox::add(live::Command command) {
    const std::lock_guard lock(mutex_);
    content_.commands.push_back(std::move(command));
    changed_.notify_one();
}

Inbox::Content Inbox::wait(double seconds) {
    std::unique_lock lock(mutex_);
    const std::chrono::duration<double> most(std::clamp(seconds, 0.0, k_as_good_as_forever));
    changed_.wait_for(lock, most,
                      [&] { return woken_ || !content_.events.empty() || !content_.commands.empty(); });
    woken_ = false;
    return std::exchange(content_, {});
}

void Inbox::wake() {
    const std::lock_guard lock(mutex_);
    woken_ = true;
    changed_.notify_one();
}

} // namespace tidemark::serve
