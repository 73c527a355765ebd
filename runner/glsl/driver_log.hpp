// Parses driver logs into messages about the author's own lines.
#pragma once

#include "base/error.hpp"
#include "text/mapped_text.hpp"

#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// One line of a log.
struct DriverMessage {
    Diagnostic diagnostic;
    bool follows = false; ///< caused by an earlier error; nothing to fix here
};

/// Reads the formats of Mesa `0:12(5): error: …`, NVIDIA `0(12) : error C1008: …`, and Intel, AMD and ANGLE
/// `ERROR: 0:12: …`. A line in another format, or about a generated line, has no place. A message has no
/// column if the driver prints none, or if its column counts expanded macros. Of the overloads that Mesa
/// lists for a failed call, three are kept, as notes.
std::vector<DriverMessage> parse_driver_log(std::string_view log, const text::MappedText& source);

/// Drops messages that follow from others, and counts them in a note under the error that caused them. Errors
/// come first.
std::vector<Diagnostic> for_people(const std::vector<DriverMessage>& messages);

} // namespace tidemark::glsl
