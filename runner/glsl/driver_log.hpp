// What a driver says about a shader, turned into messages about the author's own lines.
#pragma once

#include "base/error.hpp"
#include "text/mapped_text.hpp"

#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// One line of a log.
struct DriverMessage {
    Diagnostic diagnostic;
    bool follows = false; ///< from an error before it: there is nothing to mend here
};

/// Reads the forms of Mesa `0:12(5): error: …`, NVIDIA `0(12) : error C1008: …`, and Intel, AMD and ANGLE
/// `ERROR: 0:12: …`. A line in none of these forms, and one about a line of our own making, has no place; no
/// column has a message of a driver that gives none, or whose column counts what a macro stands for. Of the
/// overloads that Mesa lists where none fits a call, three are kept, as notes.
std::vector<DriverMessage> parse_driver_log(std::string_view log, const text::MappedText& source);

/// Without what follows, which is counted in a note under the error it follows from. Errors come first.
std::vector<Diagnostic> for_people(const std::vector<DriverMessage>& messages);

} // namespace tidemark::glsl
