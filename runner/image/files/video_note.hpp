// A text at the end of an .mp4, in a box that players pass over, with a checksum of the whole file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tidemark::image {

/// What is to be appended to `video` so that `note_at_end` finds the note.
std::string note_box(std::string_view video, std::string_view note);

/// The note; nothing where there is none, or the checksum is another.
std::optional<std::string> note_at_end(std::string_view file);

} // namespace tidemark::image
