// Stores a text at the end of an .mp4 or .mov, in a box that players skip, with a checksum of the whole file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tidemark::image {

/// Returns the bytes to append to `video` so that `note_at_end` finds the note.
std::string note_box(std::string_view video, std::string_view note);

/// Returns the note; nothing if there is none, or the checksum does not match.
std::optional<std::string> note_at_end(std::string_view file);

} // namespace tidemark::image
