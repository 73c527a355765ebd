// Where a frame that is drawn in tiles goes, band by band from the top: into a picture file, or to standard
// output. Works on a thread of its own while the next band is drawn.
#pragma once

#include "base/hash.hpp"
#include "base/result.hpp"
#include "image/files/picture_file.hpp"

#include <future>
#include <optional>
#include <string>

namespace tidemark::cli {

/// Rows from the top down, RGB, as video tools take raw frames.
Result<void> put_raw(const image::Image& image);

/// The samples as they are, rows from the top: what `--json` has the SHA-256 of.
void add_rows(Sha256& hash, const image::Image& image);

class BandOutput {
public:
    /// `stream`: none for standard output. `hashed`: `sha256` will be asked for.
    BandOutput(std::optional<image::PictureStream> stream, bool hashed);

    /// Waits until the band before is done with, and gives that one back.
    Result<image::Image> take(image::Image band);
    /// After the last band: the file appears.
    Result<void> finish();

    /// Of the pixels, after `finish`.
    std::string sha256() { return hash_ ? hash_->digits() : std::string(); }
    /// Pixels, after `finish`.
    size_t not_finite() const { return not_finite_; }
    /// Pixels whose alpha is below 0 or above 1, after `finish`; of bytes none.
    size_t no_coverage() const { return no_coverage_; }

private:
    Result<void> write();
    Result<void> wait();

    std::optional<image::PictureStream> stream_;
    std::optional<Sha256> hash_;
    size_t not_finite_ = 0;
    size_t no_coverage_ = 0;
    image::Image band_;                 ///< in hand
    std::future<Result<void>> writing_; ///< last: its end is waited for while all else is still there
};

} // namespace tidemark::cli
