// Who is let in: whoever has the token that stands in the address, and of web pages this server's own alone.
#pragma once

#include "base/result.hpp"

#include <string>
#include <string_view>

namespace tidemark::serve {

/// 128 bits of the system's random numbers, in 22 letters that an address can hold.
Result<std::string> make_token();
/// Of a person's own choice: 16 to 128 letters, digits, `-` and `_`. ErrorCode::usage says what is wrong.
Result<void> check_token(std::string_view token);
/// Takes as long whichever letter is wrong.
bool is_same_token(std::string_view given, std::string_view right);

/// What a browser says when it asks for something.
struct Knock {
    std::string_view target;      ///< `/?token=…`
    std::string_view host{};      ///< the header; empty: none
    std::string_view origin{};    ///< likewise; browsers send it with every WebSocket
    bool upgrade = false;         ///< to a WebSocket
    bool through_loopback = true; ///< the server listens there alone
};

enum class Answer { page, socket, forbidden, not_found };

/// A page elsewhere may have its reader's browser ask this server, but cannot make it say another origin; one
/// whose name was turned to this address (DNS rebinding) has a host that is no name of the loopback.
Answer answer_to(const Knock& knock, std::string_view token);

} // namespace tidemark::serve
