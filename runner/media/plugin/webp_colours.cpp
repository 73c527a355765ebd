#include "media/plugin/webp_colours.hpp"

#include "base/dynamic_library.hpp"

#include <algorithm>

namespace tidemark::image {
namespace {

/// Functions of libwebp, which OpenImageIO depends on: webp/decode.h, unchanged since its first release. Two
/// functions of plain types need no header.
struct WebpLibrary {
    int (*info)(const uint8_t* file, size_t size, int* width, int* height) = nullptr;
    uint8_t* (*decode)(const uint8_t* file, size_t size, uint8_t* rgba, size_t room, int row_bytes) = nullptr;
};

const WebpLibrary* webp_library() {
    static WebpLibrary functions;
    static const bool complete = [] {
        SharedLibrary library("libwebp.so.7");
        library.find("WebPGetInfo", functions.info).find("WebPDecodeRGBAInto", functions.decode);
        return library.complete("libwebp", "libwebp7").has_value();
    }();
    return complete ? &functions : nullptr;
}

/// Decodes to rows from the bottom; returns false when libwebp is missing or fails.
bool decode_straight(std::span<const std::byte> file, Image& image) {
    const WebpLibrary* const webp = webp_library();
    const auto* const bytes = reinterpret_cast<const uint8_t*>(file.data());
    Extent extent;
    if (!webp || !webp->info(bytes, file.size(), &extent.width, &extent.height) || extent != image.extent)
        return false;
    Image top_down(extent, 4, SampleType::u8);
    if (!webp->decode(bytes, file.size(), top_down.u8().data(), top_down.samples(),
                      int(top_down.row_bytes())))
        return false;
    for (int row = 0; row < extent.height; ++row)
        std::copy_n(top_down.bytes.begin() + ptrdiff_t(size_t(row) * image.row_bytes()), image.row_bytes(),
                    image.bytes.begin() + ptrdiff_t(size_t(extent.height - 1 - row) * image.row_bytes()));
    return true;
}

void divide_by_alpha(Image& image) {
    const auto samples = image.u8();
    for (size_t pixel = 0; pixel < samples.size(); pixel += 4)
        if (const int alpha = samples[pixel + 3]; alpha > 0)
            for (size_t i = pixel; i < pixel + 3; ++i)
                samples[i] = uint8_t(std::min(255, (255 * samples[i] + alpha / 2) / alpha));
}

} // namespace

void restore_colours(std::span<const std::byte> file, Image& decoded) {
    if (decoded.channels == 4 && decoded.type == SampleType::u8 && !decode_straight(file, decoded))
        divide_by_alpha(decoded);
}

} // namespace tidemark::image
