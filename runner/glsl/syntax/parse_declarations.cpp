#include "glsl/syntax/parser.hpp"

#include <algorithm>
#include <iterator>

namespace tidemark::glsl {
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

} // namespace tidemark::glsl
