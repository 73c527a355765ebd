// What the steering viewer holds down, so that it can be let go for one that has gone.
#pragma once

#include "platform/input.hpp"

#include <set>
#include <vector>

namespace tidemark::serve {

class Hands {
public:
    void follow(const platform::InputEvent& event);
    /// The events that let go of it all.
    std::vector<platform::InputEvent> let_go();

private:
    std::set<platform::Button> buttons_;
    std::set<platform::Key> keys_;
    platform::PointerPosition pointer_{};
};

} // namespace tidemark::serve
