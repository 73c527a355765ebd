// What a page asks for, read from its message: events as a window has them, commands as the overlay has them,
// and what only viewers say. The page is not trusted: whatever is not as it must be is refused.
#pragma once

#include "base/result.hpp"
#include "live/command.hpp"
#include "platform/input.hpp"

#include <cstdint>
#include <string_view>
#include <variant>

namespace tidemark::serve {

/// A picture of that number, and all before it, have been seen.
struct PictureSeen {
    uint32_t number = 0;
};
/// This viewer wants to be the one that steers.
struct SteeringWanted {};
/// Whether this viewer's browser can show a film.
struct FilmShown {
    bool can = false;
};
/// Whatever is held down is let go: the page lost the keyboard.
struct LetGo {};

using Request =
    std::variant<platform::InputEvent, live::Command, PictureSeen, SteeringWanted, FilmShown, LetGo>;

/// No longer message is taken.
inline constexpr size_t k_longest_request = 4096;

/// `{"do":"press","button":"left","x":100,"y":50}`, pixels from the bottom left. ErrorCode::usage says what
/// is wrong.
Result<Request> parse_request(std::string_view message);

} // namespace tidemark::serve
