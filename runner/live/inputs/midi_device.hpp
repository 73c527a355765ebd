// A source of MIDI bytes with a file name: a device such as `/dev/snd/midiC1D0`, a pipe, a recording.
#pragma once

#include "base/result.hpp"

#include <filesystem>

namespace tidemark::live {

/// Opens it for non-blocking reads. Returns a descriptor that the caller must close. A pipe stays open when
/// its writers close it. Fails with ErrorCode::load.
Result<int> open_midi_device(const std::filesystem::path& file);

} // namespace tidemark::live
