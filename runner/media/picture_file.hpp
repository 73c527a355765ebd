// Reads and writes pictures. libpng handles PNG; OpenImageIO handles the other formats, in a plug-in that is
// loaded at the first use or ahead of it by `preload_picture_codec`. Samples are not converted (gamma, colour
// space, alpha, camera orientation) unless PictureFormat requests it, but rows are reversed, because files
// run from the top and an Image from the bottom. All functions are thread-safe.
#pragma once

#include "base/error.hpp"
#include "base/file.hpp"
#include "media/image.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace tidemark::image {

/// The type of a sample in the file.
enum class SampleDepth { u8, u16, half, f32 };

/// The largest picture that is read, or written from memory: pixels on a side, and bytes in memory.
inline constexpr int k_largest_side = 16384;
inline constexpr size_t k_largest_picture = size_t{1} << 30;

/// Treatment of a picture's alpha in a file that has alpha.
enum class Alpha {
    where_needed,  ///< unchanged, but dropped if it is 1 everywhere
    straight,      ///< unchanged, and not multiplied into the colours
    premultiplied, ///< multiplied into the file's colours, after they are decoded
};

/// Storage options of a picture.
struct PictureFormat {
    SampleDepth depth = SampleDepth::u8;
    /// Names and values (UTF-8). PNG: a text chunk `tidemark:<name>` each; EXR: a string attribute
    /// `tidemark:<name>` each; TIFF and JPEG: a line `tidemark:<name>=<value>` each in the image description
    /// or comment; HDR: not stored. A name is 1 to 60 printable ASCII characters without spaces; a value is
    /// cut at a NUL, and a JPEG's values together at 32,000 bytes.
    std::vector<std::pair<std::string, std::string>> metadata{};
    /// The colour space that the file declares, if the format can: PNG in chunks, TIFF and JPEG in a profile,
    /// EXR in attributes. For `linear`, the Image's sRGB is decoded when it is written. None: the file
    /// declares none.
    std::optional<Transfer> transfer{};
    Alpha alpha = Alpha::where_needed;
};

/// Checks that `path` ends in a format we write (.png .jpg .jpeg .tif .tiff .exr .hdr, in either case); the
/// error (ErrorCode::usage) lists them.
Result<void> check_picture_name(const std::filesystem::path& path);

/// Checks the name like check_picture_name, and that the format has the depth: png u8 u16; jpg u8; tif u8 u16
/// f32; exr half f32; hdr f32. The error (ErrorCode::usage) lists them.
Result<void> check_picture_format(const std::filesystem::path& path, SampleDepth depth);

/// Returns the format's default depth: u8 for .png .jpg .tif, half for .exr, f32 for .hdr.
SampleDepth natural_depth(const std::filesystem::path& path);

/// Returns whether a picture of that name keeps PictureFormat::metadata.
bool holds_metadata(const std::filesystem::path& path);

/// Returns whether a picture of that name can hold alpha in that way: .png straight, .tif and .exr in both.
bool holds_alpha(const std::filesystem::path& path, Alpha alpha);

/// Returns whether a picture of that name can hold several named pictures: .exr.
bool holds_layers(const std::filesystem::path& path);

/// Starts to load the codec for writing `path` in the background, if one is needed, and returns at once.
/// Optional, for speed only. The caller must destroy the thread (which waits) before `main` returns, because
/// a process must not exit while libraries are loading.
[[nodiscard]] std::jthread preload_picture_codec(const std::filesystem::path& path);

/// Reads PNG, JPEG, TIFF, OpenEXR, Radiance HDR, BMP, WebP, PNM and TGA, recognised by content (TGA by name).
/// 8-bit files give u8 samples, all others f32. Returns 1 to 4 channels: the first 4 if there are more; of
/// several pictures in a file, the first. Fails (ErrorCode::load) with one line that names the file and the
/// error.
Result<Image> read_picture(const std::filesystem::path& path);

/// Writes the whole file or none (ErrorCode::write; ErrorCode::usage for a name or depth that the format does
/// not have). Alpha is kept if it is not 1 everywhere and the format has alpha (PNG, TIFF, EXR). u8 samples
/// become v/255 exactly; f32 samples are clamped to 0..1 and rounded to nearest for u8 and u16, NaN to 0. For
/// f32 every bit is kept, but HDR has no negatives, NaN or infinities and 8 bits per value. Equal pictures
/// give equal bytes.
Result<void> write_picture(const OutputPath& output, const Image& image, const PictureFormat& format = {});

/// One of several pictures in a file.
struct PictureLayer {
    std::string name;
    Image image;
    PictureFormat format;
};

/// Writes several pictures like write_picture, each as a part of the file. They may differ in size and depth
/// but not in primaries. read_metadata reads the metadata of the first, and read_picture its picture.
Result<void> write_layers(const OutputPath& output, std::span<const PictureLayer> layers);

class RowEncoder;

/// Writes a picture band by band from the top, with only one band in memory. The complete file appears at
/// `finish`; without it no file remains. The bytes equal those of `write_picture` for the whole picture.
class PictureStream {
public:
    /// Starts a file. A side may be as long as the format allows (ErrorCode::usage otherwise): JPEG 65,500,
    /// the others a million. `alpha`: keeps the bands' alpha if the format has alpha.
    static Result<PictureStream> create(const OutputPath& output, Extent extent, bool alpha,
                                        PictureFormat format);
    /// Checks the size like `create`.
    static Result<void> check_extent(const std::filesystem::path& path, Extent extent);
    PictureStream(PictureStream&&) noexcept;
    ~PictureStream();

    /// Writes a band: as wide as the picture, with four channels, and at most as high as the rest of the
    /// picture.
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
