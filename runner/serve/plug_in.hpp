// The plug-in of the web server, loaded when it is first asked for: only `tidemark serve` has a use for it.
#pragma once

#include "base/result.hpp"
#include "serve/plugin/server.hpp"

namespace tidemark::serve {

Result<const ServePlugIn*> load_serve_plug_in();

} // namespace tidemark::serve
