// The text for the name under the pointer.
#pragma once

#include "lsp/workspace.hpp"

namespace tidemark::lsp {

/// Returns Markdown: a knob's value and range, a declaration with the comment above it, a built-in function's
/// signatures and the cases where it is undefined, a uniform of the host, or the first comment of an included
/// file. Empty where nothing is known.
std::string hover_text(const Workspace& workspace, size_t offset, const Documents& documents);

} // namespace tidemark::lsp
