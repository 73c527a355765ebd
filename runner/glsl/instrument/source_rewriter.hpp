// A text made anew from the words of a ParsedText with something added around or in the place of some of
// them: how passes that lead operations through functions of ours write what they read.
#pragma once

#include "glsl/syntax/parsed_text.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

class SourceRewriter {
public:
    explicit SourceRewriter(const ParsedText& text) : text_(text), changes_(text.words().size()) {}

    /// `before` and `after` right around the node. Of several nodes an inner one is to be wrapped first:
    /// ascending numbers, for children come before their parents.
    void wrap(NodeId node, std::string_view before, std::string_view after);
    void replace(size_t word, std::string_view with) { changes_[word].replacement = std::string(with); }

    /// The words as they then are, a line for a statement.
    std::string text() const;

private:
    struct Change {
        std::string before;
        std::string after;
        std::string replacement; ///< empty: the word itself
    };
    const ParsedText& text_;
    std::vector<Change> changes_;
};

/// The words of a node as they are, to be said once more.
std::string words_of(const ParsedText& text, NodeId id);

/// A prefix that no name of the text has.
std::string fresh_prefix(const ParsedText& text);

/// #version and the #extension lines of a text that is to write into buffers of words.
std::string headers_with_buffers(const ParsedText& text);

/// `pattern` with `$` for the prefix and `@` for the type.
std::string spell(std::string_view pattern, std::string_view prefix, std::string_view type = {});

} // namespace tidemark::glsl
