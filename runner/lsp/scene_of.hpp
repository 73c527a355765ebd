// Finds the scene that a file belongs to, in the form that the command line takes.
#pragma once

#include "lsp/documents.hpp"

#include <optional>

namespace tidemark::lsp {

/// Returns the folder for a pass in a scene folder, or the file itself if it has an entry point. For other
/// files, returns a scene in the same or the parent folder that includes it; nothing if none does.
std::optional<std::filesystem::path> scene_of(const std::filesystem::path& file, const Documents& documents);

} // namespace tidemark::lsp
