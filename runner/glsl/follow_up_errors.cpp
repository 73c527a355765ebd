#include "glsl/follow_up_errors.hpp"

#include "text/tokens.hpp"

#include <algorithm>
#include <array>

namespace tidemark::glsl {
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

} // namespace tidemark::glsl
