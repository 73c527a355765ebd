#include "glsl/syntax/parsed_text.hpp"

#include "base/try.hpp"

#include <algorithm>

namespace tidemark::glsl {

Result<std::unique_ptr<const ParsedText>>
ParsedText::read(text::MappedText source, std::span<const KnownMacro> known, bool all_known) {
    // make_unique cannot call the private constructor
    std::unique_ptr<ParsedText> result(new ParsedText(std::move(source)));
    const text::LineMap& lines = result->source_.lines();
    result->tokens_ = text::tokenize(result->source_.text());
    result->preprocessed_ = preprocess(result->tokens_, known, all_known);
    result->expansion_ = TRY(expand(result->tokens_, result->preprocessed_, lines));
    result->tree_ = TRY(parse(result->expansion_.words, result->tokens_, lines));
    return result;
}

std::string ParsedText::headers() const {
    std::string text;
    for (const size_t hash : expansion_.headers) {
        const size_t end = text::end_of_directive(tokens_, hash);
        for (size_t i = hash; i < end; ++i) {
            text += i > hash && !tokens_[i].glued ? " " : "";
            text += tokens_[i].text;
        }
        text += '\n';
    }
    return text;
}

bool ParsedText::is_es() const {
    return std::ranges::any_of(expansion_.headers, [&](size_t hash) {
        const size_t end = text::end_of_directive(tokens_, hash);
        return tokens_[hash + 1].is("version") && tokens_[end - 1].is("es");
    });
}

SourceLocation ParsedText::place(size_t token) const {
    return source_.lines().locate(tokens_[token].line, tokens_[token].column);
}

std::string ParsedText::excerpt(NodeId id) const {
    const Node& node = tree_[id];
    std::string text;
    for (size_t i = node.begin; i < node.end; ++i) {
        if (i > node.begin && stand_apart(expansion_.words[i - 1], expansion_.words[i]))
            text += ' ';
        text += expansion_.words[i].text;
    }
    return text;
}

/// Decides on a blank as in the author's text if both are neighbours there; else by common style.
bool ParsedText::stand_apart(const Word& left, const Word& right) const {
    const text::Token& token = tokens_[right.spelled];
    const bool neighbours = right.spelled > left.spelled &&
                            tokens_[left.spelled].begin + left.text.size() <= token.begin &&
                            right.spelled - left.spelled <= left.text.size();
    if (neighbours)
        return !token.glued;
    constexpr std::string_view k_sticks_left = ")],;.";
    constexpr std::string_view k_sticks_right = "([.!~";
    if (right.is("(") || right.is("["))
        return left.kind != text::TokenKind::identifier &&
               k_sticks_right.find(left.text.back()) == std::string_view::npos;
    return k_sticks_left.find(right.text[0]) == std::string_view::npos &&
           k_sticks_right.find(left.text.back()) == std::string_view::npos;
}

} // namespace tidemark::glsl
