// Errors as values: what is wrong, in which file and line, and what to do. Nothing here prints.
#pragma once

#include <tl/expected.hpp>

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace tidemark {

/// A place in a source text. `line` and `column` count from 1; 0 means the whole file or the whole line.
struct SourceLocation {
    std::string file;
    int line = 0;
    int column = 0;

    bool operator==(const SourceLocation&) const = default;
};

enum class Severity { note, warning, error };

std::string_view to_string(Severity severity);

/// One message about one place.
struct Diagnostic {
    SourceLocation where;
    Severity severity = Severity::error;
    std::string message;

    bool operator==(const Diagnostic&) const = default;
};

/// Returns `file:line:column: error: message`, the form that editors open, without the parts that are
/// unknown.
std::string to_string(const Diagnostic& diagnostic);

/// Reasons for which a command ends; `exit_code` maps them to exit statuses.
enum class ErrorCode {
    check_failed, ///< a check or a comparison failed
    usage,        ///< the command line is wrong
    load,         ///< a scene, shader or picture does not load or compile
    write,        ///< an output cannot be written
    no_memory,    ///< the machine or the driver is out of memory
    timed_out,
    no_context, ///< no OpenGL context can be made
};

int exit_code(ErrorCode code);

struct Error {
    ErrorCode code = ErrorCode::load;
    std::string message;
    std::vector<Diagnostic> diagnostics{};
    /// For a text that does not load: the files that it is made of, as far as they are known, including a
    /// missing one. A change to one of them may fix the error.
    std::vector<std::string> files{};
};

/// Makes an Error about one place in a text.
Error error_at(SourceLocation where, std::string message, ErrorCode code = ErrorCode::load);

/// Returns the system's message for an errno value.
std::string system_reason(int error_number);

/// Formats the whole error: the message, if there is one, then one line per diagnostic.
std::string to_string(const Error& error);

/// Returns the candidate closest to `word`, for "did you mean …?"; empty if none is close.
std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates);

// Result<T>: a value or the Error that explains why there is none.

template <class T>
using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(Error error) {
    return tl::unexpected<Error>(std::move(error));
}

inline tl::unexpected<Error> fail(ErrorCode code, std::string message) {
    return fail(Error{code, std::move(message), {}});
}

// Returns an error to the caller in one macro: `const auto scene = TRY(load_scene(path));`.

template <class T>
T value_of(Result<T>&& result) {
    if constexpr (!std::is_void_v<T>)
        return *std::move(result);
}

} // namespace tidemark

/// The value of a Result; an error is returned from the enclosing function. It is a statement expression,
/// which GCC and clang have. On the error path, clang 14 does not destroy what the same expression has made
/// before it: put it first in its statement, `T{TRY(a), b}`, and not after anything that owns memory.
#define TRY(...)                                                                                             \
    __extension__({                                                                                          \
        auto tidemark_result = (__VA_ARGS__);                                                                \
        if (!tidemark_result)                                                                                \
            return ::tidemark::fail(std::move(tidemark_result).error());                                     \
        ::tidemark::value_of(std::move(tidemark_result));                                                    \
    })

// Suggests names after an unknown one.

namespace tidemark {

/// Returns "did you mean 'x'?" if one of `names` is close, else "it has x, y"; `none` if `names` is empty.
std::string hint_for(std::string_view name, const std::vector<std::string>& names, std::string_view none);

} // namespace tidemark
