// Answers with places: where a word is declared, what a file declares.
#pragma once

#include "lsp/workspace.hpp"

namespace tidemark::lsp {

/// Locations: of all overloads; of an `#include` the file.
Json definitions(const Workspace& workspace, size_t offset, const Documents& documents, Encoding encoding);

/// DocumentSymbols of the first file.
Json document_symbols(const Workspace& workspace, Encoding encoding);

} // namespace tidemark::lsp
