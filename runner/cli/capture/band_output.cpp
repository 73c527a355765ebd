#include "cli/capture/band_output.hpp"

#include "base/try.hpp"
#include "cli/console.hpp"
#include "image/census.hpp"
#include "image/colours.hpp"

#include <algorithm>
#include <vector>

namespace tidemark::cli {
namespace {

constexpr size_t k_block_bytes = 1 << 18; ///< fits a processor's cache while it is filled and written

} // namespace

Result<void> put_raw(const image::Image& image) {
    const size_t row_bytes = size_t(image.extent.width) * 3;
    const size_t rows_at_once = std::max<size_t>(1, k_block_bytes / row_bytes);
    std::vector<std::byte> block;
    for (int row = image.extent.height; row > 0;) {
        const auto rows = int(std::min(rows_at_once, size_t(row)));
        block.resize(size_t(rows) * row_bytes);
        for (int i = 0; i < rows; ++i)
            copy_colours(image, --row, block.data() + size_t(i) * row_bytes);
        if (auto done = put(block); !done)
            return done;
    }
    return {};
}

void add_rows(Sha256& hash, const image::Image& image) {
    const std::span<const std::byte> bytes(image.bytes);
    for (auto row = size_t(image.extent.height); row-- > 0;)
        hash.add(bytes.subspan(row * image.row_bytes(), image.row_bytes()));
}

BandOutput::BandOutput(std::optional<image::PictureStream> stream, bool hashed) : stream_(std::move(stream)) {
    if (hashed)
        hash_.emplace();
}

Result<image::Image> BandOutput::take(image::Image band) {
    TRY(wait());
    std::swap(band, band_);
    writing_ = std::async(std::launch::async, [this] { return write(); });
    return band;
}

Result<void> BandOutput::write() {
    not_finite_ += image::take_non_finite(band_);
    if (band_.type == image::SampleType::f32)
        no_coverage_ += image::pixels_of_no_coverage(band_);
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

} // namespace tidemark::cli
