#include "glsl/driver_log.hpp"

#include "glsl/driver_places.hpp"
#include "glsl/follow_up_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

namespace tidemark::glsl {
namespace {

/// A message with the line and column that the driver printed (0: none).
struct Message {
    int line = 0;
    Severity severity = Severity::error;
    std::string_view text;
    int column = 0;
    bool of_preprocessor = false;
};

/// Parses a line of the log from its beginning.
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

    /// Reads `error`, `warning` or `note` in the driver's spelling; skips a prefix (`preprocessor error`).
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
    const bool of_preprocessor = at.rest().starts_with("preprocessor ");
    const auto severity = at.severity();
    if (!severity || !at.literal(": "))
        return std::nullopt;
    return Message{line, *severity, at.rest(), column, of_preprocessor};
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

/// Names of tokens in Mesa's parser, and readable replacements.
constexpr std::pair<std::string_view, std::string_view> k_tokens[] = {
    {"BASIC_TYPE_TOK", "a type"},
    {"TYPE_IDENTIFIER", "a type"},
    {"NEW_IDENTIFIER", "a name"},
    {"IDENTIFIER", "a name"},
    {"FIELD_SELECTION", "a member"},
    {"INTCONSTANT", "a whole number"},
    {"FLOATCONSTANT", "a number"},
    {"UINTCONSTANT", "a whole number"},
    {"BOOLCONSTANT", "true, false"},
    {"$end", "the end of the text"},
    {"INC_OP", "++"},
    {"DEC_OP", "--"},
    {"LE_OP", "<="},
    {"GE_OP", ">="},
    {"EQ_OP", "=="},
    {"NE_OP", "!="},
    {"AND_OP", "&&"},
    {"OR_OP", "||"},
    {"XOR_OP", "^^"},
    {"LEFT_OP", "<<"},
    {"RIGHT_OP", ">>"},
    {"MUL_ASSIGN", "*="},
    {"DIV_ASSIGN", "/="},
    {"ADD_ASSIGN", "+="},
    {"SUB_ASSIGN", "-="},
    {"MOD_ASSIGN", "%="},
};

/// Replaces the token names: `syntax error, unexpected NEW_IDENTIFIER, expecting '('`.
std::string in_words(std::string_view message) {
    std::string text;
    while (!message.empty()) {
        const size_t end = std::min(message.find_first_of(" ,"), message.size());
        const std::string_view word = message.substr(0, end);
        const auto known =
            std::ranges::find(k_tokens, word, &std::pair<std::string_view, std::string_view>::first);
        text += known == std::end(k_tokens) ? word : known->second;
        text += message.substr(end, 1);
        message.remove_prefix(std::min(end + 1, message.size()));
    }
    return text;
}

/// After a call that fits no overload, Mesa lists all overloads, each as an error of its own.
class Candidates {
public:
    /// Returns whether `message` is an entry of the current list.
    bool take(const Message& message) {
        if (listed_ > 0 && message.text.starts_with("   ")) {
            ++listed_;
            return true;
        }
        listed_ = message.text.ends_with("candidates are:") ? 1 : 0;
        return false;
    }
    bool wanted() const { return listed_ - 1 <= k_most; }

private:
    static constexpr int k_most = 3;
    int listed_ = 0; ///< including the line that announces the list
};

/// Returns the name that Mesa's message is about and that is at its column; empty for messages about
/// something else.
std::string_view word_there(std::string_view message) {
    if (message.starts_with("`") && message.ends_with("' undeclared"))
        return message.substr(1, message.size() - 1 - std::string_view("' undeclared").size());
    constexpr std::string_view k_no_function = "no function with name '";
    if (message.starts_with(k_no_function) && message.ends_with("'"))
        return message.substr(k_no_function.size(), message.size() - k_no_function.size() - 1);
    return {};
}

SourceLocation place_of(const Message& message, const DriverPlaces& places, const text::LineMap& lines) {
    if (message.column == 0)
        return lines.locate(message.line);
    const DriverPlace place =
        message.of_preprocessor ? places.of_preprocessor(message.line, message.column)
                                : places.of_compiler(message.line, message.column, word_there(message.text));
    return lines.locate(place.line, place.column);
}

} // namespace

std::vector<DriverMessage> parse_driver_log(std::string_view log, const text::MappedText& source) {
    std::vector<DriverMessage> messages;
    const DriverPlaces places(source.text());
    FollowUpErrors follow_ups;
    Candidates candidates;
    while (!log.empty()) {
        const size_t end = std::min(log.find('\n'), log.size());
        std::string_view line = log.substr(0, end);
        log.remove_prefix(std::min(end + 1, log.size()));
        while (!line.empty() && (line.back() == '\r' || line.back() == '\0' || line.back() == ' '))
            line.remove_suffix(1);
        if (line.empty())
            continue;
        const Message message = read_line(line);
        const SourceLocation where = place_of(message, places, source.lines());
        if (candidates.take(message)) {
            if (candidates.wanted())
                messages.push_back({{where, Severity::note,
                                     std::string(message.text.substr(message.text.find_first_not_of(' ')))},
                                    messages.back().follows});
        } else {
            const bool follows =
                follow_ups.take({message.line, message.column, message.severity, message.text});
            messages.push_back({{where, message.severity, in_words(message.text)}, follows});
        }
    }
    return messages;
}

std::vector<Diagnostic> for_people(const std::vector<DriverMessage>& messages) {
    std::vector<Diagnostic> errors;
    std::vector<Diagnostic> others;
    SourceLocation last;
    size_t following = 0;
    const auto count_following = [&] {
        if (following > 0)
            errors.push_back(
                {last, Severity::note,
                 fmt::format("… and {} more that follow{} from it", following, following == 1 ? "s" : "")});
        following = 0;
    };
    bool of_error = false;
    for (const DriverMessage& message : messages) {
        const Diagnostic& diagnostic = message.diagnostic;
        if (message.follows) {
            following += diagnostic.severity != Severity::note;
            continue;
        }
        if (diagnostic.severity != Severity::note) {
            count_following();
            of_error = diagnostic.severity == Severity::error;
            if (of_error)
                last = diagnostic.where;
        }
        (of_error ? errors : others).push_back(diagnostic);
    }
    count_following();
    errors.insert(errors.end(), others.begin(), others.end());
    return errors;
}

} // namespace tidemark::glsl
