// Input of the controlling viewer, passed from the server's thread to the drawing thread.
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

    /// Adds an event; a pointer move replaces one directly before it.
    void add(const platform::InputEvent& event);
    void add(live::Command command);
    /// Returns whether more is waiting than a user could produce.
    bool is_full() const;

    /// Returns what was added since the last call. Sleeps until there is something, `wake` was called or the
    /// seconds, which may be infinite, have passed.
    Content wait(double seconds);
    void wake();

private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    Content content_;
    bool woken_ = false;
};

} // namespace tidemark::serve
