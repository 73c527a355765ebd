// Encodes VP8 films with libvpx: each picture as its changes since the one before.
#pragma once

#include "serve/plugin/server.hpp"

#include <memory>

namespace tidemark::serve {

/// Implements ServePlugIn::open_film.
std::unique_ptr<Film> open_vp8(int quality);

} // namespace tidemark::serve
