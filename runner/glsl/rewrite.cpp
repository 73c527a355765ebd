#include "glsl/rewrite.hpp"

#include "glsl/overloads.hpp"
#include "glsl/syntax/words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::glsl {
namespace {

using text::Edit;
using text::Token;
using text::TokenKind;

/// Prefixes of extensions that a desktop driver, or a driver for GLSL ES, may support.
constexpr std::string_view k_desktop_extensions[] = {"GL_ARB_", "GL_EXT_", "GL_KHR_",   "GL_NV_",
                                                     "GL_AMD_", "GL_ATI_", "GL_INTEL_", "GL_MESA_"};
constexpr std::string_view k_es_extensions[] = {"GL_OES_", "GL_EXT_", "GL_KHR_"};

class Rewriter {
public:
    Rewriter(std::string_view text, const std::vector<Token>& tokens, const Preprocessed& preprocessed,
             const Survey& survey, const Dialect& dialect)
        : text_(text), tokens_(tokens), preprocessed_(preprocessed), survey_(survey), dialect_(dialect) {
        prepare_renames();
    }

    Rewriting run() {
        for (const size_t hash : preprocessed_.directives)
            directive(hash);
        for (const MacroLine& macro : preprocessed_.macros)
            macro_line(macro);
        for (size_t i = 0; i < tokens_.size(); ++i)
            token(i);
        for (const UniformDeclaration& uniform : survey_.uniforms)
            if (uniform.replaced)
                remove(uniform.begin, uniform.end);
        for (size_t nul = text_.find('\0'); nul != std::string_view::npos; nul = text_.find('\0', nul + 1))
            result_.edits.push_back({nul, nul + 1, " "}); // NUL would end the text for some drivers
        if (dialect_.main == MainPlace::author && !survey_.mains.empty())
            for (const size_t name : survey_.mains)
                rename(tokens_[name], k_author_main);
        add(separate_signs(tokens_, preprocessed_));
        add(settle_arguments(tokens_, preprocessed_));
        const PlainNames plain = name_plainly(tokens_, preprocessed_);
        add(plain.edits);
        result_.functions = plain.macros;
        if (dialect_.joins_overloads) {
            JoinedOverloads joined = join_overloads(tokens_, preprocessed_);
            result_.functions += joined.functions;
            add(joined.edits);
        }
        sort_edits();
        return std::move(result_);
    }

private:
    void remove(size_t begin, size_t end) { result_.edits.push_back({begin, end, {}}); }
    void add(const std::vector<Edit>& edits) {
        result_.edits.insert(result_.edits.end(), edits.begin(), edits.end());
    }
    void rename(const Token& token, std::string_view name) {
        result_.edits.push_back({token.begin, token.end(), std::string(name)});
    }

    void prepare_renames() {
        for (const auto word : k_reserved_words) {
            const auto found = survey_.names.find(word);
            if (found != survey_.names.end() && found->second.count > 0 && !found->second.qualifier)
                renames_.emplace(word, fmt::format("{}{}", k_renamed, word));
        }
        if (dialect_.version != Version::es_300) {
            if (survey_.uses("GL_ES"))
                renames_.emplace("GL_ES", k_es_macro);
            if (survey_.uses("__VERSION__"))
                renames_.emplace("__VERSION__", k_version_macro);
        }
        if (survey_.wants("gl_FragColor"))
            renames_.emplace("gl_FragColor", k_output);
    }

    /// Removes #version and #line, which Tidemark writes itself. Moves an #extension to the top, or drops it
    /// if no driver of that kind can support it.
    void directive(size_t hash) {
        const size_t end = text::end_of_directive(tokens_, hash);
        if (hash + 1 >= end)
            return;
        const Token& keyword = tokens_[hash + 1];
        if (!keyword.is("version") && !keyword.is("line") && !keyword.is("extension"))
            return;
        remove(tokens_[hash].begin, tokens_[end - 1].end());
        if (keyword.is("extension") && hash + 2 < end)
            hoist(tokens_[hash + 2].text);
    }

    void hoist(std::string_view name) {
        std::span<const std::string_view> families = k_desktop_extensions;
        if (dialect_.version == Version::es_300)
            families = k_es_extensions;
        const bool known = std::any_of(families.begin(), families.end(),
                                       [&](std::string_view family) { return name.starts_with(family); });
        // `enable` instead of `require`, so that compilation continues without it
        std::string line = fmt::format("#extension {} : enable\n", name);
        auto& lines = result_.extensions;
        if (known && std::find(lines.begin(), lines.end(), line) == lines.end())
            lines.push_back(std::move(line));
    }

    /// Removes definitions of GL_ES, which Tidemark defines and drivers reject. Removes a comma after the
    /// last parameter, which ShaderToy's preprocessor ignores.
    void macro_line(const MacroLine& macro) {
        if (macro.name == "GL_ES")
            remove(tokens_[macro.hash].begin, tokens_[macro.end - 1].end());
        else if (macro.parameters && macro.body > macro.hash + 5 && tokens_[macro.body - 1].is(")") &&
                 tokens_[macro.body - 2].is(","))
            rename(tokens_[macro.body - 2], " ");
    }

    void token(size_t i) {
        const Token& token = tokens_[i];
        if (token.kind == TokenKind::punctuation) {
            // ShaderToy's preprocessor treats a stray byte, as from a no-break space, as a blank.
            if ((unsigned char)(token.text[0]) >= 0x80)
                rename(token, " ");
            return;
        }
        if (token.kind != TokenKind::identifier)
            return;
        if (!renames_.empty()) {
            const auto found = renames_.find(token.text);
            if (found != renames_.end())
                rename(token, found->second);
        }
    }

    /// Sorts edits by place, and drops those inside a removed part.
    void sort_edits() {
        auto& edits = result_.edits;
        std::stable_sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) {
            return a.begin != b.begin ? a.begin < b.begin : a.end < b.end;
        });
        size_t kept = 0;
        size_t covered = 0;
        for (Edit& edit : edits) {
            if (kept > 0 && edit.begin < covered)
                continue;
            covered = std::max(covered, edit.end);
            if (&edits[kept] != &edit)
                edits[kept] = std::move(edit);
            ++kept;
        }
        edits.resize(kept);
    }

    std::string_view text_;
    const std::vector<Token>& tokens_;
    const Preprocessed& preprocessed_;
    const Survey& survey_;
    const Dialect& dialect_;
    std::unordered_map<std::string_view, std::string> renames_;
    Rewriting result_;
};

} // namespace

Rewriting rewrite(std::string_view text, const std::vector<Token>& tokens, const Preprocessed& preprocessed,
                  const Survey& survey, const Dialect& dialect) {
    return Rewriter(text, tokens, preprocessed, survey, dialect).run();
}

} // namespace tidemark::glsl
