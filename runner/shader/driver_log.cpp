// Finds the driver's errors that only follow from an earlier error: a compiler that continues after an
// unknown identifier reports every expression around it.

#include "shader/driver_log.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/tokens.hpp"
#include "shader/builtin_functions.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace tidemark::glsl {

/// Receives the messages of one log in order.
class FollowUpErrors {
public:
    struct Message {
        int line = 0;   ///< as the driver printed it; 0: none
        int column = 0; ///< likewise
        Severity severity = Severity::error;
        std::string_view text;
    };

    /// Returns whether this message follows from an earlier one.
    bool take(const Message& message);

private:
    bool follows(const Message& message, const std::set<std::string>& words) const;

    std::optional<Message> last_;   ///< the last error; only its numbers are valid, its text may be gone
    std::set<std::string> named_;   ///< identifiers that errors quoted
    std::set<std::string> unknown_; ///< messages about unknown identifiers
    int unknown_line_ = 0;          ///< line of the last of those
};

namespace {

bool has(std::string_view text, std::string_view part) {
    return text.find(part) != text.npos;
}

template <size_t N>
bool has_any(std::string_view text, const std::array<std::string_view, N>& parts) {
    return std::ranges::any_of(parts, [&](std::string_view part) { return has(text, part); });
}

/// Messages of Mesa, NVIDIA, ANGLE with glslang and Intel, AMD, and Apple.
constexpr std::array<std::string_view, 6> k_unknown_word = {"undeclared",
                                                            "undefined variable",
                                                            "Undeclared identifier",
                                                            "no function with name",
                                                            "no matching overloaded function",
                                                            "not declared"};

/// Mesa's type of a failed expression, alone and in the types of a call.
constexpr std::array<std::string_view, 5> k_of_failed = {"of type error", "(error,", "(error)", ", error,",
                                                         ", error)"};

/// Lines without information about the text: counts and final lines.
constexpr std::array<std::string_view, 3> k_no_news = {"compilation errors", "compilation terminated",
                                                       "No code generated"};

/// Mesa reports this for a failed value too; it quotes the function, which is not at fault.
constexpr std::string_view k_returned = "could not implicitly convert return value";

/// Recognises type names such as `vec3`, `float`, `dmat2x3`, and the operator names that ANGLE quotes.
bool is_of_the_language(std::string_view word) {
    constexpr std::array<std::string_view, 12> k_words = {"float",  "int",    "uint",        "bool",
                                                          "double", "highp",  "mediump",     "lowp",
                                                          "const",  "assign", "constructor", "return"};
    constexpr std::array<std::string_view, 3> k_families = {"vec", "mat", "sampler"};
    return std::ranges::find(k_words, word) != k_words.end() ||
           std::ranges::any_of(k_families, [&](std::string_view family) {
               return word.find(family) <= 1; // the name may have a prefix, as in ivec2
           });
}

/// Returns the quoted texts that are identifiers of the author, or begin with one, as a call does.
std::set<std::string> quoted_words(std::string_view text) {
    std::set<std::string> words;
    if (text.starts_with(k_returned))
        return words;
    for (size_t at = text.find_first_of("`'\""); at != text.npos; at = text.find_first_of("`'\"", at + 1)) {
        const bool opens = at == 0 || !text::is_word_character(text[at - 1]);
        const auto rest = text.substr(at + 1);
        const std::string word(rest.begin(), std::ranges::find_if_not(rest, text::is_word_character));
        if (opens && !word.empty() && !is_of_the_language(word))
            words.insert(word);
    }
    return words;
}

} // namespace

bool FollowUpErrors::follows(const Message& message, const std::set<std::string>& words) const {
    if (has_any(message.text, k_no_news))
        return true;
    if (message.severity == Severity::warning) // of a variable whose value failed
        return has(message.text, "used uninitialized");
    if (unknown_.contains(std::string(message.text)))
        return true;
    if (has_any(message.text, k_of_failed))
        return true;
    if (!std::ranges::includes(named_, words))
        return false;
    // Mesa checks an expression after its parts, and reports it at the column where the expression begins.
    if (message.column > 0 && last_->column > 0)
        return message.line < last_->line || (message.line == last_->line && message.column <= last_->column);
    return message.line > 0 && message.line == unknown_line_;
}

bool FollowUpErrors::take(const Message& message) {
    if (message.severity == Severity::note)
        return false;
    const std::set<std::string> words = quoted_words(message.text);
    const bool follows = last_ && this->follows(message, words);
    if (message.severity != Severity::error)
        return follows;
    last_ = message;
    named_.insert(words.begin(), words.end());
    if (has_any(message.text, k_unknown_word)) {
        unknown_.emplace(message.text);
        unknown_line_ = message.line;
    }
    return follows;
}

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

/// Names that Tidemark gives the driver for what authors call otherwise.
constexpr std::pair<std::string_view, std::string_view> k_given_names[] = {
    {"tidemark_author_main", "main"},   {"tidemark_promoted_main", "main"},
    {"tidemark_color", "gl_FragColor"}, {"tidemark_output", "the output"},
    {"tidemark_pixel", "fragColor"},    {"tidemark_at", "fragCoord"},
    {"tidemark_VERSION", "__VERSION__"}};

/// Returns the author's name for a name that the driver was given.
std::string_view authors_name(std::string_view name) {
    constexpr std::string_view k_own = "tidemark_", k_moved = "st_";
    const auto given =
        std::ranges::find(k_given_names, name, &std::pair<std::string_view, std::string_view>::first);
    if (given != std::end(k_given_names))
        return given->second;
    if (name.starts_with(k_moved)) { // a word of today's language, or an author's overload of a function
        const std::string_view word = name.substr(k_moved.size());
        const bool moved =
            is_one_of(word, k_reserved_words) || is_keyword(word) || find_builtin(word) || value_type(word);
        return moved ? word : name;
    }
    if (!name.starts_with(k_own))
        return name;
    name.remove_prefix(k_own.size());
    for (const std::string_view prefix : {"double_", "float_", "plain_", "setting_"})
        if (name.starts_with(prefix) && name.size() > prefix.size())
            return name.substr(prefix.size());
    return name == "single" ? "float" : name;
}

/// Returns the message with the author's names.
std::string with_authors_names(std::string_view message) {
    std::string text;
    while (!message.empty()) {
        const auto end = std::ranges::find_if_not(message, text::is_word_character);
        const std::string_view word = message.substr(0, size_t(end - message.begin()));
        text += authors_name(word);
        message.remove_prefix(word.size());
        text += message.substr(0, 1);
        message.remove_prefix(std::min<size_t>(message.size(), 1));
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
                messages.push_back(
                    {{where, Severity::note,
                      with_authors_names(message.text.substr(message.text.find_first_not_of(' ')))},
                     messages.back().follows});
        } else {
            const bool follows =
                follow_ups.take({message.line, message.column, message.severity, message.text});
            messages.push_back(
                {{where, message.severity, with_authors_names(in_words(message.text))}, follows});
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

namespace {

/// Drivers also end a message with a NUL.
constexpr std::string_view k_blanks{" \n\0", 3};

constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Reads a count; the whole of `text` must be digits.
std::optional<int> count_of(std::string_view text) {
    return !text.empty() && is_digit(text.front()) ? number_from<int>(text) : std::nullopt;
}

/// Reads `123 inst` or `inst: 123`; the whole item must match.
std::optional<int> count_in(std::string_view item) {
    for (const std::string_view word : {" instructions", " inst"})
        if (item.ends_with(word))
            return count_of(item.substr(0, item.size() - word.size()));
    constexpr std::string_view k_name = "inst: ";
    return item.starts_with(k_name) ? count_of(item.substr(k_name.size())) : std::nullopt;
}

} // namespace

std::optional<InstructionCount> read_instruction_count(std::string_view message) {
    message = trimmed(message, k_blanks);
    const std::string_view first = message.substr(0, message.find(','));
    const size_t colon = first.rfind(": ");
    if (colon == std::string_view::npos)
        return std::nullopt;
    const std::string_view name = first.substr(0, colon);
    constexpr std::string_view k_shader = " shader";
    if (name.ends_with(k_shader) || name.find(" prog ") != std::string_view::npos) {
        const auto count = count_in(first.substr(colon + 2));
        const size_t bare = name.size() - (name.ends_with(k_shader) ? k_shader.size() : 0);
        return count ? std::optional(InstructionCount{std::string(name.substr(0, bare)), *count})
                     : std::nullopt;
    }
    if (name != "type")
        return std::nullopt;
    for (std::string_view rest = message.substr(first.size()); !rest.empty();) {
        rest.remove_prefix(1);
        const std::string_view item = rest.substr(0, rest.find(','));
        if (const auto count = count_in(trimmed(item, k_blanks)))
            return InstructionCount{std::string(first), *count};
        rest.remove_prefix(item.size());
    }
    return std::nullopt;
}

} // namespace tidemark::glsl
