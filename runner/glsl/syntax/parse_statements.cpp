#include "glsl/syntax/parser.hpp"

#include <algorithm>
#include <iterator>

namespace tidemark::glsl {

bool is_statement_keyword(std::string_view word) {
    constexpr std::string_view k_of_statements[] = {"if",     "else",   "for",      "while",
                                                    "do",     "switch", "case",     "default",
                                                    "return", "break",  "continue", "discard"};
    return std::find(std::begin(k_of_statements), std::end(k_of_statements), word) !=
           std::end(k_of_statements);
}

NodeId Parser::statement() {
    const Nesting nesting(*this, 1);
    const size_t begin = at_;
    if (at("{"))
        return block();
    if (take(";"))
        return make(NodeKind::expression, begin, begin, {});
    if (is_statement_keyword(peek().text))
        return keyword_statement();
    if (at("precision")) {
        while (!done() && !at(";"))
            ++at_;
        expect(";");
        return make(NodeKind::other, begin, begin, {});
    }
    if (begins_declaration()) {
        const NodeId declared = type();
        const NodeId node = declaration(declared, begin);
        expect(";");
        tree_.nodes[node].end = uint32_t(at_);
        return node;
    }
    const NodeId inside = expression();
    expect(";");
    return make(NodeKind::expression, begin, begin, {inside});
}

NodeId Parser::keyword_statement() {
    const size_t begin = at_;
    if (at("if"))
        return if_else();
    if (at("for"))
        return for_loop();
    if (at("while"))
        return while_loop();
    if (at("do"))
        return do_loop();
    if (at("switch"))
        return switch_on();
    if (at("case") || at("default"))
        return label();
    if (take("return")) {
        const NodeId value = at(";") ? absent() : expression();
        expect(";");
        return make(NodeKind::return_statement, begin, begin, {value});
    }
    if (at("else"))
        give_up("expected a statement");
    ++at_;
    expect(";");
    return make(NodeKind::jump, begin, begin, {});
}

NodeId Parser::block() {
    const size_t begin = at_;
    expect("{");
    std::vector<NodeId> statements;
    while (!done() && !at("}"))
        statements.push_back(statement());
    expect("}");
    return make(NodeKind::block, begin, begin, statements);
}

NodeId Parser::if_else() {
    const size_t begin = at_++;
    expect("(");
    const NodeId question = expression();
    expect(")");
    const NodeId yes = statement();
    if (!take("else"))
        return make(NodeKind::if_else, begin, begin, {question, yes});
    return make(NodeKind::if_else, begin, begin, {question, yes, statement()});
}

NodeId Parser::condition() {
    const size_t begin = at_;
    if (!begins_declaration())
        return expression();
    return declaration(type(), begin);
}

NodeId Parser::for_loop() {
    const size_t begin = at_++;
    expect("(");
    const NodeId first = statement();
    const NodeId question = at(";") ? absent() : condition();
    expect(";");
    const NodeId step = at(")") ? absent() : expression();
    expect(")");
    return make(NodeKind::loop_for, begin, begin, {first, question, step, statement()});
}

NodeId Parser::while_loop() {
    const size_t begin = at_++;
    expect("(");
    const NodeId question = condition();
    expect(")");
    return make(NodeKind::loop_while, begin, begin, {question, statement()});
}

NodeId Parser::do_loop() {
    const size_t begin = at_++;
    const NodeId body = statement();
    expect("while");
    expect("(");
    const NodeId question = expression();
    expect(")");
    expect(";");
    return make(NodeKind::loop_do, begin, begin, {body, question});
}

NodeId Parser::switch_on() {
    const size_t begin = at_++;
    expect("(");
    const NodeId selector = expression();
    expect(")");
    return make(NodeKind::switch_on, begin, begin, {selector, block()});
}

NodeId Parser::label() {
    const size_t begin = at_;
    const bool has_value = at("case");
    ++at_;
    const NodeId value = has_value ? expression() : absent();
    expect(":");
    return make(NodeKind::label, begin, begin, {value});
}

} // namespace tidemark::glsl
