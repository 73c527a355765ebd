// Requests of browsers: access control, and the messages of a page.
//
// Access control: a client needs the token from the address, and only this server's own page may open a
// WebSocket.
#pragma once

#include "base/error.hpp"
#include "host/input_events.hpp"
#include "host/overlay_model.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace tidemark::web {

/// Returns 22 characters that are valid in an address, with 128 bits and more of the system's random numbers.
Result<std::string> make_token();
/// Checks a token chosen by the user: 16 to 128 letters, digits, `-` and `_`. ErrorCode::usage says what is
/// wrong.
Result<void> check_token(std::string_view token);

/// Checks an address of a page that may frame this one: an origin such as `https://editor.example:8443` or
/// `https://*.vscode-cdn.net`, or the scheme of a program's own pages, as in `vscode-webview:`.
/// ErrorCode::usage says what is wrong.
Result<void> check_ancestor(std::string_view ancestor);
/// Checks an origin under which browsers reach this server: `https://name-8080.example.dev`.
Result<void> check_origin(std::string_view origin);

/// A browser's HTTP request.
struct Knock {
    std::string_view target;      ///< `/?token=…`
    std::string_view host{};      ///< the header; empty if missing
    std::string_view origin{};    ///< the header; browsers send it with every WebSocket
    bool upgrade = false;         ///< to a WebSocket
    bool through_loopback = true; ///< the server listens only on the loopback
};

enum class Answer { page, socket, forbidden, not_found };

/// Decides on a request. A page of another site can make its reader's browser send requests here, but with
/// that site's origin; a page whose name was resolved to this address (DNS rebinding) sends a host that is
/// not a name of the loopback. `origins` are those of forwarded addresses, which count as this server's own.
/// Without a token in the address only the page is sent, which reads the token from the fragment.
Answer answer_to(const Knock& knock, std::string_view token, std::span<const std::string> origins = {});

// Parses a page's messages: events like a window's, commands like the overlay's, and messages that only
// viewers send. The page is not trusted: malformed messages are refused.

/// The picture of that number, and all before it, were shown.
struct PictureSeen {
    uint32_t number = 0;
};
/// The viewer requests control.
struct SteeringWanted {};
/// The page lost the keyboard: everything held down is released.
struct LetGo {};

using Request = std::variant<host::InputEvent, overlay::Command, PictureSeen, SteeringWanted, LetGo>;

/// Bytes; longer messages are refused.
inline constexpr size_t k_longest_request = 4096;

/// Parses a message such as `{"do":"press","button":"left","x":100,"y":50}`, with pixels from the bottom
/// left. ErrorCode::usage says what is wrong.
Result<Request> parse_request(std::string_view message);

} // namespace tidemark::web
