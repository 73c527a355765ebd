// Whether a sound's container is whole: libsndfile plays what is there of a file that was cut. WAV, AIFF,
// FLAC, Ogg and MP3. No decoding.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace tidemark::sound {

/// False where parts that the file speaks of lie behind its end. True of a format that is not known here, and
/// of a stream whose writer did not know its length.
bool is_whole(std::string_view file);

/// The length that a FLAC's header promises; nothing of others, and where it is not known.
std::optional<uint64_t> promised_frames(std::string_view file);

} // namespace tidemark::sound
