#include "glsl/cure/written.hpp"

#include "glsl/syntax/builtin_functions.hpp"

#include <algorithm>

namespace tidemark::glsl {
namespace {

constexpr size_t k_longest_repeated = 60;

SourceLocation place_of(const ParsedText& text, size_t token) {
    const text::Token& at = text.tokens()[token];
    return text.source().lines().locate(at.line, at.column);
}

bool has_no_effect(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    const SyntaxTree& tree = text.tree();
    const Node& node = tree[id];
    const std::string_view word = text.word(node.word);
    if (node.kind == NodeKind::assign || node.kind == NodeKind::postfix || word == "++" || word == "--")
        return false;
    if (node.kind == NodeKind::call) {
        const std::string_view name = called_name(text, id);
        const BuiltinFunction* const function = find_builtin(name);
        const bool only_reads = function && (function->is(Trait::pure) || function->is(Trait::derivative) ||
                                             function->is(Trait::implicit_lod));
        if (facts.function(name) || !(facts.is_type(name) || only_reads))
            return false;
    }
    for (NodeId child = node.first_child; child != k_no_node; child = tree[child].next)
        if (!has_no_effect(text, facts, child))
            return false;
    return true;
}

/// Returns the tokens between two separators of the call, whatever macros the argument is made of.
std::optional<WrittenTokens> between_signs(const ParsedText& text, const Node& argument) {
    const Word &before = text.words()[argument.begin - 1], &behind = text.words()[argument.end];
    if (before.from_macro() != behind.from_macro() || before.spelled + 1 >= behind.spelled ||
        (before.from_macro() && before.used != behind.used))
        return std::nullopt;
    return WrittenTokens{before.spelled + 1u, behind.spelled - 1u};
}

std::optional<WrittenTokens> edges(const ParsedText& text, const Node& node, bool in_macro) {
    const Word &first = text.words()[node.begin], &last = text.words()[node.end - 1];
    if (!in_macro) {
        const bool takes_arguments = last.from_macro() && last.used + 1u < text.tokens().size() &&
                                     text.tokens()[last.used + 1u].is("(");
        return takes_arguments ? std::nullopt : std::optional(WrittenTokens{first.used, last.used});
    }
    if (!first.from_macro() || !last.from_macro() || first.used != last.used || first.spelled > last.spelled)
        return std::nullopt;
    return WrittenTokens{first.spelled, last.spelled};
}

} // namespace

std::optional<WrittenTokens> written_for(const ParsedText& text, NodeId id, NodeId operation) {
    const SyntaxTree& tree = text.tree();
    const bool in_macro = text.words()[tree[operation].word].from_macro();
    const bool is_argument = id != operation && tree[operation].kind == NodeKind::call;
    const auto tokens = is_argument ? between_signs(text, tree[id]) : edges(text, tree[id], in_macro);
    if (!tokens)
        return std::nullopt;
    const SourceLocation from = place_of(text, tokens->first), to = place_of(text, tokens->last);
    // A macro's body that spans several joined lines is left as it is.
    if (from.file.empty() || from.file != to.file || (in_macro && from.line != to.line))
        return std::nullopt;
    return tokens;
}

Wrap wrapped(const ParsedText& text, WrittenTokens tokens, std::string front, std::string behind) {
    const auto word = [&](size_t token) {
        return WrittenWord{place_of(text, token), std::string(text.tokens()[token].text)};
    };
    return {word(tokens.first), word(tokens.last), std::move(front), std::move(behind)};
}

Wrap in_place_of(const ParsedText& text, WrittenTokens tokens, std::string instead) {
    Wrap wrap = wrapped(text, tokens, std::move(instead), "");
    wrap.replaces = true;
    return wrap;
}

NodeId body_of_function(const ParsedText& text, NodeId function) {
    const SyntaxTree& tree = text.tree();
    for (const NodeId part : tree.children(function))
        if (tree[part].kind == NodeKind::block)
            return part;
    return k_no_node;
}

std::vector<NodeId> parameters_of(const ParsedText& text, NodeId function) {
    std::vector<NodeId> parameters;
    for (const NodeId part : text.tree().children(function))
        if (text.tree()[part].kind == NodeKind::parameter)
            parameters.push_back(part);
    return parameters;
}

NodeId find_main_image(const ParsedText& text) {
    for (NodeId id = 1; id < text.tree().nodes.size(); ++id)
        if (text.tree()[id].kind == NodeKind::function && text.word_of(id) == "mainImage" &&
            body_of_function(text, id) != k_no_node)
            return id;
    return k_no_node;
}

std::optional<Wrap> at_word(const ParsedText& text, size_t word, std::string front, std::string behind) {
    const Word& at = text.words()[word];
    if (at.from_macro() || text.spelled(word).file.empty())
        return std::nullopt;
    return wrapped(text, {at.spelled, at.spelled}, std::move(front), std::move(behind));
}

std::string fresh_name(const ParsedText& text, std::string_view wanted, size_t number) {
    for (;; ++number) {
        std::string name = std::string(wanted) + (number == 1 ? "" : std::to_string(number));
        if (std::ranges::none_of(text.words(), [&](const Word& word) { return word.text == name; }))
            return name;
    }
}

std::optional<std::string> said_again(const ParsedText& text, const TreeFacts& facts, NodeId id,
                                      WrittenTokens tokens) {
    const text::Token &first = text.tokens()[tokens.first], &last = text.tokens()[tokens.last];
    const std::string_view words =
        std::string_view(text.source().text()).substr(first.begin, last.end() - first.begin);
    if (words.size() > k_longest_repeated || first.line != last.line || words.find("//") != words.npos ||
        !has_no_effect(text, facts, id))
        return std::nullopt;
    return std::string(words);
}

} // namespace tidemark::glsl
