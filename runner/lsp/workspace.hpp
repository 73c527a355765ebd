// The data for requests about a place in a scene: its files' texts, their declarations, its knobs.
#pragma once

#include "lsp/documents.hpp"
#include "lsp/outline.hpp"
#include "lsp/position.hpp"
#include "scene/scene.hpp"
#include "text/tokens.hpp"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tidemark::lsp {

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
