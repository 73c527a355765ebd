#include "cli/capture/band_output.hpp"

#include "cli/console.hpp"

#include <algorithm>
#include <system_error>
#include <vector>

namespace tidemark::cli {

Result<void> put_raw(const image::Image& image) {
    std::vector<std::byte> rgb(image.extent.pixels() * 3);
    std::byte* to = rgb.data();
    for (size_t row = size_t(image.extent.height); row-- > 0;) {
        const std::byte* from = &image.bytes[row * image.row_bytes()];
        for (int x = 0; x < image.extent.width; ++x, from += 4, to += 3)
            std::copy_n(from, 3, to);
    }
    return put(rgb);
}

void add_rows(Sha256& hash, const image::Image& image) {
    const std::span<const std::byte> bytes(image.bytes);
    for (size_t row = size_t(image.extent.height); row-- > 0;)
        hash.add(bytes.subspan(row * image.row_bytes(), image.row_bytes()));
}

BandOutput::BandOutput(std::optional<image::PictureStream> stream, bool hashed) : stream_(std::move(stream)) {
    if (hashed)
        hash_.emplace();
}

Result<image::Image> BandOutput::take(image::Image band) {
    if (auto done = wait(); !done)
        return fail(std::move(done.error()));
    std::swap(band, band_);
    writing_ = std::async(std::launch::async, [this] { return write(); });
    return band;
}

Result<void> BandOutput::write() {
    if (hash_)
        add_rows(*hash_, band_);
    return stream_ ? stream_->add(band_) : put_raw(band_);
}

Result<void> BandOutput::wait() {
    return writing_.valid() ? writing_.get() : Result<void>();
}

Result<void> BandOutput::finish() {
    return wait().and_then([&] { return stream_ ? stream_->finish() : Result<void>(); });
}

void BandOutput::abandon() const {
    std::error_code ignored;
    if (stream_)
        std::filesystem::remove(stream_->temporary(), ignored);
}

} // namespace tidemark::cli
