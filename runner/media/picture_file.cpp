// Makes the ICC profile that TIFF and JPEG files contain.

#include "media/picture_file.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "media/file_samples.hpp"
#include "media/image.hpp"
#include "media/picture_check.hpp"
#include "media/picture_codecs.hpp"
#include "media/plugin/picture_codec.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace tidemark::image {

namespace {

/// Appends values in the formats of ICC.1:2010 (profile version 4.2), most significant byte first.
class Bytes {
public:
    Bytes& text(std::string_view characters) {
        bytes_ += characters;
        return *this;
    }
    Bytes& u32(uint32_t number) { return u16(uint16_t(number >> 16)).u16(uint16_t(number)); }
    Bytes& u16(uint16_t number) {
        bytes_ += {char(number >> 8), char(number)};
        return *this;
    }
    /// Appends s15Fixed16Number values.
    Bytes& fixed(std::initializer_list<double> numbers) {
        for (const double number : numbers)
            u32(uint32_t(std::lround(number * 65536)));
        return *this;
    }
    Bytes& zeros(size_t count) { return text(std::string(count, '\0')); }

    const std::string& str() const { return bytes_; }

private:
    std::string bytes_;
};

std::string words(std::string_view text) {
    constexpr uint32_t k_start = 28; // offset of the only record's text
    Bytes bytes;
    bytes.text("mluc").u32(0).u32(1).u32(12).text("enUS").u32(uint32_t(2 * text.size())).u32(k_start);
    for (const char c : text)
        bytes.u16(uint16_t(c));
    return bytes.zeros(text.size() % 2 * 2).str();
}

std::string colour(std::initializer_list<double> xyz) {
    return Bytes().text("XYZ ").u32(0).fixed(xyz).str();
}

/// Encodes a parametric curve: a power for linear, else a power with a linear beginning.
std::string curve(Transfer transfer) {
    Bytes bytes;
    bytes.text("para").u32(0);
    if (transfer == Transfer::linear)
        return bytes.u16(0).u16(0).fixed({1}).str();
    return bytes.u16(3).u16(0).fixed({2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045}).str();
}

struct ProfileTag {
    std::string_view name;
    std::string content;
};

/// Lists the tags. Colours are relative to D50, the white of every profile, adapted from D65 by Bradford's
/// matrix.
std::vector<ProfileTag> tags_of(Transfer transfer) {
    const std::string adaptation = Bytes()
                                       .text("sf32")
                                       .u32(0)
                                       .fixed({1.0478860, 0.0229188, -0.0502161, 0.0295818, 0.9904835,
                                               -0.0170787, -0.0092519, 0.0150726, 0.7516781})
                                       .str();
    return {{"desc", words(transfer == Transfer::linear ? "linear BT.709" : "sRGB")},
            {"cprt", words("none")},
            {"wtpt", colour({0.9642, 1, 0.8249})},
            {"chad", adaptation},
            {"rXYZ", colour({0.4360413, 0.2224845, 0.0139202})},
            {"gXYZ", colour({0.3851129, 0.7169051, 0.0970672})},
            {"bXYZ", colour({0.1430458, 0.0606104, 0.7139126})},
            {"rTRC", curve(transfer)},
            {"gTRC", curve(transfer)},
            {"bTRC", curve(transfer)}};
}

/// Encodes the header of a display profile. The date is fixed, so that equal pictures give equal files.
std::string header(size_t size) {
    Bytes bytes;
    bytes.u32(uint32_t(size)).u32(0).u32(0x04200000).text("mntrRGB XYZ ");
    bytes.u16(2026).u16(1).u16(1).zeros(6);
    return bytes.text("acsp").zeros(28).fixed({0.9642, 1, 0.8249}).zeros(48).str();
}

} // namespace

/// Returns a version 4 profile with BT.709's primaries and the transfer curve, always the same bytes; empty
/// for Transfer::data.
std::vector<std::byte> icc_profile(Transfer transfer) {
    if (transfer == Transfer::data)
        return {};
    constexpr size_t k_header = 128;
    constexpr size_t k_row = 12;
    const std::vector<ProfileTag> tags = tags_of(transfer);
    const size_t first = k_header + 4 + k_row * tags.size();
    Bytes table;
    table.u32(uint32_t(tags.size()));
    std::string contents;
    for (const ProfileTag& tag : tags) {
        table.text(tag.name).u32(uint32_t(first + contents.size())).u32(uint32_t(tag.content.size()));
        contents += tag.content;
    }
    const std::string file = header(first + contents.size()) + table.str() + contents;
    const auto* begin = reinterpret_cast<const std::byte*>(file.data());
    return {begin, begin + file.size()};
}

namespace fs = std::filesystem;
namespace {

/// A JPEG segment holds 64 KiB, of which other entries need some; libjpeg ends the process when it overflows.
constexpr size_t k_longest_jpeg_text = 32000;

struct WrittenFormat {
    std::string_view extension;
    FileFormat format;
    bool has_alpha;
    std::vector<SampleDepth> depths; ///< the default first
    int longest_side = 1'000'000;    ///< libpng's own limit
};

const std::vector<WrittenFormat>& written_formats() {
    using enum SampleDepth;
    static const std::vector<WrittenFormat> formats = {
        {".png", FileFormat::png, true, {u8, u16}},        {".jpg", FileFormat::jpeg, false, {u8}, 65500},
        {".jpeg", FileFormat::jpeg, false, {u8}, 65500},   {".tif", FileFormat::tiff, true, {u8, u16, f32}},
        {".tiff", FileFormat::tiff, true, {u8, u16, f32}}, {".exr", FileFormat::exr, true, {half, f32}},
        {".hdr", FileFormat::hdr, false, {f32}},
    };
    return formats;
}

std::string lower_extension(const fs::path& path) {
    return lower_case(path.extension().string());
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

/// Returns the name that the Color Interop Forum gives the colour space.
const char* interop_id(Transfer transfer) {
    switch (transfer) {
    case Transfer::data: return "data";
    case Transfer::srgb: return "srgb_rec709_display";
    case Transfer::linear: return "lin_rec709_scene";
    }
    return "";
}

/// Returns the attributes to write. Their names have no predefined meaning in any format, because such
/// attributes could change the file or be dropped.
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
    if (format == FileFormat::exr && wanted.transfer)
        all.emplace_back("colorInteropID", interop_id(*wanted.transfer));
    if (format == FileFormat::png || format == FileFormat::exr)
        return all;
    if (format == FileFormat::jpeg)
        lines.resize(std::min(lines.size(), k_longest_jpeg_text));
    if (format == FileFormat::hdr || lines.empty())
        return {};
    return {{"ImageDescription", lines}};
}

EncodeJob job_without_samples(const WrittenFormat& written, Extent extent, int channels,
                              const PictureFormat& wanted) {
    const bool profiled = written.format == FileFormat::jpeg || written.format == FileFormat::tiff;
    EncodeJob job{written.format, wanted.depth, extent, channels, {}, attributes(written.format, wanted)};
    job.transfer = wanted.transfer;
    job.premultiplied = wanted.alpha == Alpha::premultiplied;
    if (profiled && wanted.transfer && channels >= 3)
        job.icc_profile = icc_profile(*wanted.transfer);
    return job;
}

/// Converts a picture, or a band of one, to the samples of its file. Returns these and their channels.
std::pair<std::vector<std::byte>, int> stored(const WrittenFormat& written, const Image& drawn, bool alpha,
                                              const PictureFormat& wanted) {
    const auto take = [&](const Image& kept) {
        return std::pair(file_samples(kept, wanted.depth), kept.channels);
    };
    const auto light = wanted.transfer == Transfer::linear ? std::optional(in_light(drawn)) : std::nullopt;
    const auto associated = wanted.alpha == Alpha::premultiplied
                                ? std::optional(premultiplied(light ? *light : drawn))
                                : std::nullopt;
    const Image& image = associated ? *associated : light ? *light : drawn;
    if (written.format == FileFormat::hdr)
        return take(radiance_samples(image));
    return image.has_alpha() && !(alpha && written.has_alpha) ? take(without_alpha(image)) : take(image);
}

EncodeJob encode_job(const WrittenFormat& written, const Image& image, const PictureFormat& wanted) {
    const bool alpha = wanted.alpha != Alpha::where_needed || !has_opaque_alpha(image);
    auto [samples, channels] = stored(written, image, alpha, wanted);
    EncodeJob job = job_without_samples(written, image.extent, channels, wanted);
    job.samples = std::move(samples);
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

/// Decodes a file. The outer error means that the codec is missing, the inner one that it rejects the
/// picture.
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

Result<RowEncoderResult> encode_rows(const EncodeJob& job, std::FILE* file) {
    if (job.format == FileFormat::png)
        return encode_png_rows(job, file);
    return picture_codec().map([&](const PictureCodec* codec) { return codec->encode_rows(job, file); });
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

bool holds_metadata(const fs::path& path) {
    const WrittenFormat* format = written_format(path);
    return format && format->format != FileFormat::hdr;
}

bool holds_alpha(const fs::path& path, Alpha alpha) {
    const WrittenFormat* format = written_format(path);
    return format && format->has_alpha &&
           (alpha != Alpha::premultiplied || format->format != FileFormat::png);
}

bool holds_layers(const fs::path& path) {
    const WrittenFormat* format = written_format(path);
    return format && format->format == FileFormat::exr;
}

std::jthread preload_picture_codec(const fs::path& path) {
    const WrittenFormat* format = written_format(path);
    if (!format || format->format == FileFormat::png)
        return {};
    try {
        return std::jthread([] { picture_codec(); });
    } catch (const std::system_error&) { // no more threads available
        return {};
    }
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
        return refuse("it is not a PNG, JPEG, TIFF, EXR, HDR, BMP, WebP, PNM or TGA picture");
    const auto checked = checked_file(*format, std::move(*file));
    if (!checked)
        return refuse(checked.error());
    auto image = TRY(decode(*format, std::as_bytes(std::span(*checked))));
    if (!image)
        return refuse(image.error());
    return std::move(*image);
}

Result<void> write_picture(const OutputPath& output, const Image& image, const PictureFormat& format) {
    const fs::path& path = output.path();
    if (Result<void> checked = check_picture_format(path, format.depth); !checked)
        return checked;
    if (Result<void> checked = check_extent(path, image); !checked)
        return checked;
    const auto file = encode(encode_job(*written_format(path), image, format));
    if (!file)
        return fail(ErrorCode::write, file.error().message);
    if (!*file)
        return cannot_write(path, file->error());
    return write_file(output, std::as_bytes(std::span(**file)));
}

Result<void> write_layers(const OutputPath& output, std::span<const PictureLayer> layers) {
    const fs::path& path = output.path();
    assert(holds_layers(path) && !layers.empty());
    std::vector<EncodeJob> jobs;
    for (const PictureLayer& layer : layers) {
        TRY(check_picture_format(path, layer.format.depth));
        TRY(check_extent(path, layer.image));
        jobs.push_back(encode_job(*written_format(path), layer.image, layer.format));
        jobs.back().part = layer.name;
    }
    const auto& codec = picture_codec();
    if (!codec)
        return fail(ErrorCode::write, codec.error().message);
    const auto file = (*codec)->encode_parts(jobs);
    if (!file)
        return cannot_write(path, file.error());
    return write_file(output, std::as_bytes(std::span(*file)));
}

/// A stream for encoders that hides write errors from them: on a full disk libjpeg would end the process, and
/// others do not report the reason.
class PictureStream::File {
public:
    /// Does not own the descriptor.
    explicit File(int descriptor)
        : descriptor_(descriptor), stream_(::fopencookie(this, "wb", {nullptr, write, seek, nullptr})) {}
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    ~File() { finish(); }

    std::FILE* stream() const { return stream_; }
    /// Returns errno of the first failed call; 0: none.
    int error() const { return error_; }
    void finish() {
        if (std::FILE* stream = std::exchange(stream_, nullptr))
            std::fclose(stream);
    }

private:
    void keep_error() {
        if (error_ == 0)
            error_ = errno;
    }
    static ssize_t write(void* file, const char* bytes, size_t size) {
        auto& self = *static_cast<File*>(file);
        for (size_t done = 0; done < size && self.error_ == 0;) {
            const ssize_t written = ::write(self.descriptor_, bytes + done, size - done);
            if (written >= 0)
                done += size_t(written);
            else if (errno != EINTR)
                self.keep_error();
        }
        return ssize_t(size);
    }
    static int seek(void* file, off64_t* offset, int from) {
        *offset = ::lseek64(static_cast<File*>(file)->descriptor_, *offset, from);
        return *offset < 0 ? -1 : 0;
    }

    int descriptor_;
    int error_ = 0;
    std::FILE* stream_;
};

PictureStream::PictureStream(StagedFile staged, fs::path path, bool alpha, PictureFormat format)
    : path_(std::move(path)), alpha_(alpha), format_(std::move(format)), staged_(std::move(staged)),
      file_(std::make_unique<File>(staged_.descriptor())) {}

PictureStream::PictureStream(PictureStream&&) noexcept = default;
PictureStream::~PictureStream() = default;

/// Returns the system's error if there is one, else the encoder's (`objection`, empty: none).
Result<void> PictureStream::checked(const std::string& objection) const {
    if (const int error = file_->error())
        return cannot_write(path_, system_reason(error));
    return objection.empty() ? Result<void>() : cannot_write(path_, objection);
}

Result<void> PictureStream::check_extent(const fs::path& path, Extent extent) {
    const int longest = written_format(path)->longest_side;
    if (std::max(extent.width, extent.height) <= longest)
        return {};
    return fail(ErrorCode::usage, fmt::format("--size {}x{}: a {} has at most {} pixels on a side",
                                              extent.width, extent.height, lower_extension(path), longest));
}

Result<PictureStream> PictureStream::create(const OutputPath& output, Extent extent, bool alpha,
                                            PictureFormat format) {
    const fs::path& path = output.path();
    if (Result<void> checked = check_picture_format(path, format.depth); !checked)
        return fail(std::move(checked.error()));
    if (Result<void> checked = check_extent(path, extent); !checked)
        return fail(std::move(checked.error()));
    auto staged = TRY(StagedFile::create(output));
    PictureStream stream(std::move(staged), path, alpha, std::move(format));
    const WrittenFormat& written = *written_format(path);
    const bool keeps_alpha = alpha && written.has_alpha;
    auto encoder = encode_rows(job_without_samples(written, extent, keeps_alpha ? 4 : 3, stream.format_),
                               stream.file_->stream());
    if (!encoder)
        return fail(ErrorCode::write, encoder.error().message);
    if (!*encoder)
        return cannot_write(path, encoder->error());
    stream.encoder_ = **std::move(encoder);
    return stream;
}

Result<void> PictureStream::add(const Image& band) {
    const auto [samples, channels] = stored(*written_format(path_), band, alpha_, format_);
    const auto added = encoder_->add(samples, band.extent.height);
    return checked(added ? std::string() : added.error());
}

Result<void> PictureStream::finish() {
    const auto finished = encoder_->finish();
    encoder_.reset();
    file_->finish();
    TRY(checked(finished ? std::string() : finished.error()));
    return staged_.commit();
}

} // namespace tidemark::image
