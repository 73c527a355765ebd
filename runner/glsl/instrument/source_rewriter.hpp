// Writes a text anew from the tokens of a ParsedText, with insertions around tokens and replacements of some.
// Passes that route operations through functions of ours use it.
#pragma once

#include "glsl/syntax/parsed_text.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

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
