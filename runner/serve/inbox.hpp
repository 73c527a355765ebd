// What the steering viewer did, on its way from the server's thread to the one that draws.
#pragma once

#include "live/command.hpp"
#include "platform/input.hpp"

#include <condition_variable>
#include <mutex>
#include <vector>

namespace tidemark::serve {

class Inbox {
public:
    struct Content {
        std::vector<platform::InputEvent> events;
        live::Commands commands;
    };

    /// A pointer that moves on replaces where it was.
    void add(const platform::InputEvent& event);
    void add(live::Command command);
    /// There is more than anybody's hands could do.
    bool is_full() const;

    /// What came since the last call: sleeps until there is something, `wake` was called or the seconds,
    /// which may be infinite, have passed.
    Content wait(double seconds);
    void wake();

private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    Content content_;
    bool woken_ = false;
};

} // namespace tidemark::serve
