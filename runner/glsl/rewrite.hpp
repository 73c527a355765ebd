// The changes that an author's text needs before the driver takes it, as edits that move no line. Most texts
// need none.
#pragma once

#include "glsl/dialect.hpp"
#include "glsl/survey.hpp"
#include "text/mapped_text.hpp"

#include <string>
#include <vector>

namespace tidemark::glsl {

/// What the `GL_ES` and the `__VERSION__` of a text become on a desktop version.
inline constexpr std::string_view k_es_macro = "tidemark_GL_ES";
inline constexpr std::string_view k_version_macro = "tidemark_VERSION";
/// In front of a reserved word that the text uses as a name.
inline constexpr std::string_view k_renamed = "st_";
/// What the author's own `main` is called where ours calls it.
inline constexpr std::string_view k_author_main = "tidemark_author_main";
/// Our output, and what an author's `gl_FragColor` becomes.
inline constexpr std::string_view k_output = "tidemark_color";

struct Rewriting {
    std::vector<text::Edit> edits;       ///< sorted, without overlap
    std::vector<std::string> extensions; ///< the text's own #extension lines that go to the top
    std::string functions;               ///< of ours, and macros, that the edited text uses
};

Rewriting rewrite(std::string_view text, const std::vector<text::Token>& tokens,
                  const Preprocessed& preprocessed, const Survey& survey, const Dialect& dialect);

/// Without the directives that stand among the arguments of a macro; see conditional_arguments.cpp.
std::vector<text::Edit> settle_arguments(const std::vector<text::Token>& tokens,
                                         const Preprocessed& preprocessed);

struct PlainNames {
    std::string macros; ///< go in front of the text
    std::vector<text::Edit> edits;
};

/// Other names for what is no call of the macro of that name; see conditional_arguments.cpp.
PlainNames name_plainly(const std::vector<text::Token>& tokens, const Preprocessed& preprocessed);

/// A blank where two signs would meet once the macros are expanded; see spacing.cpp.
std::vector<text::Edit> separate_signs(const std::vector<text::Token>& tokens,
                                       const Preprocessed& preprocessed);

} // namespace tidemark::glsl
