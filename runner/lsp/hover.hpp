// What is told of the word under the pointer.
#pragma once

#include "lsp/workspace.hpp"

namespace tidemark::lsp {

/// Markdown: a knob's value and range, what the author declares with the comment above it, a built-in
/// function's signatures and where it is undefined, a uniform of the host, the comment that an included file
/// begins with. Empty where there is nothing to tell.
std::string hover_text(const Workspace& workspace, size_t offset, const Documents& documents);

} // namespace tidemark::lsp
