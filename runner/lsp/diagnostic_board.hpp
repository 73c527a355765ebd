// The diagnostics of all open scenes, as notifications to the editor, which needs them by file.
#pragma once

#include "lsp/documents.hpp"
#include "lsp/position.hpp"

#include <map>
#include <set>
#include <vector>

namespace tidemark::lsp {

/// The diagnostics of a scene. `hints` are neither errors nor warnings of a compiler.
struct Verdict {
    std::vector<Diagnostic> problems{};
    std::vector<Diagnostic> hints{};
};

class DiagnosticBoard {
public:
    /// Replaces the scene's diagnostics. Returns a notification for `main` and for each other file that has
    /// diagnostics now or had some before. Diagnostics without a file are listed in `main`.
    std::vector<Json> show(const std::filesystem::path& scene, const std::filesystem::path& main,
                           const Verdict& verdict, const Documents& documents, Encoding encoding);
    /// Removes a scene that is no longer open; returns notifications for its files.
    std::vector<Json> forget(const std::filesystem::path& scene, const Documents& documents);

private:
    using Files = std::map<std::filesystem::path, Json>;
    std::vector<Json> publish(const std::set<std::filesystem::path>& files, const Documents& documents) const;

    std::map<std::filesystem::path, Files> scenes_; ///< arrays of diagnostics, by scene and file
};

} // namespace tidemark::lsp
