// Parses a page's messages: events like a window's, commands like the overlay's, and messages that only
// viewers send. The page is not trusted: malformed messages are refused.
#pragma once

#include "base/result.hpp"
#include "live/command.hpp"
#include "platform/input.hpp"

#include <cstdint>
#include <string_view>
#include <variant>

namespace tidemark::serve {

/// The picture of that number, and all before it, were shown.
struct PictureSeen {
    uint32_t number = 0;
};
/// The viewer asks for control.
struct SteeringWanted {};
/// Whether the viewer's browser can show a film.
struct FilmShown {
    bool can = false;
};
/// The page lost the keyboard: everything held down is released.
struct LetGo {};

using Request =
    std::variant<platform::InputEvent, live::Command, PictureSeen, SteeringWanted, FilmShown, LetGo>;

/// Bytes; longer messages are refused.
inline constexpr size_t k_longest_request = 4096;

/// Parses a message such as `{"do":"press","button":"left","x":100,"y":50}`, with pixels from the bottom
/// left. ErrorCode::usage says what is wrong.
Result<Request> parse_request(std::string_view message);

} // namespace tidemark::serve
