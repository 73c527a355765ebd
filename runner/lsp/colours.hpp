// The colours in a file that an editor can change: the defaults of its `color3` knobs.
#pragma once

#include "lsp/workspace.hpp"

namespace tidemark::lsp {

/// Returns the ColorInformations of the first file.
Json document_colours(const Workspace& workspace, Encoding encoding);

/// Returns the ColorPresentations of a Color: `color3(1, 0.5, 0)`.
Json colour_presentations(const Json& colour, const Json& range);

} // namespace tidemark::lsp
