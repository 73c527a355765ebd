// The keys and buttons that the controlling viewer holds down, so that they can be released when it loses
// control.
#pragma once

#include "platform/input.hpp"

#include <set>
#include <vector>

namespace tidemark::serve {

class Hands {
public:
    void follow(const platform::InputEvent& event);
    /// Returns the events that release them all.
    std::vector<platform::InputEvent> let_go();

private:
    std::set<platform::Button> buttons_;
    std::set<platform::Key> keys_;
    platform::PointerPosition pointer_{};
};

} // namespace tidemark::serve
