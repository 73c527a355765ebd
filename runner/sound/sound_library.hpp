// libsndfile, loaded when the first sound is read: with its codecs it is ten shared objects that a scene
// without sound has no use for.
#pragma once

#include "base/result.hpp"

#include <sndfile.h>

namespace tidemark::sound {

/// The functions of the library that we call.
struct SoundLibrary {
    decltype(&sf_open_virtual) open_virtual = nullptr;
    decltype(&sf_readf_float) read_frames = nullptr;
    decltype(&sf_strerror) message = nullptr;
    decltype(&sf_close) close = nullptr;
};

/// Loaded by the first call; others wait for it. It stays until the process ends. ErrorCode::load says what
/// is missing.
const Result<SoundLibrary>& sound_library();

} // namespace tidemark::sound
