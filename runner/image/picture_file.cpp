#include "image/picture_file.hpp"

#include "base/file.hpp"
#include "image/codec_loader.hpp"
#include "image/file_check.hpp"
#include "image/file_samples.hpp"
#include "image/plugin/picture_codec.hpp"
#include "image/png_codec.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <optional>
#include <string_view>

namespace tidemark::image {
namespace fs = std::filesystem;
namespace {

/// A JPEG segment holds 64 KiB, of which other entries need some; libjpeg ends the process when it is more.
constexpr size_t k_longest_jpeg_text = 32000;

struct WrittenFormat {
    std::string_view extension;
    FileFormat format;
    bool has_alpha;
    std::vector<SampleDepth> depths; ///< the natural one first
};

const std::vector<WrittenFormat>& written_formats() {
    using enum SampleDepth;
    static const std::vector<WrittenFormat> formats = {
        {".png", FileFormat::png, true, {u8, u16}},        {".jpg", FileFormat::jpeg, false, {u8}},
        {".jpeg", FileFormat::jpeg, false, {u8}},          {".tif", FileFormat::tiff, true, {u8, u16, f32}},
        {".tiff", FileFormat::tiff, true, {u8, u16, f32}}, {".exr", FileFormat::exr, true, {half, f32}},
        {".hdr", FileFormat::hdr, false, {f32}},
    };
    return formats;
}

std::string lower_extension(const fs::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z')
            c = char(c - 'A' + 'a');
    return extension;
}

const WrittenFormat* written_format(const fs::path& path) {
    const std::string extension = lower_extension(path);
    const auto& formats = written_formats();
    const auto found = std::find_if(formats.begin(), formats.end(), [&](const WrittenFormat& format) {
        return format.extension == extension;
    });
    return found == formats.end() ? nullptr : &*found;
}

std::string_view name_of(SampleDepth depth) {
    switch (depth) {
    case SampleDepth::u8: return "8-bit";
    case SampleDepth::u16: return "16-bit";
    case SampleDepth::half: return "half";
    case SampleDepth::f32: return "float";
    }
    return "";
}

std::string names_of(const std::vector<SampleDepth>& depths) {
    std::vector<std::string_view> names;
    for (const SampleDepth depth : depths)
        names.push_back(name_of(depth));
    return fmt::format("{}", fmt::join(names, ", "));
}

[[maybe_unused]] bool is_metadata_name(std::string_view name) {
    return !name.empty() && name.size() <= 60 &&
           std::all_of(name.begin(), name.end(), [](char c) { return c > ' ' && c < '\x7f'; });
}

/// Names that no format gives a meaning of its own, which would change the file or be dropped.
std::vector<std::pair<std::string, std::string>> attributes(FileFormat format, const PictureFormat& wanted) {
    std::vector<std::pair<std::string, std::string>> all;
    std::string lines;
    for (const auto& [name, value] : wanted.metadata) {
        assert(is_metadata_name(name));
        const std::string text(
            value.c_str()); // NOLINT(readability-redundant-string-cstr): ends at a zero byte
        all.emplace_back("tidemark:" + name, text);
        lines += fmt::format("{}={}\n", all.back().first, text);
    }
    if (format == FileFormat::png || format == FileFormat::exr)
        return all;
    if (format == FileFormat::jpeg)
        lines.resize(std::min(lines.size(), k_longest_jpeg_text));
    if (format == FileFormat::hdr || lines.empty())
        return {};
    return {{"ImageDescription", lines}};
}

EncodeJob encode_job(const WrittenFormat& written, const Image& image, const PictureFormat& wanted) {
    EncodeJob job{written.format, wanted.depth, image.extent, 0, {}, attributes(written.format, wanted)};
    const auto take = [&](const Image& stored) {
        job.channels = stored.channels;
        job.samples = file_samples(stored, wanted.depth);
    };
    if (written.format == FileFormat::hdr)
        take(radiance_samples(image));
    else if (image.has_alpha() && (!written.has_alpha || has_opaque_alpha(image)))
        take(without_alpha(image));
    else
        take(image);
    return job;
}

tl::unexpected<Error> cannot_write(const fs::path& path, std::string_view why) {
    return fail(ErrorCode::write, fmt::format("cannot write '{}': {}", path.string(), why));
}

Result<void> check_extent(const fs::path& path, const Image& image) {
    const Extent extent = image.extent;
    if (extent.width < 1 || extent.height < 1)
        return cannot_write(path, "the picture has no pixels");
    if (extent.width > k_largest_side || extent.height > k_largest_side)
        return cannot_write(path, fmt::format("it is {}x{} pixels; the limit is {} on a side", extent.width,
                                              extent.height, k_largest_side));
    assert(image.channels >= 1 && image.channels <= 4);
    assert(image.bytes.size() == image.samples() * size_of(image.type));
    return {};
}

/// The outer error: there is no codec for it. The inner one: what the codec says of the picture.
Result<DecodeResult> decode(FileFormat format, std::span<const std::byte> file) {
    if (format == FileFormat::png)
        return decode_png(file);
    return picture_codec().map([&](const PictureCodec* codec) { return codec->decode(format, file); });
}

Result<EncodeResult> encode(const EncodeJob& job) {
    if (job.format == FileFormat::png)
        return encode_png(job);
    return picture_codec().map([&](const PictureCodec* codec) { return codec->encode(job); });
}

} // namespace

Result<void> check_picture_name(const fs::path& path) {
    if (written_format(path))
        return {};
    return fail(ErrorCode::usage,
                fmt::format("cannot tell the picture format of '{}': its name must end in .png, "
                            ".jpg, .jpeg, .tif, .tiff, .exr or .hdr",
                            path.string()));
}

Result<void> check_picture_format(const fs::path& path, SampleDepth depth) {
    return check_picture_name(path).and_then([&]() -> Result<void> {
        const WrittenFormat& format = *written_format(path);
        if (std::find(format.depths.begin(), format.depths.end(), depth) != format.depths.end())
            return {};
        return fail(ErrorCode::usage, fmt::format("'{}' cannot hold {} samples: {} holds {}", path.string(),
                                                  name_of(depth), format.extension, names_of(format.depths)));
    });
}

SampleDepth natural_depth(const fs::path& path) {
    const WrittenFormat* format = written_format(path);
    return format ? format->depths.front() : SampleDepth::u8;
}

std::jthread preload_picture_codec(const fs::path& path) {
    const WrittenFormat* format = written_format(path);
    if (!format || format->format == FileFormat::png)
        return {};
    return std::jthread([] { picture_codec(); });
}

Result<Image> read_picture(const fs::path& path) {
    Result<std::string> file = read_file(path, k_largest_picture);
    if (!file)
        return fail(std::move(file.error()));
    const auto refuse = [&](std::string_view why) {
        return fail(ErrorCode::load, fmt::format("cannot read '{}': {}", path.string(), why));
    };
    if (file->empty())
        return refuse("the file is empty");
    const std::optional<FileFormat> format = format_of(*file, path);
    if (!format)
        return refuse("it is no PNG, JPEG, TIFF, EXR, HDR, BMP, WebP, PNM or TGA picture");
    const auto checked = checked_file(*format, std::move(*file));
    if (!checked)
        return refuse(checked.error());
    auto image = decode(*format, std::as_bytes(std::span(*checked)));
    if (!image)
        return fail(std::move(image.error()));
    if (!*image)
        return refuse(image->error());
    return std::move(**image);
}

Result<void> write_picture(const fs::path& path, const Image& image, const PictureFormat& format) {
    if (Result<void> checked = check_picture_format(path, format.depth); !checked)
        return checked;
    if (Result<void> checked = check_extent(path, image); !checked)
        return checked;
    const auto file = encode(encode_job(*written_format(path), image, format));
    if (!file)
        return fail(ErrorCode::write, file.error().message);
    if (!*file)
        return cannot_write(path, file->error());
    return write_file(path, std::as_bytes(std::span(**file)));
}

} // namespace tidemark::image
