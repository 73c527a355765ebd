// Pictures in files. PNG is read and written by libpng (png_codec.hpp), all other formats by OpenImageIO,
// which sits in a plug-in that is loaded when such a picture is first read or written, or ahead of that on a
// thread of its own by `preload_picture_codec`. Samples go in and out as they are: no gamma, no colour space,
// no multiplication by alpha, no turning by a camera's orientation, but for what PictureFormat asks for. Only
// the rows are turned over: files run from the top, an Image from the bottom. Every function may be called
// from any thread.
#pragma once

#include "base/file.hpp"
#include "base/result.hpp"
#include "image/image.hpp"
#include "image/transfer.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace tidemark::image {

/// What one sample is in the file.
enum class SampleDepth { u8, u16, half, f32 };

/// The largest picture that is read, or written from memory: pixels on a side, and bytes in memory.
inline constexpr int k_largest_side = 16384;
inline constexpr size_t k_largest_picture = size_t{1} << 30;

/// What becomes of a picture's alpha in a file that has one.
enum class Alpha {
    where_needed,  ///< as it is; left out where it is 1 all over
    straight,      ///< as it is: the colours are not multiplied by it
    premultiplied, ///< the file's colours are multiplied by it, after they are decoded
};

/// How a picture is stored.
struct PictureFormat {
    SampleDepth depth = SampleDepth::u8;
    /// Names and values (UTF-8). PNG: a text chunk `tidemark:<name>` each; EXR: a string attribute
    /// `tidemark:<name>` each; TIFF and JPEG: a line `tidemark:<name>=<value>` each in the image
    /// description or comment; HDR: nothing. A name is 1 to 60 printable ASCII characters without spaces; a
    /// value is cut at a NUL, and all of a JPEG's together at 32,000 bytes.
    std::vector<std::pair<std::string, std::string>> metadata{};
    /// What the file says of its samples, where the format has words for it: PNG in chunks, TIFF and JPEG in
    /// a profile, EXR in attributes. An Image that goes into a file of `linear` has its sRGB decoded on the
    /// way. None: the file says nothing.
    std::optional<Transfer> transfer{};
    Alpha alpha = Alpha::where_needed;
};

/// Whether `path` ends in a format we write (.png .jpg .jpeg .tif .tiff .exr .hdr, in either case); the
/// error (ErrorCode::usage) lists them.
Result<void> check_picture_name(const std::filesystem::path& path);

/// As check_picture_name, and that the format has the depth: png u8 u16; jpg u8; tif u8 u16 f32; exr half
/// f32; hdr f32. The error (ErrorCode::usage) lists them.
Result<void> check_picture_format(const std::filesystem::path& path, SampleDepth depth);

/// The depth a format stores by nature: u8 for .png .jpg .tif, half for .exr, f32 for .hdr.
SampleDepth natural_depth(const std::filesystem::path& path);

/// Whether a picture of that name keeps PictureFormat::metadata.
bool holds_metadata(const std::filesystem::path& path);

/// Whether a picture of that name may hold alpha in that way: .png straight, .tif and .exr in both.
bool holds_alpha(const std::filesystem::path& path, Alpha alpha);

/// Whether a picture of that name may hold several under names of their own: .exr.
bool holds_layers(const std::filesystem::path& path);

/// Starts loading what writing `path` will need in the background, if anything; returns at once. Never
/// needed, only faster. The caller keeps the thread in a scope that ends before `main` returns (its
/// destructor waits): a process must not exit in the middle of loading libraries.
[[nodiscard]] std::jthread preload_picture_codec(const std::filesystem::path& path);

/// Reads PNG, JPEG, TIFF, OpenEXR, Radiance HDR, BMP, WebP, PNM and TGA, told apart by content (TGA by
/// name). 8-bit files give u8 samples, all others f32. 1 to 4 channels: of more, the first 4; of several
/// pictures in a file, the first. Fails (ErrorCode::load) in one line with the file and what is wrong.
Result<Image> read_picture(const std::filesystem::path& path);

/// Writes whole or not at all (ErrorCode::write; ErrorCode::usage for a name or depth that the format does
/// not have). Alpha is kept where it is not 1 all over and the format has one (PNG, TIFF, EXR). u8 samples
/// become v/255 exactly; f32 samples are clamped to 0..1 and rounded to nearest for u8 and u16, NaN to 0;
/// for f32 every bit is kept, but HDR has no negatives, NaN or infinities and 8 bits of each value.
/// The same picture gives the same bytes.
Result<void> write_picture(const OutputPath& output, const Image& image, const PictureFormat& format = {});

/// One of several pictures in a file.
struct PictureLayer {
    std::string name;
    Image image;
    PictureFormat format;
};

/// As write_picture, one part of the file for each. They may differ in size and depth, not in primaries. The
/// first one's metadata is the file's for read_metadata, and its picture is what read_picture reads.
Result<void> write_layers(const OutputPath& output, std::span<const PictureLayer> layers);

class RowEncoder;

/// A picture on its way into a file, band by band from the top: only the band in hand is in memory. The file
/// appears with `finish`, whole; without it, nothing is left behind. The same bytes as `write_picture` writes
/// of the whole.
class PictureStream {
public:
    /// A side may be as long as the format allows (ErrorCode::usage otherwise): JPEG 65,500, the others a
    /// million. `alpha`: the file keeps the bands' alpha, where the format has one.
    static Result<PictureStream> create(const OutputPath& output, Extent extent, bool alpha,
                                        PictureFormat format);
    /// As `create` checks them.
    static Result<void> check_extent(const std::filesystem::path& path, Extent extent);
    PictureStream(PictureStream&&) noexcept;
    ~PictureStream();

    /// As wide as the picture, of four channels, at most as high as what is left of it.
    Result<void> add(const Image& band);
    Result<void> finish();

private:
    class File;

    Result<void> checked(const std::string& objection) const;
    PictureStream(StagedFile staged, std::filesystem::path path, bool alpha, PictureFormat format);

    std::filesystem::path path_;
    bool alpha_;
    PictureFormat format_;
    StagedFile staged_;
    std::unique_ptr<File> file_;
    std::unique_ptr<RowEncoder> encoder_;
};

} // namespace tidemark::image
