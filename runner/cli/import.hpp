// Loads scenes that a command edits, of which a project's JSON is imported first.
#pragma once

#include "host/requests.hpp"

namespace tidemark::cli {

/// Loads a scene whose files are to be edited. A project's JSON is first imported into the folder beside it
/// that is named like it, and `request` then names that folder; fails (ErrorCode::write) if the folder holds
/// other files, or files that were edited since an import.
Result<scene::Scene> load_editable(SceneRequest& request);

} // namespace tidemark::cli
