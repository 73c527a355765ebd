// Films of VP8 by libvpx: one picture after the other, each as what changed since the one before.
#pragma once

#include "serve/plugin/server.hpp"

#include <memory>

namespace tidemark::serve {

/// ServePlugIn::open_film.
std::unique_ptr<Film> open_vp8(int quality);

} // namespace tidemark::serve
