#include "serve/hands.hpp"

#include "base/overloaded.hpp"

namespace tidemark::serve {

void Hands::follow(const platform::InputEvent& event) {
    std::visit(Overloaded{
                   [&](const platform::PointerMoved& moved) { pointer_ = moved.at; },
                   [&](const platform::ButtonPressed& pressed) { buttons_.insert(pressed.button); },
                   [&](const platform::ButtonReleased& released) { buttons_.erase(released.button); },
                   [&](const platform::KeyPressed& pressed) { keys_.insert(pressed.key); },
                   [&](const platform::KeyReleased& released) { keys_.erase(released.key); },
                   [](const auto&) {},
               },
               event);
}

std::vector<platform::InputEvent> Hands::let_go() {
    std::vector<platform::InputEvent> events;
    for (const platform::Button button : buttons_)
        events.emplace_back(platform::ButtonReleased{button, pointer_});
    for (const platform::Key key : keys_)
        events.emplace_back(platform::KeyReleased{key});
    buttons_.clear();
    keys_.clear();
    return events;
}

} // namespace tidemark::serve
