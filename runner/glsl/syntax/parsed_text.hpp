// A complete GLSL text, read to its syntax tree, with the way from every word back to its author. What passes
// over the tree start from.
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
    /// `source` is what a driver would get, #version included; `known` are all macros that the driver
    /// defines; with `all_known` false it may define others that begin with GL_. The error says where the
    /// text cannot be followed.
    static Result<std::unique_ptr<const ParsedText>>
    read(text::MappedText source, std::span<const KnownMacro> known, bool all_known = true);
    ParsedText(const ParsedText&) = delete;
    ParsedText& operator=(const ParsedText&) = delete;

    const text::MappedText& source() const { return source_; }
    const std::vector<text::Token>& tokens() const { return tokens_; }
    /// Which tokens are compiled, and the macros there are.
    const Preprocessed& preprocessed() const { return preprocessed_; }
    const SyntaxTree& tree() const { return tree_; }
    const std::vector<Word>& words() const { return expansion_.words; }
    std::string_view word(size_t index) const { return expansion_.words[index].text; }
    /// The word that a node is about: its name, its operator.
    std::string_view word_of(NodeId id) const { return word(tree_[id].word); }

    /// #version and the #extension lines, as they stand.
    std::string headers() const;
    /// Whether that is GLSL ES.
    bool is_es() const;

    /// Where a word is written (in a macro's body, where it comes from one), and where it is used.
    SourceLocation spelled(size_t word) const { return place(expansion_.words[word].spelled); }
    SourceLocation used(size_t word) const { return place(expansion_.words[word].used); }

    /// What a node looks like to its author: as written where no macro is in it, else word by word; blanks
    /// and comments come down to one blank.
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
