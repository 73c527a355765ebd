// Which scene a file belongs to, as the command line would name it.
#pragma once

#include "lsp/documents.hpp"

#include <optional>

namespace tidemark::lsp {

/// The folder of a pass that stands in a scene folder; a file with an entry point of its own; of any other
/// file, which is included, a file or folder beside it or above that includes it. Nothing where none is
/// found.
std::optional<std::filesystem::path> scene_of(const std::filesystem::path& file, const Documents& documents);

} // namespace tidemark::lsp
