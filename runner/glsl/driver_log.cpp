#include "glsl/driver_log.hpp"

#include <charconv>
#include <optional>

namespace tidemark::glsl {
namespace {

/// A message with the driver's own line number (0: none).
struct Message {
    int line = 0;
    Severity severity = Severity::error;
    std::string_view text;
};

/// Consumes the front of a line of the log, piece by piece.
class Cursor {
public:
    explicit Cursor(std::string_view text) : rest_(text) {}

    bool literal(std::string_view wanted) {
        if (!rest_.starts_with(wanted))
            return false;
        rest_.remove_prefix(wanted.size());
        return true;
    }

    bool number(int& value) {
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        if (error != std::errc{} || value < 0)
            return false;
        rest_.remove_prefix(size_t(end - rest_.data()));
        return true;
    }

    void blanks() {
        while (rest_.starts_with(' ') || rest_.starts_with('\t'))
            rest_.remove_prefix(1);
    }

    /// `error`, `warning` or `note` as the driver spells it; what stands in front of the word is dropped
    /// (`preprocessor error`).
    std::optional<Severity> severity() {
        literal("preprocessor ");
        if (literal("error") || literal("ERROR"))
            return Severity::error;
        if (literal("warning") || literal("WARNING"))
            return Severity::warning;
        if (literal("note") || literal("NOTE"))
            return Severity::note;
        return std::nullopt;
    }

    std::string_view rest() const { return rest_; }

private:
    std::string_view rest_;
};

/// `0:12(5): error: …`
std::optional<Message> read_mesa(Cursor at) {
    int source = 0;
    int line = 0;
    int column = 0;
    if (!(at.number(source) && at.literal(":") && at.number(line) && at.literal("(") && at.number(column) &&
          at.literal("): ")))
        return std::nullopt;
    const auto severity = at.severity();
    if (!severity || !at.literal(": "))
        return std::nullopt;
    return Message{line, *severity, at.rest()};
}

/// `0(12) : error C1008: …`
std::optional<Message> read_nvidia(Cursor at) {
    int source = 0;
    int line = 0;
    if (!(at.number(source) && at.literal("(") && at.number(line) && at.literal(")")))
        return std::nullopt;
    at.blanks();
    if (!at.literal(":"))
        return std::nullopt;
    at.blanks();
    const auto severity = at.severity();
    if (!severity)
        return std::nullopt;
    at.blanks();
    return Message{line, *severity, at.rest()};
}

/// `ERROR: 0:12: …`
std::optional<Message> read_intel(Cursor at) {
    int source = 0;
    int line = 0;
    const auto severity = at.severity();
    if (!severity || !at.literal(": ") || !at.number(source) || !at.literal(":") || !at.number(line) ||
        !at.literal(":"))
        return std::nullopt;
    at.blanks();
    return Message{line, *severity, at.rest()};
}

Message read_line(std::string_view line) {
    for (const auto read : {read_mesa, read_nvidia, read_intel})
        if (const auto message = read(Cursor(line)))
            return *message;
    Cursor at(line);
    const auto severity = at.severity();
    if (severity && at.literal(": "))
        return {0, *severity, at.rest()};
    return {0, Severity::error, line};
}

} // namespace

std::vector<Diagnostic> parse_driver_log(std::string_view log, const text::LineMap& lines) {
    std::vector<Diagnostic> diagnostics;
    while (!log.empty()) {
        const size_t end = std::min(log.find('\n'), log.size());
        std::string_view line = log.substr(0, end);
        log.remove_prefix(std::min(end + 1, log.size()));
        while (!line.empty() && (line.back() == '\r' || line.back() == '\0' || line.back() == ' '))
            line.remove_suffix(1);
        if (line.empty())
            continue;
        const Message message = read_line(line);
        diagnostics.push_back({lines.locate(message.line), message.severity, std::string(message.text)});
    }
    return diagnostics;
}

} // namespace tidemark::glsl
