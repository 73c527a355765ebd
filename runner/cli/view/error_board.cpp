#include "cli/view/error_board.hpp"

#include "base/file.hpp"
#include "text/mapped_text.hpp"

#include <algorithm>
#include <utility>

namespace tidemark::cli {
namespace {

/// The line as its author has it; empty where it cannot be had.
std::string line_at(const SourceLocation& where) {
    const auto file = where.line > 0 ? read_text_file(where.file) : Result<std::string>("");
    const std::string text = file ? text::with_plain_line_ends(*file) : "";
    size_t begin = 0;
    for (int line = 1; line < where.line && begin < text.size(); ++line)
        begin = std::min(text.find('\n', begin), text.size() - 1) + 1;
    return begin < text.size() ? text.substr(begin, text.find('\n', begin) - begin) : "";
}

/// Errors first: what only warns is not what people wait for.
std::vector<live::ErrorField> fields_of(const Error& error) {
    std::vector<live::ErrorField> fields;
    if (!error.message.empty())
        fields.push_back({{{}, Severity::error, error.message}});
    for (const Diagnostic& diagnostic : error.diagnostics)
        fields.push_back({diagnostic, line_at(diagnostic.where)});
    const auto is_error = [](const live::ErrorField& field) {
        return field.diagnostic.severity == Severity::error && field.diagnostic.where.line > 0;
    };
    const auto first = std::ranges::find_if(fields, is_error);
    if (first != fields.end())
        std::rotate(fields.begin(), first, first + 1);
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
