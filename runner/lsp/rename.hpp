// Renames a knob in all files of the scene.
#pragma once

#include "base/result.hpp"
#include "lsp/workspace.hpp"

namespace tidemark::lsp {

/// Returns the range of the knob's name at an offset; null without a knob there.
Json renamed_range(const Workspace& workspace, size_t offset, Encoding encoding);

/// Returns a WorkspaceEdit. Fails without a knob there, or where the name is not valid or is used in the
/// scene already.
Result<Json> rename_knob(const Workspace& workspace, size_t offset, const std::string& name,
                         const Documents& documents, Encoding encoding);

} // namespace tidemark::lsp
