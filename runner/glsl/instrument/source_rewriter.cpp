#include "glsl/instrument/source_rewriter.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::glsl {

void SourceRewriter::wrap(NodeId node, std::string_view before, std::string_view after) {
    const Node& words = text_.tree()[node];
    std::string& front = changes_[words.begin].before;
    front.insert(0, before);
    changes_[words.end - 1].after += after;
}

std::string SourceRewriter::text() const {
    std::string result;
    for (size_t i = 0; i < changes_.size(); ++i) {
        const Change& change = changes_[i];
        const std::string_view word = text_.word(i);
        result += change.before;
        result += change.replacement.empty() ? word : std::string_view(change.replacement);
        result += change.after;
        result += word == ";" || word == "{" ? '\n' : ' ';
    }
    return result;
}

std::string words_of(const ParsedText& text, NodeId id) {
    std::string words;
    for (size_t i = text.tree()[id].begin; i < text.tree()[id].end; ++i)
        words += fmt::format("{} ", text.word(i));
    return words;
}

std::string fresh_prefix(const ParsedText& text) {
    for (int n = 0;; ++n) {
        std::string prefix = fmt::format("tmw{}_", n);
        if (std::ranges::none_of(text.words(),
                                 [&](const Word& word) { return word.text.starts_with(prefix); }))
            return prefix;
    }
}

std::string headers_with_buffers(const ParsedText& text) {
    std::string headers = text.headers();
    const size_t es = headers.find("#version 300 es");
    if (es != headers.npos)
        return headers.replace(es, 15, "#version 310 es") + "precision highp float;\nprecision highp int;\n";
    return headers + "#extension GL_ARB_shader_storage_buffer_object : enable\n"
                     "#extension GL_ARB_shading_language_420pack : enable\n"
                     "#extension GL_ARB_shader_bit_encoding : enable\n";
}

std::string spell(std::string_view pattern, std::string_view prefix, std::string_view type) {
    std::string text;
    for (const char c : pattern) {
        if (c == '$')
            text += prefix;
        else if (c == '@')
            text += type;
        else
            text += c;
    }
    return text;
}

} // namespace tidemark::glsl
