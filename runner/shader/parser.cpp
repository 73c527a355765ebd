#include "shader/parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

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
        give_up("this is never closed:");
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
        give_up("this is nested too deeply to analyse");
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

namespace {

constexpr std::string_view k_qualifiers[] = {"const",    "in",       "out",           "inout",     "uniform",
                                             "highp",    "mediump",  "lowp",          "flat",      "smooth",
                                             "centroid", "varying",  "noperspective", "invariant", "precise",
                                             "buffer",   "shared",   "attribute",     "coherent",  "patch",
                                             "volatile", "restrict", "readonly",      "writeonly", "sample"};

} // namespace

/// Some qualifiers are names in other GLSL versions: `sample = …`.
bool Parser::at_qualifier() const {
    const bool is_one =
        std::find(std::begin(k_qualifiers), std::end(k_qualifiers), peek().text) != std::end(k_qualifiers);
    return is_one && peek(1).kind == text::TokenKind::identifier;
}

bool Parser::begins_declaration() const {
    if (at_qualifier() || at("struct") || (at("layout") && peek(1).is("(")))
        return true;
    if (!at_name())
        return false;
    if (at_name(1))
        return true;
    if (!peek(1).is("["))
        return false;
    size_t behind = at_ + 1; // `float[3] a`
    while (behind < end_ && words_[behind].is("["))
        behind = behind_brackets(behind);
    return behind < end_ && words_[behind].kind == text::TokenKind::identifier;
}

NodeId Parser::type() {
    const size_t begin = at_;
    while (at_qualifier() || (at("layout") && peek(1).is("("))) {
        const bool layout = at("layout");
        ++at_;
        if (layout)
            skip_brackets();
    }
    const size_t word = at_;
    NodeId members = k_no_node;
    if (at("struct") || (at_name() && peek(1).is("{"))) // `struct S {`, `uniform Block {`
        members = structure();
    else if (at_name() || at("in") || at("out")) // `layout(…) in;`
        ++at_;
    else
        give_up("expected a type");
    while (at("["))
        skip_brackets();
    if (members != k_no_node)
        return make(NodeKind::type, begin, word, {members});
    return make(NodeKind::type, begin, word, {});
}

NodeId Parser::structure() {
    const Nesting nesting(*this, 3);
    const size_t begin = at_;
    take("struct");
    const size_t word = at("{") ? begin : at_++;
    std::vector<NodeId> members;
    expect("{");
    while (!done() && !at("}")) {
        const size_t member = at_;
        const NodeId declared = type();
        members.push_back(declaration(declared, member));
        expect(";");
    }
    expect("}");
    return make(NodeKind::structure, begin, word, members);
}

NodeId Parser::declaration(NodeId type, size_t begin) {
    std::vector<NodeId> parts{type};
    take(","); // the first declarator may be empty: `struct S { float x; }, s;`
    while (at_name()) {
        parts.push_back(declarator());
        if (!take(","))
            break;
    }
    return make(NodeKind::declaration, begin, begin, parts);
}

NodeId Parser::declarator() {
    const size_t begin = at_++;
    std::vector<NodeId> parts;
    while (at("[")) {
        const size_t bracket = at_;
        parts.push_back(brackets(std::nullopt, bracket));
    }
    if (take("="))
        parts.push_back(initialiser());
    return make(NodeKind::declarator, begin, begin, parts);
}

NodeId Parser::parameter() {
    const size_t begin = at_;
    std::vector<NodeId> parts{type()};
    size_t word = at_ > begin ? at_ - 1 : at_;
    if (at_name())
        word = at_++;
    while (at("[")) {
        const size_t bracket = at_;
        parts.push_back(brackets(std::nullopt, bracket));
    }
    return make(NodeKind::parameter, begin, word, parts);
}

NodeId Parser::function(NodeId type, size_t begin) {
    const size_t word = at_++;
    std::vector<NodeId> parts{type};
    expect("(");
    if (at("void") && peek(1).is(")"))
        ++at_;
    while (!done() && !at(")")) {
        parts.push_back(parameter());
        if (!take(","))
            break;
    }
    expect(")");
    if (at("{"))
        parts.push_back(block());
    else
        expect(";");
    return make(NodeKind::function, begin, word, parts);
}

NodeId Parser::global() {
    const size_t begin = at_;
    if (at("precision")) {
        while (!done() && !at(";"))
            ++at_;
        expect(";");
        return make(NodeKind::other, begin, begin, {});
    }
    const NodeId declared = type();
    if (at_name() && peek(1).is("("))
        return function(declared, begin);
    const NodeId node = declaration(declared, begin);
    expect(";");
    tree_.nodes[node].end = uint32_t(at_);
    return node;
}

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
