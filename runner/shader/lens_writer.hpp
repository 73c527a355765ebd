// Edits that all instrumented texts of lenses share, and the text around them with its mainHit.
#pragma once

#include "base/error.hpp"
#include "shader/lens_text.hpp"
#include "shader/source_edits.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace tidemark::glsl {

/// GLSL before the text: the author's own mainHit is not compiled as the entry point.
inline constexpr std::string_view k_lens_begin = R"(#undef TIDEMARK_HIT
#define mainHit tidemark_own_hit
)";

/// GLSL after the text; `@` is the expression that the entry point returns.
inline constexpr std::string_view k_lens_main = R"(
#undef mainHit
void mainHit(out vec4 hit, in vec2 fragCoord) {
    vec4 color = vec4(0.0);
    mainImage(color, fragCoord);
    hit = @;
}
)";

/// Rewrites a text for a lens.
class LensWriter {
public:
    LensWriter(const ParsedText& text, const TreeFacts& facts)
        : text_(text), tree_(text.tree()), facts_(facts), prefix_(fresh_prefix(text)), edits_(text) {}

    const std::string& prefix() const { return prefix_; }
    SourceRewriter& edits() { return edits_; }

    Result<void> check() const {
        if (find_main_image(text_) == k_no_node)
            return fail(ErrorCode::load, "the text has no mainImage");
        for (const Word& word : text_.words())
            if (word.is("discard"))
                return fail(ErrorCode::load, "the text discards pixels");
        return {};
    }

    /// `functions` precede the text; `answer` is what mainHit returns. `extensions`: further lines of
    /// #extension.
    text::MappedText written(const std::string& functions, std::string_view answer,
                             std::string extensions = {}) const {
        text::MappedText whole;
        const std::string headers = text_.headers();
        for (size_t at = 0; (at = headers.find("#extension", at)) != headers.npos; ++at)
            extensions += headers.substr(at, headers.find('\n', at) - at) + "\n";
        whole.append_generated(extensions + std::string(k_lens_begin) + spell(k_lens_functions, prefix_) +
                               functions);
        whole.append_generated(edits_.text());
        whole.append_generated(spell(k_lens_main, prefix_, spell(answer, prefix_)));
        return whole;
    }

protected:
    SourceLocation resolved(SourceLocation place) const {
        if (place.file.empty())
            place.file = text_.spelled(tree_[find_main_image(text_)].word).file;
        return place;
    }
    bool is_on(const SourceLocation& place, NodeId id) const { return is_at(place, tree_[id].word); }
    bool is_at(const SourceLocation& place, size_t word) const {
        const SourceLocation at = text_.used(word);
        return at.line == place.line && at.file == place.file;
    }
    static std::string name_of_place(const SourceLocation& place) {
        return fmt::format("{}:{}", place.file, place.line);
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    std::string prefix_;
    SourceRewriter edits_;
};

} // namespace tidemark::glsl
