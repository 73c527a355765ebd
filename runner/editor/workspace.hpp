// The comments that document a declaration or a file.
#pragma once

#include "base/tokens.hpp"
#include "editor/protocol.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lsp {

/// Returns the comment that ends on the line before that of `offset`, without its marks; empty if there is
/// none.
std::string comment_above(std::string_view text, size_t offset);

/// Returns the comment at the beginning of the text.
std::string leading_comment(std::string_view text);

// The declarations of a file at its outermost level: functions, global variables, structures, macros and
// knobs, each with its place and the comment above it. Reads tokens and never fails; does not expand macros.

struct Symbol {
    enum class Kind { function, variable, constant, structure, macro, knob };
    Kind kind = Kind::variable;
    std::string name;
    std::string signature; ///< on one line, as written: `float sdf(vec3 p)`
    std::string comment;   ///< the one above it, without its marks; may be empty
    size_t begin = 0;      ///< of the whole declaration, in bytes from the text's beginning
    size_t end = 0;
    size_t name_begin = 0;

    size_t name_end() const { return name_begin + name.size(); }
};

/// Returns the declarations in the order of the text.
std::vector<Symbol> outline(std::string_view text);

// Finds the scene that a file belongs to, in the form that the command line takes.

/// Returns the folder for a pass in a scene folder, or the file itself if it has an entry point. For other
/// files, returns a scene in the same or the parent folder that includes it; nothing if none does.
std::optional<std::filesystem::path> scene_of(const std::filesystem::path& file, const Documents& documents);

// The data for requests about a place in a scene: its files' texts, their declarations, its knobs.

/// A file of shader text.
struct SourceFile {
    std::filesystem::path path;
    std::string text;
    std::vector<Symbol> symbols;
};

struct Workspace {
    std::vector<SourceFile> files; ///< the file of the request first
    std::vector<scene::Knob> knobs;
    std::filesystem::path library; ///< of `#include <tidemark/…>`

    const scene::Knob* knob(std::string_view name) const;
    /// Returns whether a file may be shown: one of the scene, its folder, or the library.
    bool may_read(const std::filesystem::path& file) const;
};

/// Returns the workspace of `file`; with the file alone where its scene is not known or does not load.
Workspace look_around(const std::filesystem::path& file, const std::optional<std::filesystem::path>& scene,
                      const Documents& documents);

/// Returns the canonical names of all files of the scene; empty where it does not load.
std::set<std::filesystem::path> files_of(const std::filesystem::path& scene, const Documents& documents);

/// Returns the identifier that contains the offset or ends there; nothing if there is none.
std::optional<text::Token> word_at(const std::vector<text::Token>& tokens, size_t offset);

/// Returns the file that is named by the `#include` at an offset; empty if there is none.
std::filesystem::path included_at(const Workspace& workspace, size_t offset);

} // namespace tidemark::lsp
