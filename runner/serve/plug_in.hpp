// Loads the web server's plug-in on first use; only `tidemark serve` needs it.
#pragma once

#include "base/result.hpp"
#include "serve/plugin/server.hpp"

namespace tidemark::serve {

Result<const ServePlugIn*> load_serve_plug_in();

} // namespace tidemark::serve
