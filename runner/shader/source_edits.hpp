// A change of a source text as a plain value: text to insert before and after an author's tokens, or to
// replace them with. Applies such changes to a text; does not find them.
#pragma once

#include "base/error.hpp"
#include "base/mapped_text.hpp"
#include "shader/parsed_text.hpp"
#include "shader/tree_facts.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// A token and its place in the author's file.
struct WrittenWord {
    SourceLocation where;
    std::string word;
    bool operator==(const WrittenWord&) const = default;
};

/// Inserts `front` before the first token and `behind` after the last. Both may be the same token.
struct Wrap {
    WrittenWord first, last;
    std::string front, behind;
    bool replaces = false; ///< `front` replaces the tokens
    bool operator==(const Wrap&) const = default;
};

struct Cure {
    std::vector<Wrap> wraps;
    std::string reason; ///< a sentence that says what changes and what stays
    bool operator==(const Cure&) const = default;
};

/// Returns the text with all cures applied, each at places of the original text. Inner wraps are nested in
/// outer ones in any order of cures; a change inside replaced text is dropped. Returns nothing if a token is
/// not at its place, or if two changes overlap and neither is inside the other.
std::optional<std::string> cured(std::string_view text, std::string_view file, std::span<const Cure> cures);

/// Applies the cures to a text assembled from files, at every place that holds the tokens. Returns false, and
/// changes nothing, if the text holds some tokens of a wrap but not the others.
bool apply(text::MappedText& text, std::span<const Cure> cures);

// Maps nodes of a parsed text back to the author's tokens, and builds edits of them. Does not apply the
// edits.

/// A range of tokens of a ParsedText, both ends included.
struct WrittenTokens {
    size_t first = 0, last = 0;
};

/// Returns the tokens written for a node that is `operation` or a part of it. If a macro's body contains the
/// operation, the tokens are those of the body, which every use of the macro shares. Returns nothing if the
/// tokens are not the author's, or if the body contains only a part of the node.
std::optional<WrittenTokens> written_for(const ParsedText& text, NodeId id, NodeId operation);

Wrap wrapped(const ParsedText& text, WrittenTokens tokens, std::string front, std::string behind);
/// Replaces the tokens by `instead`.
Wrap in_place_of(const ParsedText& text, WrittenTokens tokens, std::string instead);

/// Wraps one token; nothing if it comes from a macro or is not the author's.
std::optional<Wrap> at_word(const ParsedText& text, size_t word, std::string front, std::string behind);

/// Returns the function's block; k_no_node for a prototype.
NodeId body_of_function(const ParsedText& text, NodeId function);
std::vector<NodeId> parameters_of(const ParsedText& text, NodeId function);
/// Returns the definition of mainImage; k_no_node: none.
NodeId find_main_image(const ParsedText& text);

/// Returns `wanted` followed by a number, the first from `number` on that the text does not use; 1 is not
/// written.
std::string fresh_name(const ParsedText& text, std::string_view wanted, size_t number = 1);

/// Returns the text of an expression to repeat it: nothing if evaluating it twice has side effects, or if it
/// is long or not on one line.
std::optional<std::string> said_again(const ParsedText& text, const TreeFacts& facts, NodeId id,
                                      WrittenTokens tokens);

// Writes a text anew from the tokens of a ParsedText, with insertions around tokens and replacements of some.
// Passes that route operations through functions of ours use it.

class SourceRewriter {
public:
    explicit SourceRewriter(const ParsedText& text) : text_(text), changes_(text.words().size()) {}

    /// Inserts `before` and `after` around the node. Inner nodes must be wrapped first; children have smaller
    /// numbers than their parents.
    void wrap(NodeId node, std::string_view before, std::string_view after);
    void replace(size_t word, std::string_view with) { changes_[word].replacement = std::string(with); }

    /// Returns the changed text, one statement per line.
    std::string text() const;

private:
    struct Change {
        std::string before;
        std::string after;
        std::string replacement; ///< empty: the token stays
    };
    const ParsedText& text_;
    std::vector<Change> changes_;
};

/// Returns the node's tokens as text, to repeat them.
std::string words_of(const ParsedText& text, NodeId id);

/// Returns a prefix that no name of the text has.
std::string fresh_prefix(const ParsedText& text);

/// Returns #version and the #extension lines of a text that writes into uint buffers.
std::string headers_with_buffers(const ParsedText& text);

/// Returns `pattern` with `$` replaced by the prefix and `@` by the type.
std::string spell(std::string_view pattern, std::string_view prefix, std::string_view type = {});

} // namespace tidemark::glsl
