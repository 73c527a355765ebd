// Syntax tree of a GLSL text after macro expansion: functions, statements and expressions as nodes that refer
// to their words. Has no types and no scopes.
#pragma once

#include "base/result.hpp"
#include "glsl/syntax/expand.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// Children are listed in text order; a child in `[x]` may be `absent`.
enum class NodeKind : unsigned char {
    absent, ///< an empty clause: in `for (;;)`, `[]`
    // Expressions. `word` is the operator, the name or the number.
    name,
    literal,
    prefix,      ///< operand
    postfix,     ///< operand; ++ and --
    binary,      ///< left, right; not an assignment
    assign,      ///< target, value; = and compound assignments
    conditional, ///< condition, yes, no; `word` is the ?
    comma,       ///< first, second
    call,        ///< callee (name; index for an array's constructor; member for .length), arguments
    index,       ///< array, [index]
    member,      ///< object; `word` is the member
    parenthesis, ///< expression inside
    braces,      ///< elements of an initialiser
    // Declarations.
    type,        ///< qualifiers, type name and array brackets, all as words; [structure]
    structure,   ///< declarations of its members; `word` is its name, or `struct`
    declaration, ///< type, declarators; `uniform Block { … } name`
    declarator,  ///< `word` is its name; its brackets (kind index, without an array child), then its [value]
    parameter,   ///< type, then brackets as in a declarator; `word` is its name, or the last word of its type
    function,    ///< type, parameters, [body]; `word` is its name
    other,       ///< `precision …;`, `layout(…) in;`: words only
    // Statements. `word` is the keyword.
    block,            ///< statements
    expression,       ///< expression
    if_else,          ///< condition, yes, [no]
    loop_for,         ///< first statement, [condition], [step], body
    loop_while,       ///< condition, body
    loop_do,          ///< body, condition
    switch_on,        ///< selector, body
    label,            ///< [value]: case, default
    return_statement, ///< [value]: return
    jump,             ///< break, continue, discard
    // The whole text.
    text,
};

using NodeId = uint32_t;
inline constexpr NodeId k_no_node = 0; ///< Means "no node": node 0 is the root, which is never a child.

struct Node {
    NodeKind kind = NodeKind::absent;
    uint16_t height = 0; ///< height of the subtree
    uint32_t begin = 0;  ///< its words are [begin, end)
    uint32_t end = 0;
    uint32_t word = 0;
    NodeId parent = k_no_node;
    NodeId first_child = k_no_node;
    NodeId next = k_no_node; ///< sibling
};

/// Maximum length of a path from the root, so that recursion over the tree is safe.
inline constexpr int k_most_height = 2000;

struct SyntaxTree {
    std::vector<Node> nodes; ///< node 0 is the root, of kind text

    const Node& operator[](NodeId id) const { return nodes[id]; }
    std::vector<NodeId> children(NodeId id) const;
    /// Returns k_no_node if there are not enough children.
    NodeId child(NodeId id, size_t index) const;
    size_t child_count(NodeId id) const;
    /// Returns the nearest enclosing node of that kind, `id` itself included; k_no_node if there is none.
    NodeId around(NodeId id, NodeKind kind) const;
    bool is_within(NodeId id, NodeId ancestor) const;
};

bool is_expression(NodeKind kind);
bool is_loop(NodeKind kind);

/// Parses in time linear in the words. Fails if the text is not GLSL that the parser supports, or is nested
/// deeper than k_most_height; the error has the place of the word, from `tokens` and `lines`.
Result<SyntaxTree> parse(const std::vector<Word>& words, const std::vector<text::Token>& tokens,
                         const text::LineMap& lines);

} // namespace tidemark::glsl
