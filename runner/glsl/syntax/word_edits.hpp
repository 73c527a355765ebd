// Changes of a text that are decided on its words, after the macros, and carried out on its characters,
// before them: possible where no macro holds a changed word and an unchanged one.
#pragma once

#include "glsl/syntax/parsed_text.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::glsl {

/// Refers to the text, which must outlive it. Words are numbered as in ParsedText::words().
class WordEdits {
public:
    explicit WordEdits(const ParsedText& text);

    /// Whether what the author wrote for the words [begin, end) stands for nothing else.
    bool stands_alone(size_t begin, size_t end) const;
    /// Whether something can be put in front of `word` alone.
    bool begins_alone(size_t word) const { return word == 0 || last_before_[word] < first_from_[word]; }

    /// The first and the last token that is written for words that stand alone.
    std::pair<size_t, size_t> tokens_of(size_t begin, size_t end) const;

    /// Of words that stand alone and were not changed before. Directives between them stay.
    void replace(size_t begin, size_t end, std::string_view replacement);
    void remove(size_t begin, size_t end) { replace(begin, end, {}); }
    /// The offset in the text of a word that begins alone.
    size_t begin_of(size_t word) const { return text_.tokens()[first_from_[word]].begin; }
    /// In front of a word that begins alone.
    void insert(size_t word, std::string_view insertion);

    bool empty() const { return edits_.empty(); }
    /// The text with all changes; no line moves.
    text::MappedText apply() const;
    /// Lines of the author's that had code and have none now.
    int emptied_lines() const;

private:
    const ParsedText& text_;
    std::vector<uint32_t> last_before_; ///< of each word and the end: the last token used by any word before
    std::vector<uint32_t> first_from_;  ///< the first token used by it or any word behind
    std::vector<text::Edit> edits_;
    std::vector<bool> gone_; ///< tokens
};

} // namespace tidemark::glsl
