// Locations for the editor: where a name is declared, what a file declares.
#pragma once

#include "lsp/workspace.hpp"

namespace tidemark::lsp {

/// Returns Locations: the declarations of a name, all overloads included; for an `#include` the file.
Json definitions(const Workspace& workspace, size_t offset, const Documents& documents, Encoding encoding);

/// Returns the DocumentSymbols of the first file.
Json document_symbols(const Workspace& workspace, Encoding encoding);

} // namespace tidemark::lsp
