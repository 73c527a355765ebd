// Decides whether an event belongs to the panels or to the scene. A press and its release have the same
// owner, wherever the pointer has moved in between.
#pragma once

#include "platform/input.hpp"

#include <set>

namespace tidemark::live {

class EventOwner {
public:
    /// The kinds of events that the panels would take at the moment.
    struct Wishes {
        bool pointer = false; ///< the pointer is over a panel
        bool text = false;    ///< a text field has the keyboard
    };

    /// Returns whether the event belongs to the panels. Call it once for each event, in order.
    bool take(const platform::InputEvent& event, const Wishes& wishes);
    void release_all();

private:
    std::set<platform::Button> buttons_; ///< pressed on a panel and still down
    std::set<platform::Key> keys_;       ///< pressed in a text field and still down
};

} // namespace tidemark::live
