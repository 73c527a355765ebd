#include "glsl/syntax/parser.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::glsl {

using text::TokenKind;

const Word& Parser::peek(size_t ahead) const {
    static const Word k_none;
    return at_ + ahead < end_ ? words_[at_ + ahead] : k_none;
}

bool Parser::at_name(size_t ahead) const {
    return peek(ahead).kind == TokenKind::identifier && !is_statement_keyword(peek(ahead).text);
}

bool Parser::take(std::string_view text) {
    if (!at(text))
        return false;
    ++at_;
    return true;
}

void Parser::expect(std::string_view text) {
    if (!take(text))
        give_up(fmt::format("expected '{}'", text));
}

void Parser::give_up(std::string_view message) {
    if (error_)
        return;
    SourceLocation where;
    std::string found = "the end of the text";
    if (!words_.empty()) {
        const Word& word = words_[std::min(at_, words_.size() - 1)];
        where = lines_.locate(tokens_[word.used].line, tokens_[word.used].column);
        if (at_ < words_.size())
            found = fmt::format("'{}'", word.text.substr(0, 40));
    }
    error_ = error_at(where, fmt::format("{} at {}", message, found));
    at_ = end_; // every rule returns at the end
}

size_t Parser::behind_brackets(size_t from) const {
    int depth = 0;
    for (size_t i = from; i < end_; ++i) {
        if (words_[i].is("(") || words_[i].is("["))
            ++depth;
        else if (words_[i].is(")") || words_[i].is("]"))
            --depth;
        else if (words_[i].is(";") || words_[i].is("{") || words_[i].is("}"))
            return end_;
        if (depth == 0)
            return i + 1;
    }
    return end_;
}

void Parser::skip_brackets() {
    const size_t behind = behind_brackets(at_);
    if (behind >= end_)
        give_up("this is closed nowhere:");
    else
        at_ = behind;
}

NodeId Parser::make(NodeKind kind, size_t begin, size_t word, std::span<const NodeId> children) {
    const auto id = NodeId(tree_.nodes.size());
    Node node;
    node.kind = kind;
    node.begin = uint32_t(begin);
    node.end = uint32_t(std::max(begin, at_));
    node.word = uint32_t(word);
    tree_.nodes.push_back(node);
    adopt(id, children);
    return id;
}

void Parser::adopt(NodeId parent, std::span<const NodeId> children) {
    NodeId last = k_no_node;
    int height = 0;
    for (const NodeId child : children) {
        tree_.nodes[child].parent = parent;
        (last == k_no_node ? tree_.nodes[parent].first_child : tree_.nodes[last].next) = child;
        last = child;
        height = std::max(height, tree_.nodes[child].height + 1);
    }
    if (height > k_most_height)
        give_up("this nests too deeply to follow");
    tree_.nodes[parent].height = uint16_t(height);
}

Result<SyntaxTree> Parser::run() {
    std::vector<NodeId> globals;
    while (!done()) {
        if (take(";"))
            continue;
        globals.push_back(global());
    }
    Node& root = tree_.nodes[0];
    root.kind = NodeKind::text;
    root.end = uint32_t(end_);
    adopt(0, globals);
    if (error_)
        return fail(*std::move(error_));
    return std::move(tree_);
}

Result<SyntaxTree> parse(const std::vector<Word>& words, const std::vector<text::Token>& tokens,
                         const text::LineMap& lines) {
    return Parser(words, tokens, lines).run();
}

} // namespace tidemark::glsl
