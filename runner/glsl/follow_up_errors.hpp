// Which of a driver's errors only follow from an error before them. A compiler that goes on behind a word
// that it does not know complains of every expression round it.
#pragma once

#include "base/error.hpp"

#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace tidemark::glsl {

/// Told the messages of one log in their order.
class FollowUpErrors {
public:
    struct Message {
        int line = 0;   ///< the driver's own; 0: none
        int column = 0; ///< likewise
        Severity severity = Severity::error;
        std::string_view text;
    };

    /// Whether this one follows from one before it.
    bool take(const Message& message);

private:
    bool follows(const Message& message, const std::set<std::string>& words) const;

    std::optional<Message> last_;   ///< the last error, in numbers: its text may be gone
    std::set<std::string> named_;   ///< words that errors were about
    std::set<std::string> unknown_; ///< errors about words that are not known, as they were told
    int unknown_line_ = 0;          ///< of the last of those
};

} // namespace tidemark::glsl
