// Expands macros: returns the code that the preprocessor leaves. Every word keeps two source tokens: the one
// that spells it, and the outermost macro use that produced it.
#pragma once

#include "base/error.hpp"
#include "base/mapped_text.hpp"
#include "base/tokens.hpp"
#include "shader/token_reading.hpp"

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::glsl {

/// A token of the expanded code. An operator of several characters is one word.
struct Word {
    std::string_view text;
    /// index of the source token that it was cut from; inside a macro's body if a macro produced it
    uint32_t spelled = 0;
    /// index of the outermost macro's name in the code; the same token if no macro is involved
    uint32_t used = 0;
    text::TokenKind kind = text::TokenKind::punctuation;

    bool is(std::string_view wanted) const { return text == wanted; }
    bool from_macro() const { return spelled != used; }
};

/// The views stay valid as long as both the source text and this value exist.
struct Expansion {
    std::vector<Word> words;
    std::vector<size_t> headers;    ///< the `#` of each #version and #extension, as token indices
    std::deque<std::string> pasted; ///< texts made by `##` and __LINE__
};

/// Expands all macros. Fails (ErrorCode::load), with the line, if a condition cannot be evaluated without the
/// driver, if a macro call has no end, and if the result exceeds 64 words for each source token (plus 10,000;
/// at most 4 million).
Result<Expansion> expand(const std::vector<text::Token>& tokens, const Preprocessed& preprocessed,
                         const text::LineMap& lines);

// Syntax tree of a GLSL text after macro expansion: functions, statements and expressions as nodes that refer
// to their words. Has no types and no scopes.

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

// A complete GLSL text with its tokens, macros, expanded words and syntax tree. Every word maps back to the
// author's line. All passes over the tree start from it.

class ParsedText {
public:
    /// Parses `source`, the full text for the driver with its #version. `known` lists the macros that the
    /// driver defines; if `all_known` is false, the driver may define others that begin with GL_. The error
    /// has the place at which parsing stopped.
    static Result<std::unique_ptr<const ParsedText>>
    read(text::MappedText source, std::span<const KnownMacro> known, bool all_known = true);
    ParsedText(const ParsedText&) = delete;
    ParsedText& operator=(const ParsedText&) = delete;

    const text::MappedText& source() const { return source_; }
    const std::vector<text::Token>& tokens() const { return tokens_; }
    /// Returns which tokens are compiled, and the macros.
    const Preprocessed& preprocessed() const { return preprocessed_; }
    const SyntaxTree& tree() const { return tree_; }
    const std::vector<Word>& words() const { return expansion_.words; }
    std::string_view word(size_t index) const { return expansion_.words[index].text; }
    /// Returns the main word of a node: its name or its operator.
    std::string_view word_of(NodeId id) const { return word(tree_[id].word); }

    /// Returns the #version and #extension lines.
    std::string headers() const;
    /// Returns whether the #version is GLSL ES.
    bool is_es() const;

    /// Returns where a word is written (inside a macro's body if it comes from one), and where it is used.
    SourceLocation spelled(size_t word) const { return place(expansion_.words[word].spelled); }
    SourceLocation used(size_t word) const { return place(expansion_.words[word].used); }

    /// Returns a node's source for messages: as written if no macro is involved, else assembled from its
    /// words; blanks and comments become one blank.
    std::string excerpt(NodeId id) const;

private:
    explicit ParsedText(text::MappedText source) : source_(std::move(source)) {}
    SourceLocation place(size_t token) const;
    bool stand_apart(const Word& left, const Word& right) const;

    text::MappedText source_;
    std::vector<text::Token> tokens_;
    Preprocessed preprocessed_;
    Expansion expansion_;
    SyntaxTree tree_;
};

// Edits of expanded words that are applied to the source text. Possible where no macro produces both a
// changed and an unchanged word.

/// Keeps a reference to the text, which must outlive it. Words are numbered as in ParsedText::words().
class WordEdits {
public:
    explicit WordEdits(const ParsedText& text);

    /// Returns whether the source of the words [begin, end) produces no other words.
    bool stands_alone(size_t begin, size_t end) const;
    /// Returns whether text can be inserted before `word` alone.
    bool begins_alone(size_t word) const { return word == 0 || last_before_[word] < first_from_[word]; }

    /// Returns the first and last source token of words that stand alone.
    std::pair<size_t, size_t> tokens_of(size_t begin, size_t end) const;

    /// Replaces words that stand alone and were not changed before. Directives between them stay.
    void replace(size_t begin, size_t end, std::string_view replacement);
    void remove(size_t begin, size_t end) { replace(begin, end, {}); }
    /// Returns the source offset of a word that begins alone.
    size_t begin_of(size_t word) const { return text_.tokens()[first_from_[word]].begin; }
    /// Inserts before a word that begins alone.
    void insert(size_t word, std::string_view insertion);

    bool empty() const { return edits_.empty(); }
    /// Returns the text with all changes; no line moves.
    text::MappedText apply() const;
    /// Counts the author's lines that had code and now have none.
    int emptied_lines() const;

private:
    const ParsedText& text_;
    std::vector<uint32_t> last_before_; ///< for each word and the end: the last token used by an earlier word
    /// for each word and the end: the first token used by it or a later word
    std::vector<uint32_t> first_from_;
    std::vector<text::Edit> edits_;
    std::vector<bool> gone_; ///< removed tokens
};

} // namespace tidemark::glsl
