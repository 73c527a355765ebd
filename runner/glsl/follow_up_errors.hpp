// Finds the driver's errors that only follow from an earlier error: a compiler that continues after an
// unknown identifier reports every expression around it.
#pragma once

#include "base/error.hpp"

#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace tidemark::glsl {

/// Receives the messages of one log in order.
class FollowUpErrors {
public:
    struct Message {
        int line = 0;   ///< as the driver printed it; 0: none
        int column = 0; ///< likewise
        Severity severity = Severity::error;
        std::string_view text;
    };

    /// Returns whether this message follows from an earlier one.
    bool take(const Message& message);

private:
    bool follows(const Message& message, const std::set<std::string>& words) const;

    std::optional<Message> last_;   ///< the last error; only its numbers are valid, its text may be gone
    std::set<std::string> named_;   ///< identifiers that errors quoted
    std::set<std::string> unknown_; ///< messages about unknown identifiers
    int unknown_line_ = 0;          ///< line of the last of those
};

} // namespace tidemark::glsl
