#include "cli/view/error_board.hpp"

#include "base/file.hpp"
#include "text/mapped_text.hpp"

#include <algorithm>
#include <utility>

namespace tidemark::cli {
namespace {

/// Returns the source line as the author wrote it; empty if it cannot be read.
std::string line_at(const SourceLocation& where) {
    const auto file = where.line > 0 ? read_text_file(where.file) : Result<std::string>("");
    const std::string text = file ? text::with_plain_line_ends(*file) : "";
    size_t begin = 0;
    for (int line = 1; line < where.line && begin < text.size(); ++line)
        begin = std::min(text.find('\n', begin), text.size() - 1) + 1;
    return begin < text.size() ? text.substr(begin, text.find('\n', begin) - begin) : "";
}

/// Returns the fields in order of importance: the first error with its notes, then the other diagnostics,
/// then the message about the whole scene. A diagnostic at the same place as the one before has no source
/// line.
std::vector<live::ErrorField> fields_of(const Error& error) {
    std::vector<live::ErrorField> fields;
    const SourceLocation* before = nullptr;
    for (const Diagnostic& diagnostic : error.diagnostics) {
        const bool again = before && diagnostic.where == *before;
        fields.push_back({diagnostic, again ? "" : line_at(diagnostic.where)});
        before = &diagnostic.where;
    }
    const auto first = std::ranges::find_if(fields, [](const live::ErrorField& field) {
        return field.diagnostic.severity == Severity::error && field.diagnostic.where.line > 0;
    });
    if (first != fields.end())
        std::rotate(fields.begin(), first,
                    std::find_if(first + 1, fields.end(), [](const live::ErrorField& field) {
                        return field.diagnostic.severity != Severity::note;
                    }));
    if (!error.message.empty())
        fields.insert(first == fields.end() ? fields.begin() : fields.end(),
                      {{{}, Severity::error, error.message}});
    return fields;
}

} // namespace

bool ErrorBoard::show(const Error* error) {
    std::string text = error ? to_string(*error) : "";
    if (text == text_)
        return false;
    text_ = std::move(text);
    fields_ = error ? fields_of(*error) : std::vector<live::ErrorField>{};
    return true;
}

} // namespace tidemark::cli
