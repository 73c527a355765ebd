#include "live/event_owner.hpp"

#include "base/overloaded.hpp"

namespace tidemark::live {

bool EventOwner::take(const platform::InputEvent& event, const Wishes& wishes) {
    return std::visit(
        Overloaded{
            [&](const platform::PointerMoved&) { return !buttons_.empty(); },
            [&](const platform::ButtonPressed& pressed) {
                return wishes.pointer && buttons_.insert(pressed.button).second;
            },
            [&](const platform::ButtonReleased& released) { return buttons_.erase(released.button) > 0; },
            [&](const platform::WheelTurned&) { return wishes.pointer; },
            [&](const platform::KeyPressed& pressed) {
                if (wishes.text)
                    keys_.insert(pressed.key);
                return wishes.text;
            },
            [&](const platform::KeyReleased& released) { return keys_.erase(released.key) > 0; },
            [&](const platform::TextTyped&) { return wishes.text; },
            [](const auto&) { return false; },
        },
        event);
}

void EventOwner::release_all() {
    buttons_.clear();
    keys_.clear();
}

} // namespace tidemark::live
