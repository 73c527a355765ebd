// Makes the edits that an author's text needs before a driver accepts it; no line moves. Most texts need
// none.
#pragma once

#include "base/mapped_text.hpp"
#include "base/tokens.hpp"
#include "scene/scene.hpp"
#include "shader/shader_source.hpp"
#include "shader/survey.hpp"
#include "shader/token_reading.hpp"

#include <span>
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

// Handles functions of the author that have the name of a built-in one. WebGL compilers have accepted them as
// overloads; on a desktop they hide the built-in. Produces edits that give both another name.

/// Returns whether the text defines a function that `join_overloads` handles.
bool overloads_builtins(const std::vector<text::Token>& tokens, const Preprocessed& preprocessed);

struct JoinedOverloads {
    /// The built-in's signatures under the new name, except those that the author replaces. A call of one is
    /// not a constant expression.
    std::string functions;
    std::vector<text::Edit> edits; ///< the author's definitions and calls, in text order
};

JoinedOverloads join_overloads(const std::vector<text::Token>& tokens, const Preprocessed& preprocessed);

// Generated code around an author's text: the lines before it, and the `main` that calls its entry point.

/// Returns #version and the lines that must follow it directly, which promotion must not change. `extensions`
/// are the author's #extension lines.
std::string version_lines(const Dialect& dialect, std::span<const std::string> extensions);

/// Returns the lines between version_lines and the author's text: macros, uniforms, output, helper functions.
std::string prologue(const scene::Scene& scene, const scene::Pass& pass, const Survey& survey,
                     const Dialect& dialect);

/// Returns everything that ShaderToy puts before a text; no aliases for old names and no knobs.
std::string site_prologue(const scene::Pass& pass, const Survey& survey, const Dialect& dialect);

struct Wrapper {
    std::string prototype; ///< lets `main` come first
    std::string main;
};

Wrapper wrapper(const scene::Pass& pass, const Survey& survey, const Dialect& dialect);

/// Returns `isKeyDown(int)` and related functions, with the VS Code extension's `Key_` constants:
/// `#iKeyboard`.
std::string keyboard_helpers();

} // namespace tidemark::glsl
