#include "image/compare/same_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace tidemark::image {
namespace {

bool is_grey(const Image& image) {
    return image.channels < 3;
}

/// Adds channels: `coloured` repeats grey three times, `with_alpha` adds an alpha of 1. Existing channels
/// stay.
Image widened(const Image& image, bool coloured, bool with_alpha) {
    const int colours = coloured || !is_grey(image) ? 3 : 1;
    Image wide(image.extent, colours + (with_alpha || image.has_alpha() ? 1 : 0), image.type);
    if (wide.channels == image.channels)
        return image;
    const size_t size = size_of(image.type), from_pixel = size * size_t(image.channels),
                 to_pixel = size * size_t(wide.channels);
    const std::byte* from = image.bytes.data();
    std::byte* to = wide.bytes.data();
    const uint8_t one_byte = 255;
    const float one_float = 1.0F;
    const void* one = image.type == SampleType::u8 ? static_cast<const void*>(&one_byte) : &one_float;
    const int last_colour = is_grey(image) ? 0 : 2;
    for (size_t i = 0; i < image.extent.pixels(); ++i, from += from_pixel, to += to_pixel) {
        for (int c = 0; c < colours; ++c)
            std::memcpy(to + size_t(c) * size, from + size_t(std::min(c, last_colour)) * size, size);
        if (wide.channels > colours)
            std::memcpy(to + size_t(colours) * size,
                        image.has_alpha() ? from + size_t(last_colour + 1) * size : one, size);
    }
    return wide;
}

} // namespace

SameChannels same_channels(Image left, Image right) {
    SameChannels same{std::move(left), std::move(right), {}};
    const auto note = [&](const std::string& text) { same.note += (same.note.empty() ? "" : "; ") + text; };
    if (is_grey(same.left) != is_grey(same.right))
        note(fmt::format("{} is grey, which stands for its red, green and blue",
                         is_grey(same.left) ? "A" : "B"));
    bool alpha = same.left.has_alpha();
    if (alpha != same.right.has_alpha()) {
        Image& having = alpha ? same.left : same.right;
        const char *has = alpha ? "A" : "B", *has_not = alpha ? "B" : "A";
        alpha = !has_opaque_alpha(having);
        if (!alpha)
            having = without_alpha(having);
        note(alpha ? fmt::format("{} has no alpha: it counts as 1", has_not)
                   : fmt::format("only {} has an alpha, 1 throughout: it is not compared", has));
    }
    const bool coloured = !is_grey(same.left) || !is_grey(same.right);
    same.left = widened(same.left, coloured, alpha);
    same.right = widened(same.right, coloured, alpha);
    return same;
}

} // namespace tidemark::image
