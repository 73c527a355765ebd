// A complete GLSL text with its tokens, macros, expanded words and syntax tree. Every word maps back to the
// author's line. All passes over the tree start from it.
#pragma once

#include "base/result.hpp"
#include "glsl/syntax/expand.hpp"
#include "glsl/syntax/syntax_tree.hpp"
#include "text/mapped_text.hpp"

#include <memory>
#include <span>
#include <string>

namespace tidemark::glsl {

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

} // namespace tidemark::glsl
