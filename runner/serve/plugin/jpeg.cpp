#include "serve/plugin/jpeg.hpp"

#include <turbojpeg.h>

#include <memory>

namespace tidemark::serve {
namespace {

/// From this quality on, colour has full resolution.
constexpr int k_fine_quality = 90;

struct Destroy {
    void operator()(void* compressor) const { tjDestroy(compressor); }
};

} // namespace

std::string encode_jpeg(Extent extent, std::span<const std::byte> rgba, int quality) {
    static const std::unique_ptr<void, Destroy> compressor(tjInitCompress());
    const int sampling = quality >= k_fine_quality ? TJSAMP_444 : TJSAMP_420;
    std::string file(tjBufSize(extent.width, extent.height, sampling), '\0');
    auto* begin = reinterpret_cast<unsigned char*>(file.data());
    unsigned long size = file.size();
    const int failed = tjCompress2(compressor.get(), reinterpret_cast<const unsigned char*>(rgba.data()),
                                   extent.width, 0, extent.height, TJPF_RGBX, &begin, &size, sampling,
                                   quality, TJFLAG_BOTTOMUP | TJFLAG_NOREALLOC | TJFLAG_FASTDCT);
    file.resize(failed == 0 ? size : 0);
    return file;
}

} // namespace tidemark::serve
