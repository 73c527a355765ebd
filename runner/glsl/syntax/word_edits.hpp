// Edits of expanded words that are applied to the source text. Possible where no macro produces both a
// changed and an unchanged word.
#pragma once

#include "glsl/syntax/parsed_text.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::glsl {

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
