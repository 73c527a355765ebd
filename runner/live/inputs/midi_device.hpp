// A device's file that MIDI comes from as bytes: `/dev/snd/midiC1D0`, a pipe, a recording.
#pragma once

#include "base/result.hpp"

#include <filesystem>

namespace tidemark::live {

/// A descriptor whose taker closes it. A pipe stays open whoever else writes into it and leaves.
/// ErrorCode::load says why there is none.
Result<int> open_midi_device(const std::filesystem::path& file);

} // namespace tidemark::live
