// What is wrong with each scene, on its way to the editor, which wants it by file.
#pragma once

#include "lsp/documents.hpp"
#include "lsp/position.hpp"

#include <map>
#include <set>
#include <vector>

namespace tidemark::lsp {

/// Hints are what is no error and no warning of a compiler.
struct Verdict {
    std::vector<Diagnostic> problems{};
    std::vector<Diagnostic> hints{};
};

class DiagnosticBoard {
public:
    /// One notification for each file that has something, and for each that had something before. What has no
    /// place in a file stands in `main`.
    std::vector<Json> show(const std::filesystem::path& scene, const std::filesystem::path& main,
                           const Verdict& verdict, const Documents& documents, Encoding encoding);
    /// The scene is not looked at any more.
    std::vector<Json> forget(const std::filesystem::path& scene, const Documents& documents);

private:
    using Files = std::map<std::filesystem::path, Json>;
    std::vector<Json> publish(const std::set<std::filesystem::path>& files, const Documents& documents) const;

    std::map<std::filesystem::path, Files> scenes_; ///< arrays of diagnostics, by scene and file
};

} // namespace tidemark::lsp
