// Makes the edits that an author's text needs before a driver accepts it; no line moves. Most texts need
// none.
#pragma once

#include "glsl/dialect.hpp"
#include "glsl/survey.hpp"
#include "text/mapped_text.hpp"

#include <string>
#include <vector>

namespace tidemark::glsl {

/// Names that replace `GL_ES` and `__VERSION__` in desktop versions.
inline constexpr std::string_view k_es_macro = "tidemark_GL_ES";
inline constexpr std::string_view k_version_macro = "tidemark_VERSION";
/// Prefix for a reserved name that the text uses as an identifier.
inline constexpr std::string_view k_renamed = "st_";
/// New name of the author's own `main`.
inline constexpr std::string_view k_author_main = "tidemark_author_main";
/// The shader's output; also replaces the author's `gl_FragColor`.
inline constexpr std::string_view k_output = "tidemark_color";

struct Rewriting {
    std::vector<text::Edit> edits;       ///< sorted, without overlap
    std::vector<std::string> extensions; ///< #extension lines to move to the top
    std::string functions;               ///< helper functions and macros for the edited text
};

Rewriting rewrite(std::string_view text, const std::vector<text::Token>& tokens,
                  const Preprocessed& preprocessed, const Survey& survey, const Dialect& dialect);

/// Returns edits that remove the directives among the arguments of a macro, which Mesa's preprocessor rejects
/// and ShaderToy's does not; the inactive tokens between them are removed too. Calls whose conditions are
/// unknown are left unchanged.
std::vector<text::Edit> settle_arguments(const std::vector<text::Token>& tokens,
                                         const Preprocessed& preprocessed);

struct PlainNames {
    std::string macros; ///< to be put before the text
    std::vector<text::Edit> edits;
};

/// Renames uses of a macro's name that are not calls. Mesa takes `(NAME)` for the begin of a call that
/// contains the next directive if NAME is a macro with arguments.
PlainNames name_plainly(const std::vector<text::Token>& tokens, const Preprocessed& preprocessed);

/// Returns edits that insert a blank where two signs would meet after macro expansion. Mesa's preprocessor
/// passes its result on as text: where `-` precedes a macro that begins with `-`, its compiler reads `--`.
std::vector<text::Edit> separate_signs(const std::vector<text::Token>& tokens,
                                       const Preprocessed& preprocessed);

} // namespace tidemark::glsl
