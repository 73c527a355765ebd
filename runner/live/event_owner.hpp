// Whose an event is, the panels' or the scene's: what begins in one of them ends there, wherever the pointer
// has gone meanwhile.
#pragma once

#include "platform/input.hpp"

#include <set>

namespace tidemark::live {

class EventOwner {
public:
    /// What the panels would take at this moment.
    struct Wishes {
        bool pointer = false; ///< it is over a panel
        bool text = false;    ///< somebody types into a field
    };

    /// Whether the event is the panels'. Once for each, in order.
    bool take(const platform::InputEvent& event, const Wishes& wishes);
    void release_all();

private:
    std::set<platform::Button> buttons_; ///< that went down on a panel and are still down
    std::set<platform::Key> keys_;       ///< likewise, in a field
};

} // namespace tidemark::live
