#include "base/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <system_error>
#include <utility>
#include <vector>

namespace tidemark {
namespace {

/// Counts the insertions, deletions, substitutions and swaps of neighbours that make `b` of `a`.
size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<size_t> before, above, row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 0; i < a.size(); ++i) {
        before = std::exchange(above, row);
        row[0] = i + 1;
        for (size_t j = 0; j < b.size(); ++j) {
            const size_t substituted = above[j] + (a[i] == b[j] ? 0 : 1);
            row[j + 1] = std::min({row[j] + 1, above[j + 1] + 1, substituted});
            if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j])
                row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
        }
    }
    return row.back();
}

} // namespace

std::string_view to_string(Severity severity) {
    switch (severity) {
    case Severity::note: return "note";
    case Severity::warning: return "warning";
    case Severity::error: return "error";
    }
    return "error";
}

std::string to_string(const Diagnostic& diagnostic) {
    std::string place = diagnostic.where.file;
    if (diagnostic.where.line > 0) {
        place += fmt::format(":{}", diagnostic.where.line);
        if (diagnostic.where.column > 0)
            place += fmt::format(":{}", diagnostic.where.column);
    }
    if (!place.empty())
        place += ": ";
    return fmt::format("{}{}: {}", place, to_string(diagnostic.severity), diagnostic.message);
}

int exit_code(ErrorCode code) {
    switch (code) {
    case ErrorCode::check_failed: return 1;
    case ErrorCode::usage: return 2;
    case ErrorCode::load: return 3;
    case ErrorCode::write:
    case ErrorCode::no_memory: return 4;
    case ErrorCode::timed_out: return 5;
    case ErrorCode::no_context: return 77;
    }
    return 1;
}

Error error_at(SourceLocation where, std::string message, ErrorCode code) {
    Error error{code, {}, {}};
    error.diagnostics.push_back({std::move(where), Severity::error, std::move(message)});
    return error;
}

std::string system_reason(int error_number) {
    return std::generic_category().message(error_number);
}

std::string to_string(const Error& error) {
    std::string text;
    if (!error.message.empty())
        text = "tidemark: error: " + error.message;
    for (const Diagnostic& diagnostic : error.diagnostics) {
        if (!text.empty())
            text += '\n';
        text += to_string(diagnostic);
    }
    return text;
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates) {
    const size_t limit = std::max<size_t>(1, word.size() / 3);
    std::string best;
    size_t best_distance = limit + 1;
    for (const std::string& candidate : candidates) {
        const size_t distance = edit_distance(word, candidate);
        if (distance < best_distance) {
            best_distance = distance;
            best = candidate;
        }
    }
    return best;
}

std::string hint_for(std::string_view name, const std::vector<std::string>& names, std::string_view none) {
    if (names.empty())
        return std::string(none);
    const std::string nearest = nearest_name(name, names);
    return nearest.empty() ? fmt::format("it has {}", fmt::join(names, ", "))
                           : fmt::format("did you mean '{}'?", nearest);
}

} // namespace tidemark
