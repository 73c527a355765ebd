// Writes a frame that is drawn in tiles, band by band from the top, to a picture file or to standard output.
// Works on its own thread while the next band is drawn.
#pragma once

#include "base/hash.hpp"
#include "base/result.hpp"
#include "image/files/picture_file.hpp"

#include <future>
#include <optional>
#include <string>

namespace tidemark::cli {

/// Writes RGB bytes to standard output, rows from the top down, as video tools read raw frames.
Result<void> put_raw(const image::Image& image);

/// Adds the samples unchanged, rows from the top: the SHA-256 of `--json`.
void add_rows(Sha256& hash, const image::Image& image);

class BandOutput {
public:
    /// `stream`: nothing for standard output. `hashed`: compute `sha256`.
    BandOutput(std::optional<image::PictureStream> stream, bool hashed);

    /// Waits until the previous band is written, starts to write this one, and returns the previous band.
    Result<image::Image> take(image::Image band);
    /// Finishes after the last band; the file appears.
    Result<void> finish();

    /// Returns the hash of the pixels, after `finish`.
    std::string sha256() { return hash_ ? hash_->digits() : std::string(); }
    /// Returns the number of pixels that are NaN or infinite, after `finish`.
    size_t not_finite() const { return not_finite_; }
    /// Returns the number of pixels whose alpha is below 0 or above 1, after `finish`; always 0 for bytes.
    size_t no_coverage() const { return no_coverage_; }

private:
    Result<void> write();
    Result<void> wait();

    std::optional<image::PictureStream> stream_;
    std::optional<Sha256> hash_;
    size_t not_finite_ = 0;
    size_t no_coverage_ = 0;
    image::Image band_;                 ///< being written
    /// Last, so that its destructor waits while the other members still exist.
    std::future<Result<void>> writing_;
};

} // namespace tidemark::cli
