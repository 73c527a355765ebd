// Loads libsndfile when the first sound is read: with its codecs it is ten shared objects, which a scene
// without sound does not need.
#pragma once

#include "base/error.hpp"

#include <sndfile.h>

namespace tidemark::sound {

/// The library's functions in use.
struct SoundLibrary {
    decltype(&sf_open_virtual) open_virtual = nullptr;
    decltype(&sf_readf_float) read_frames = nullptr;
    decltype(&sf_strerror) message = nullptr;
    decltype(&sf_close) close = nullptr;
};

/// Returns the library, loaded by the first call; other threads wait for it. It stays until the process ends.
/// ErrorCode::load names the missing library or function.
const Result<SoundLibrary>& sound_library();

} // namespace tidemark::sound
