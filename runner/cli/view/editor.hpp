// A person's own editor at a place in a file: started and left to itself, never through a shell.
#pragma once

#include "base/error.hpp"
#include "base/result.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::cli {

/// What starts the editor ("code --wait": words between blanks) at that place. One that lives in a terminal
/// gets one.
std::vector<std::string> editor_words(std::string_view editor, const SourceLocation& where);

/// $VISUAL, else $EDITOR. Fails (ErrorCode::usage) where neither is set or it does not start.
Result<void> open_editor(const SourceLocation& where);

} // namespace tidemark::cli
