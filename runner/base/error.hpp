// What can go wrong and where. An expected failure is a value of type Error; it says what is wrong,
// in which file and line, and what to do. Nothing here prints.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tidemark {

/// A place in a text that a person wrote. `line` and `column` count from 1; 0 means "the whole file"
/// and "the whole line".
struct SourceLocation {
    std::string file;
    int line = 0;
    int column = 0;

    bool operator==(const SourceLocation&) const = default;
};

enum class Severity { note, warning, error };

/// "note", "warning", "error".
std::string_view to_string(Severity severity);

/// One message about one place.
struct Diagnostic {
    SourceLocation where;
    Severity severity = Severity::error;
    std::string message;

    bool operator==(const Diagnostic&) const = default;
};

/// `file:line:column: error: message`, the form that editors open; parts that are unknown are left out.
std::string to_string(const Diagnostic& diagnostic);

/// Why a command ends. `exit_code` is the one table from these to what the shell sees.
enum class ErrorCode {
    check_failed, ///< a check, a comparison
    usage,        ///< the command line
    load,         ///< a scene, shader or picture does not load or compile
    write,        ///< an output cannot be written
    no_memory,    ///< the machine has no more, or the driver
    timed_out,
    no_context, ///< there is no OpenGL context to be had
};

int exit_code(ErrorCode code);

struct Error {
    ErrorCode code = ErrorCode::load;
    std::string message;
    std::vector<Diagnostic> diagnostics{};
    /// Of a text that does not load: the files it is made of as far as that is known, a missing one included.
    /// A change of one of them may mend it.
    std::vector<std::string> files{};
};

/// An Error about one place in a text.
Error error_at(SourceLocation where, std::string message, ErrorCode code = ErrorCode::load);

/// What the system says of an errno.
std::string system_reason(int error_number);

/// The whole error for people: the message (when there is one), then a line for each diagnostic.
std::string to_string(const Error& error);

/// The candidate most like `word`, for "did you mean …?"; empty when none is near.
std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates);

} // namespace tidemark
