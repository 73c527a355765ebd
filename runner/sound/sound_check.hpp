// Checks that a sound file is complete, because libsndfile plays the rest of a truncated file without an
// error. Handles WAV, AIFF, FLAC, Ogg and MP3. Decodes nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace tidemark::sound {

/// Returns false if parts that the file declares lie beyond its end. Returns true for unknown formats and for
/// streams whose writer did not know their length.
bool is_whole(std::string_view file);

/// Returns the length in a FLAC's header; nothing for other formats or if the header has none.
std::optional<uint64_t> promised_frames(std::string_view file);

} // namespace tidemark::sound
