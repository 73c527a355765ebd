// Another name for a knob, wherever the scene's files have it.
#pragma once

#include "base/result.hpp"
#include "lsp/workspace.hpp"

namespace tidemark::lsp {

/// The range of the knob's name at an offset; null where no knob stands there.
Json renamed_range(const Workspace& workspace, size_t offset, Encoding encoding);

/// A WorkspaceEdit. Fails where no knob stands there, or the name is none or is used in the scene already.
Result<Json> rename_knob(const Workspace& workspace, size_t offset, const std::string& name,
                         const Documents& documents, Encoding encoding);

} // namespace tidemark::lsp
