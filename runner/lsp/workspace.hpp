// A scene as questions about a place in it are answered: its files' texts, what they declare, its knobs.
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

/// One file of shader text.
struct SourceFile {
    std::filesystem::path path;
    std::string text;
    std::vector<Symbol> symbols;
};

struct Workspace {
    std::vector<SourceFile> files; ///< the one that was asked about first
    std::vector<scene::Knob> knobs;
    std::filesystem::path library; ///< of `#include <tidemark/…>`

    const scene::Knob* knob(std::string_view name) const;
    /// A file of the scene, of its folder, or of the library: what lies elsewhere is not shown.
    bool may_read(const std::filesystem::path& file) const;
};

/// Around `file`. Where its scene does not load, the file alone.
Workspace look_around(const std::filesystem::path& file, const std::optional<std::filesystem::path>& scene,
                      const Documents& documents);

/// All that the scene is made of; nothing where it does not load.
std::set<std::filesystem::path> files_of(const std::filesystem::path& scene, const Documents& documents);

/// The word at an offset, or that ends there; nothing between words.
std::optional<text::Token> word_at(const std::vector<text::Token>& tokens, size_t offset);

/// The file that the `#include` on an offset's line names; empty: none does.
std::filesystem::path included_at(const Workspace& workspace, size_t offset);

} // namespace tidemark::lsp
