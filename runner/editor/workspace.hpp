// Data about a scene's files for the language server: comments, declarations, scopes, the scene of a file.
//
// The comments that document a declaration or a file.
#pragma once

#include "base/tokens.hpp"
#include "editor/protocol.hpp"
#include "scene/scene.hpp"
#include "shader/token_reading.hpp"

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace tidemark::lsp {

/// Returns the comment that ends on the line before that of `offset`, without its marks; empty if there is
/// none.
std::string comment_above(std::string_view text, size_t offset);

/// Returns the comment at the beginning of the text.
std::string leading_comment(std::string_view text);

/// Returns whether the end of the text lies in a comment.
bool ends_in_comment(std::string_view text);

/// Returns the text itself if its brackets match; else the part `before` the cursor with its open brackets
/// closed, so that the function that is being typed is one.
std::string with_closed_brackets(const std::string& text, std::string_view before);

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
    /// For each pass the files that it is compiled from, as indices of `files`. Empty: the scene does not
    /// load.
    std::vector<std::vector<size_t>> passes{};
    bool knows_scene = false; ///< the file belongs to a scene, which may not load

    /// Returns the files that are compiled together with `file`, itself included.
    std::vector<size_t> files_beside(size_t file) const;
    const scene::Knob* knob(std::string_view name) const;
    /// Returns whether a file may be shown: one of the scene, its folder, or the library.
    bool may_read(const std::filesystem::path& file) const;
    /// Returns whether the file is one of the shader library.
    bool is_library(const std::filesystem::path& file) const;
};

/// Returns the workspace of `file`; with the file alone where its scene is not known or does not load.
Workspace look_around(const std::filesystem::path& file, const std::optional<std::filesystem::path>& scene,
                      const Documents& documents);

/// Returns the canonical names of all files of the scene; empty where it does not load.
std::set<std::filesystem::path> files_of(const std::filesystem::path& scene, const Documents& documents);

// The meanings of the names in a file: its local names with their scopes, and the members of its structures.
// Reads tokens and never fails; does not expand macros.

/// A parameter, or a variable in a function.
struct Local {
    std::string_view name;
    std::string_view type;
    bool parameter = false;
    bool array = false;
    size_t name_begin = 0; ///< offset of the declaration
    size_t begin = 0;      ///< it is visible from there
    size_t end = 0;
    size_t function_begin = 0; ///< the function that it belongs to
    size_t function_end = 0;
};

struct Member {
    std::string_view structure;
    std::string_view name;
    std::string_view type;
    bool array = false;
    size_t name_begin = 0;
};

class FileNames {
public:
    /// The text must outlive it.
    explicit FileNames(std::string_view text);

    const glsl::Reading& reading() const { return reading_; }
    const std::vector<text::Token>& tokens() const { return reading_.tokens; }
    const std::vector<Local>& locals() const { return locals_; }
    const std::vector<Member>& members() const { return members_; }

    /// Returns the local that a name means at an offset; nullptr if it is none.
    const Local* local(std::string_view name, size_t offset) const;
    /// Returns whether the token follows a dot or declares a member.
    bool is_member(size_t token) const;
    /// Returns the macro in whose body or parameters the token is; nullptr if it is in none.
    const glsl::MacroLine* macro_around(size_t token) const;
    /// Returns whether the name is a parameter of the macro.
    bool is_parameter(const glsl::MacroLine& macro, std::string_view name) const;
    /// Returns the tokens that use a name of the outermost level: neither locals, members nor parameters of
    /// macros.
    std::vector<size_t> uses(std::string_view name) const;

private:
    void read_members();
    void read_function(const glsl::Function& function);
    void read_parameters(const glsl::Function& function);
    size_t declare(size_t begin, size_t end, size_t scope_end, bool member);
    size_t end_of_statement(size_t token, int depth) const;

    glsl::Reading reading_;
    const glsl::Function* function_ = nullptr; ///< that is being read
    std::vector<Local> locals_;
    std::vector<Member> members_;
    std::unordered_map<std::string_view, std::vector<size_t>> by_name_; ///< indices of locals_
};

/// Returns the identifier that contains the offset or ends there; nothing if there is none.
std::optional<text::Token> word_at(const std::vector<text::Token>& tokens, size_t offset);

/// Returns the file that is named by the `#include` at an offset; empty if there is none.
std::filesystem::path included_at(const Workspace& workspace, size_t offset);

} // namespace tidemark::lsp
