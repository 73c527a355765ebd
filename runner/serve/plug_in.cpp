#include "serve/plug_in.hpp"

#include "base/plug_in.hpp"

namespace tidemark::serve {

Result<const ServePlugIn*> load_serve_plug_in() {
    return load_plug_in<ServePlugIn>({"tidemark_serve.so", "plug-in of the web server",
                                      "serving a scene to browsers", "libturbojpeg 2.1, libvpx and libyuv",
                                      k_serve_entry, k_serve_version});
}

} // namespace tidemark::serve
