// A light syntax tree of a GLSL text without macros: functions, statements and expressions as nodes that
// point back at their words. No types, no scopes: it says what belongs to what, and nothing of what it means.
#pragma once

#include "base/result.hpp"
#include "glsl/syntax/expand.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// Children are listed in the order of the text; `[x]` may be `absent`.
enum class NodeKind : unsigned char {
    absent, ///< nothing stands here: a clause of `for (;;)`, `[]`
    // Expressions. `word` is the operator, the name or the number.
    name,
    literal,
    prefix,      ///< operand
    postfix,     ///< operand; ++ and --
    binary,      ///< left, right; no assignment
    assign,      ///< target, value; = and its kind
    conditional, ///< condition, yes, no; `word` is the ?
    comma,       ///< first, second
    call,        ///< what is called (name; index for an array's constructor; member for .length), arguments
    index,       ///< what, [which]
    member,      ///< what; `word` is the member
    parenthesis, ///< inside
    braces,      ///< elements of an initialiser
    // Declarations.
    type,        ///< qualifiers and the type's name, its array brackets too: only words; [structure]
    structure,   ///< declarations of its members; `word` is its name, or `struct`
    declaration, ///< type, declarators; `uniform Block { … } name`
    declarator,  ///< `word` is its name; indices of its brackets (kind index, no `what`), then its [value]
    parameter,   ///< type, then as a declarator; `word` is its name, or the last word of its type
    function,    ///< type, parameters, [body]; `word` is its name
    other,       ///< `precision …;`, `layout(…) in;`: only words
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
    // All of it.
    text,
};

using NodeId = uint32_t;
inline constexpr NodeId k_no_node = 0; ///< the root is no child, so its number means none

struct Node {
    NodeKind kind = NodeKind::absent;
    uint16_t height = 0; ///< of the tree below
    uint32_t begin = 0;  ///< its words are [begin, end)
    uint32_t end = 0;
    uint32_t word = 0;
    NodeId parent = k_no_node;
    NodeId first_child = k_no_node;
    NodeId next = k_no_node; ///< sibling
};

/// No path from the root is longer, so that walking down by recursion is safe.
inline constexpr int k_most_height = 2000;

struct SyntaxTree {
    std::vector<Node> nodes; ///< node 0 is the root, of kind text

    const Node& operator[](NodeId id) const { return nodes[id]; }
    std::vector<NodeId> children(NodeId id) const;
    /// k_no_node when there are not so many.
    NodeId child(NodeId id, size_t index) const;
    size_t child_count(NodeId id) const;
    /// The nearest node of that kind around `id`, itself included; k_no_node outside of any.
    NodeId around(NodeId id, NodeKind kind) const;
    bool is_within(NodeId id, NodeId ancestor) const;
};

bool is_expression(NodeKind kind);
bool is_loop(NodeKind kind);

/// Linear in the words. Fails where the text is no GLSL that we can follow, or nests deeper than
/// k_most_height; the error's place is that of the word in `tokens`, through `lines`.
Result<SyntaxTree> parse(const std::vector<Word>& words, const std::vector<text::Token>& tokens,
                         const text::LineMap& lines);

} // namespace tidemark::glsl
