#include "shader/parser.hpp"

namespace tidemark::glsl {

using text::TokenKind;

namespace {

bool is_assignment(std::string_view word) {
    if (word == "=")
        return true;
    return word.size() >= 2 && word.back() == '=' && word != "==" && word != "!=" && word != "<=" &&
           word != ">=";
}

/// Returns the precedence of a binary operator; 0 for any other text.
int rank_of(std::string_view word) {
    struct Rank {
        std::string_view op;
        int rank;
    };
    constexpr Rank k_ranks[] = {{"||", 1}, {"^^", 2}, {"&&", 3}, {"|", 4},  {"^", 5},  {"&", 6},  {"==", 7},
                                {"!=", 7}, {"<", 8},  {">", 8},  {"<=", 8}, {">=", 8}, {"<<", 9}, {">>", 9},
                                {"+", 10}, {"-", 10}, {"*", 11}, {"/", 11}, {"%", 11}};
    for (const Rank& rank : k_ranks)
        if (rank.op == word)
            return rank.rank;
    return 0;
}

} // namespace

NodeId Parser::expression() {
    const Nesting nesting(*this, 2);
    const size_t begin = at_;
    NodeId left = assignment();
    while (at(",")) {
        const size_t word = at_++;
        left = make(NodeKind::comma, begin, word, {left, assignment()});
    }
    return left;
}

NodeId Parser::assignment() {
    const Nesting nesting(*this, 1);
    const size_t begin = at_;
    const NodeId target = conditional();
    if (done() || peek().kind != TokenKind::punctuation || !is_assignment(peek().text))
        return target;
    const size_t word = at_++;
    return make(NodeKind::assign, begin, word, {target, assignment()});
}

NodeId Parser::conditional() {
    const size_t begin = at_;
    const NodeId question = binary(0);
    if (!at("?"))
        return question;
    const size_t word = at_++;
    const NodeId yes = expression();
    expect(":");
    return make(NodeKind::conditional, begin, word, {question, yes, assignment()});
}

NodeId Parser::binary(int rank) {
    const size_t begin = at_;
    NodeId left = unary();
    for (int here = rank_of(peek().text); here > rank; here = rank_of(peek().text)) {
        const size_t word = at_++;
        left = make(NodeKind::binary, begin, word, {left, binary(here)});
    }
    return left;
}

NodeId Parser::unary() {
    const bool prefix = at("-") || at("+") || at("!") || at("~") || at("++") || at("--");
    if (!prefix)
        return postfix();
    const Nesting nesting(*this, 1);
    const size_t word = at_++;
    return make(NodeKind::prefix, word, word, {unary()});
}

NodeId Parser::postfix() {
    const size_t begin = at_;
    NodeId node = primary();
    for (;;) {
        if (at("(")) {
            node = call(node, begin);
        } else if (at("[")) {
            node = brackets(node, begin);
        } else if (at(".") && peek(1).kind == TokenKind::identifier) {
            const size_t word = at_ + 1;
            at_ += 2;
            node = make(NodeKind::member, begin, word, {node});
        } else if (at("++") || at("--")) {
            const size_t word = at_++;
            node = make(NodeKind::postfix, begin, word, {node});
        } else {
            return node;
        }
    }
}

NodeId Parser::primary() {
    const size_t begin = at_;
    if (take("(")) {
        const Nesting nesting(*this, 1);
        const NodeId inside = expression();
        expect(")");
        return make(NodeKind::parenthesis, begin, begin, {inside});
    }
    if (peek().kind == TokenKind::number) {
        ++at_;
        return make(NodeKind::literal, begin, begin, {});
    }
    if (!at_name()) {
        give_up("expected an expression");
        return absent();
    }
    ++at_;
    return make(NodeKind::name, begin, begin, {});
}

NodeId Parser::call(NodeId callee, size_t begin) {
    const Nesting nesting(*this, 1);
    const size_t word = at_;
    expect("(");
    std::vector<NodeId> parts{callee};
    if (at("void") && peek(1).is(")"))
        ++at_;
    while (!done() && !at(")")) {
        parts.push_back(assignment());
        if (!take(","))
            break;
    }
    expect(")");
    return make(NodeKind::call, begin, word, parts);
}

NodeId Parser::brackets(std::optional<NodeId> what, size_t begin) {
    const size_t word = at_;
    expect("[");
    const NodeId which = at("]") ? absent() : expression();
    expect("]");
    if (!what)
        return make(NodeKind::index, begin, word, {which});
    return make(NodeKind::index, begin, word, {*what, which});
}

NodeId Parser::initialiser() {
    const size_t begin = at_;
    if (!take("{"))
        return assignment();
    const Nesting nesting(*this, 2);
    std::vector<NodeId> elements;
    while (!done() && !at("}")) {
        elements.push_back(initialiser());
        if (!take(","))
            break;
    }
    expect("}");
    return make(NodeKind::braces, begin, begin, elements);
}

} // namespace tidemark::glsl
