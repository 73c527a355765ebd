// The error on show, with the source lines it refers to.
#pragma once

#include "base/error.hpp"
#include "host/overlay_fields.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::cli {

class ErrorBoard {
public:
    /// Sets the error; null: there is none. Reads the files if the error differs from the last one. Returns
    /// whether it differs.
    bool show(const Error* error);
    const std::vector<live::ErrorField>& fields() const { return fields_; }

private:
    std::string text_; ///< of the error
    std::vector<live::ErrorField> fields_;
};

// Opens the user's own editor at a place in a file. Uses no shell and does not wait for it.

/// Returns the command that opens the editor ("code --wait": split at blanks) at that place. A terminal
/// editor is opened in x-terminal-emulator.
std::vector<std::string> editor_words(std::string_view editor, const SourceLocation& where);

/// Opens $VISUAL, else $EDITOR. Fails (ErrorCode::usage) if neither is set or it does not start.
Result<void> open_editor(const SourceLocation& where);

} // namespace tidemark::cli
