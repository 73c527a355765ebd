// Opens the user's own editor at a place in a file. Uses no shell and does not wait for it.
#pragma once

#include "base/error.hpp"
#include "base/result.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::cli {

/// Returns the command that opens the editor ("code --wait": split at blanks) at that place. A terminal
/// editor is opened in x-terminal-emulator.
std::vector<std::string> editor_words(std::string_view editor, const SourceLocation& where);

/// Opens $VISUAL, else $EDITOR. Fails (ErrorCode::usage) if neither is set or it does not start.
Result<void> open_editor(const SourceLocation& where);

} // namespace tidemark::cli
