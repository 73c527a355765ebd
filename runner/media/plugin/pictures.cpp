// The picture plug-in: the only user of OpenImageIO.

#include "base/dynamic_library.hpp"
#include "media/plugin/picture_codec.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <dlfcn.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string_view>
#include <utility>

namespace tidemark::image {
namespace {

/// OpenImageIO's memory reader with a bounds check: its own reads are wrong past the last byte, where damaged
/// files lead them. It must derive from this class because the JPEG reader casts to it and uses its buffer.
class MemoryReader : public OIIO::Filesystem::IOMemReader {
public:
    explicit MemoryReader(std::span<const std::byte> bytes) : IOMemReader(bytes.data(), bytes.size()) {}
    size_t read(void* to, size_t count) override {
        const size_t done = pread(to, count, m_pos);
        m_pos += int64_t(done);
        return done;
    }
    size_t pread(void* to, size_t count, int64_t offset) override {
        if (offset < 0 || size_t(offset) >= size())
            return 0;
        count = std::min(count, size() - size_t(offset));
        std::memcpy(to, m_buf.data() + offset, count);
        return count;
    }
};

// Restores the colours of a WebP with alpha, which OpenImageIO (2.4) always multiplies by alpha.

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

/// Replaces the colours of `decoded`, OpenImageIO's bytes with alpha, by those of the file. For an animation,
/// which libwebp's simple functions cannot read, divides them by alpha again, as exactly as eight-bit
/// products allow.
void restore_colours(std::span<const std::byte> file, Image& decoded) {
    if (decoded.channels == 4 && decoded.type == SampleType::u8 && !decode_straight(file, decoded))
        divide_by_alpha(decoded);
}

/// Returns OpenImageIO's name of the format. A lookup by file name would open that file.
const char* codec_name(FileFormat format) {
    switch (format) {
    case FileFormat::png: break; // handled by libpng
    case FileFormat::jpeg: return "jpeg";
    case FileFormat::tiff: return "tiff";
    case FileFormat::exr: return "openexr";
    case FileFormat::hdr: return "hdr";
    case FileFormat::bmp: return "bmp";
    case FileFormat::webp: return "webp";
    case FileFormat::pnm: return "pnm";
    case FileFormat::tga: return "targa";
    }
    return "";
}

/// Dummy for OpenImageIO's file name parameter; no such file is opened.
constexpr std::string_view k_no_file = "<picture>";

void replace_all(std::string& text, std::string_view what, std::string_view by) {
    for (size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size())
        text.replace(at, what.size(), by);
}

/// Returns the first line of OpenImageIO's message, without the dummy file name and the names of the modules
/// that passed it on.
std::string tidied(std::string message, const char* otherwise) {
    message.resize(std::min(message.size(), message.find('\n')));
    for (const std::string_view noise :
         {"OpenEXR exception: ", "Failed OpenEXR read: ", "Cannot read image file \"<picture>\". ",
          "Error reading pixel data from image file \"<picture>\". ", "JPEG error: ", " (\"<picture>\")",
          "Could not open file: "})
        replace_all(message, noise, "");
    replace_all(message, "\"<picture>\"", "the file");
    replace_all(message, "<picture>", "the file");
    while (!message.empty() && (message.back() == ' ' || message.back() == '.'))
        message.pop_back();
    return message.empty() ? otherwise : message;
}

tl::unexpected<std::string> cannot_encode(std::string why) {
    return tl::unexpected<std::string>(tidied(std::move(why), "the codec gives no reason"));
}

tl::unexpected<std::string> cannot_decode(std::string why) {
    return tl::unexpected<std::string>(tidied(std::move(why), "the file is damaged or cut short"));
}

/// Converts exceptions of the libraries to errors.
template <class Outcome, class Action>
Outcome guarded(const Action& action) noexcept {
    try {
        return action();
    } catch (const std::bad_alloc&) {
        return tl::unexpected<std::string>("not enough memory");
    } catch (const std::exception& exception) {
        return tl::unexpected<std::string>(exception.what());
    } catch (...) {
        return tl::unexpected<std::string>("the codec failed");
    }
}

OIIO::TypeDesc file_type(SampleDepth depth) {
    switch (depth) {
    case SampleDepth::u8: return OIIO::TypeDesc::UINT8;
    case SampleDepth::u16: return OIIO::TypeDesc::UINT16;
    case SampleDepth::half: return OIIO::TypeDesc::HALF;
    case SampleDepth::f32: return OIIO::TypeDesc::FLOAT;
    }
    return OIIO::TypeDesc::UINT8;
}

/// x and y of red, green, blue and white.
constexpr float k_bt709[] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};

OIIO::ImageSpec spec_of(const EncodeJob& job) {
    OIIO::ImageSpec spec(job.extent.width, job.extent.height, job.channels, file_type(job.depth));
    if (job.channels == 2) { // grey and alpha; OpenImageIO would assume red and green
        spec.channelnames = {"Y", "A"};
        spec.alpha_channel = 1;
    }
    // prevents OpenImageIO from converting
    spec.attribute("oiio:UnassociatedAlpha", job.premultiplied ? 0 : 1);
    spec.attribute("Software", "Tidemark");
    spec.attribute("DateTime", 0); // an integer suppresses today's date
    if (job.format == FileFormat::jpeg) {
        spec.attribute("Compression", "jpeg:95");
        spec.attribute("jpeg:subsampling", "4:4:4");
    }
    if (job.format == FileFormat::tiff)
        spec.attribute("compression", "zip:1");
    if (job.format == FileFormat::exr)
        spec.attribute("compression", "zip");
    if (job.format == FileFormat::exr && job.transfer && *job.transfer != Transfer::data)
        spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), k_bt709);
    if (!job.icc_profile.empty())
        spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, int(job.icc_profile.size())),
                       job.icc_profile.data());
    for (const auto& [name, value] : job.attributes)
        spec.attribute(name, value);
    if (!job.part.empty())
        spec.attribute("oiio:subimagename", job.part);
    return spec;
}

/// Lists the specs of the parts of an OpenEXR, which share the display window of the first.
std::vector<OIIO::ImageSpec> specs_of(std::span<const EncodeJob> jobs) {
    std::vector<OIIO::ImageSpec> specs;
    for (const EncodeJob& job : jobs) {
        specs.push_back(spec_of(job));
        specs.back().full_width = jobs.front().extent.width;
        specs.back().full_height = jobs.front().extent.height;
    }
    return specs;
}

/// Writes one picture from the top down through OpenImageIO, or the parts of a file one after another.
class Rows {
public:
    explicit Rows(FileFormat format) : output_(OIIO::ImageOutput::create(codec_name(format))) {}

    RowEncoder::Done begin(const EncodeJob& job, OIIO::Filesystem::IOProxy& sink) {
        if (!output_)
            return cannot_encode(OIIO::geterror());
        take(job);
        return done(output_->set_ioproxy(&sink) && output_->open(std::string(k_no_file), spec_of(job)));
    }
    /// Starts a file of that name for several parts, because OpenImageIO 2.4 writes parts only to named
    /// files.
    RowEncoder::Done begin_parts(const std::string& file, const std::vector<OIIO::ImageSpec>& specs) {
        if (!output_)
            return cannot_encode(OIIO::geterror());
        return done(output_->open(file, int(specs.size()), specs.data()));
    }
    /// Writes a whole part. `begin_parts` has already begun the first.
    RowEncoder::Done add_part(const std::string& file, const OIIO::ImageSpec& spec, const EncodeJob& job,
                              bool first) {
        take(job);
        if (!first && !output_->open(file, spec, OIIO::ImageOutput::AppendSubimage))
            return cannot_encode(output_->geterror());
        return add(job.samples.data(), job.extent.height);
    }
    RowEncoder::Done add(const std::byte* samples, int rows) {
        const std::byte* top = samples + row_bytes_ * (rows - 1);
        const int first = std::exchange(next_, next_ + rows);
        return done(output_->write_scanlines(first, next_, 0, given_, top, OIIO::AutoStride, -row_bytes_));
    }
    RowEncoder::Done finish() { return done(output_->close()); }

private:
    void take(const EncodeJob& job) {
        const bool half = job.depth == SampleDepth::half;
        given_ = half ? OIIO::TypeDesc(OIIO::TypeDesc::FLOAT) : file_type(job.depth);
        row_bytes_ = OIIO::stride_t(size_t(job.extent.width) * size_t(job.channels) * given_.size());
        next_ = 0;
    }
    RowEncoder::Done done(bool well) {
        if (!well)
            return cannot_encode(output_->geterror());
        return {};
    }

    std::unique_ptr<OIIO::ImageOutput> output_;
    OIIO::TypeDesc given_;
    OIIO::stride_t row_bytes_ = 0;
    int next_ = 0;
};

EncodeResult encode_or_throw(const EncodeJob& job) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput sink(bytes);
    Rows rows(job.format);
    return rows.begin(job, sink)
        .and_then([&] { return rows.add(job.samples.data(), job.extent.height); })
        .and_then([&] { return rows.finish(); })
        .map([&] { return std::move(bytes); });
}

/// A file in memory that has a name within this process.
class MemoryFile {
public:
    MemoryFile() : descriptor_(::memfd_create("picture", MFD_CLOEXEC)) {}
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() { ::close(descriptor_); }

    std::string name() const { return "/proc/self/fd/" + std::to_string(descriptor_); }
    EncodeResult bytes() const {
        std::vector<unsigned char> bytes(size_t(std::max<off_t>(0, ::lseek(descriptor_, 0, SEEK_END))));
        for (size_t done = 0; done < bytes.size();) {
            const ssize_t count = ::pread(descriptor_, &bytes[done], bytes.size() - done, off_t(done));
            if (count <= 0)
                return cannot_encode("not enough memory");
            done += size_t(count);
        }
        return bytes;
    }

private:
    int descriptor_;
};

EncodeResult encode_parts_or_throw(std::span<const EncodeJob> jobs) {
    const std::vector<OIIO::ImageSpec> specs = specs_of(jobs);
    const MemoryFile file;
    Rows rows(jobs.front().format);
    RowEncoder::Done done = rows.begin_parts(file.name(), specs);
    for (size_t part = 0; done && part < jobs.size(); ++part)
        done = rows.add_part(file.name(), specs[part], jobs[part], part == 0);
    return done.and_then([&] { return rows.finish(); }).and_then([&] { return file.bytes(); });
}

class FileRows : public RowEncoder {
public:
    FileRows(FileFormat format, std::FILE* file)
        : sink_(file, OIIO::Filesystem::IOProxy::Write), rows_(format) {}

    Done begin(const EncodeJob& job) { return rows_.begin(job, sink_); }
    Done add(std::span<const std::byte> samples, int rows) noexcept override {
        return guarded<Done>([&] { return rows_.add(samples.data(), rows); });
    }
    Done finish() noexcept override {
        return guarded<Done>([&] { return rows_.finish(); });
    }

private:
    OIIO::Filesystem::IOFile sink_;
    Rows rows_;
};

/// Returns why a picture of this shape is rejected, or nothing.
std::string objection(const OIIO::ImageSpec& spec) {
    if (spec.deep)
        return "it holds deep pixels";
    if (spec.depth > 1)
        return "it is a volume";
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
        return "it has no pixels";
    if (spec.width > k_largest_side || spec.height > k_largest_side)
        return "it is " + std::to_string(spec.width) + "x" + std::to_string(spec.height) +
               " pixels; the limit is " + std::to_string(k_largest_side) + " on a side";
    return {};
}

/// Fills `pixels`, with rows from the bottom.
bool read_rows(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, int channels, const OIIO::TypeDesc& type,
               void* pixels) {
    const auto row = OIIO::stride_t(size_t(spec.width) * size_t(channels) * type.size());
    void* top = static_cast<std::byte*>(pixels) + row * (spec.height - 1);
    return input.read_image(0, 0, 0, channels, type, top, OIIO::AutoStride, -row);
}

/// Reads all samples. Divides 16-bit samples itself, because OpenImageIO multiplies by a rounded 1/65535,
/// which is not v/65535.
bool read_samples(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, Image& image) {
    if (spec.format.basetype != OIIO::TypeDesc::UINT16) {
        const auto type = image.type == SampleType::u8 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
        return read_rows(input, spec, image.channels, type, image.bytes.data());
    }
    std::vector<uint16_t> words(image.samples());
    if (!read_rows(input, spec, image.channels, OIIO::TypeDesc::UINT16, words.data()))
        return false;
    std::transform(words.begin(), words.end(), image.f32().begin(),
                   [](uint16_t word) { return float(word) / 65535.0f; });
    return true;
}

using Input = tl::expected<std::unique_ptr<OIIO::ImageInput>, std::string>;

Input open_input(FileFormat format, MemoryReader& source, OIIO::ImageSpec& spec) {
    std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(codec_name(format));
    if (!input)
        return cannot_decode(OIIO::geterror());
    OIIO::ImageSpec request;
    request.attribute("oiio:UnassociatedAlpha", 1); // do not multiply by alpha
    OIIO::Filesystem::IOProxy* proxy = &source;     // set_ioproxy is undone by an open with a request
    request.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    if (!input->open(std::string(k_no_file), spec, request))
        return cannot_decode(input->geterror());
    return input;
}

TextsResult texts_or_throw(FileFormat format, std::span<const std::byte> file) {
    MemoryReader source(file);
    OIIO::ImageSpec spec;
    const auto input = open_input(format, source, spec);
    if (!input)
        return tl::unexpected(input.error());
    std::vector<std::pair<std::string, std::string>> texts;
    for (const OIIO::ParamValue& attribute : spec.extra_attribs)
        if (attribute.type() == OIIO::TypeString)
            texts.emplace_back(attribute.name().string(), attribute.get_string());
    return texts;
}

DecodeResult decode_or_throw(FileFormat format, std::span<const std::byte> file) {
    MemoryReader source(file);
    OIIO::ImageSpec spec;
    const auto opened = open_input(format, source, spec);
    if (!opened)
        return tl::unexpected(opened.error());
    const std::unique_ptr<OIIO::ImageInput>& input = *opened;
    if (std::string why = objection(spec); !why.empty())
        return cannot_decode(std::move(why));
    const bool bytes = spec.format.basetype == OIIO::TypeDesc::UINT8;
    const int channels = std::min(spec.nchannels, 4);
    const size_t total = size_t(spec.width) * size_t(spec.height) * size_t(channels) * (bytes ? 1 : 4);
    if (total > k_largest_picture)
        return cannot_decode("it takes " + std::to_string(total >> 20) + " MiB; the limit is " +
                             std::to_string(k_largest_picture >> 20));
    Image image({spec.width, spec.height}, channels, bytes ? SampleType::u8 : SampleType::f32);
    if (!read_samples(*input, spec, image))
        return cannot_decode(input->geterror());
    if (format == FileFormat::webp)
        restore_colours(file, image);
    return image;
}

EncodeResult encode(const EncodeJob& job) noexcept {
    return guarded<EncodeResult>([&] { return encode_or_throw(job); });
}

EncodeResult encode_parts(std::span<const EncodeJob> jobs) noexcept {
    return guarded<EncodeResult>([&] { return encode_parts_or_throw(jobs); });
}

RowEncoderResult encode_rows(const EncodeJob& job, std::FILE* file) noexcept {
    return guarded<RowEncoderResult>([&]() -> RowEncoderResult {
        auto rows = std::make_unique<FileRows>(job.format, file);
        return rows->begin(job).map([&]() -> std::unique_ptr<RowEncoder> { return std::move(rows); });
    });
}

DecodeResult decode(FileFormat format, std::span<const std::byte> file) noexcept {
    return guarded<DecodeResult>([&] { return decode_or_throw(format, file); });
}

TextsResult texts(FileFormat format, std::span<const std::byte> file) noexcept {
    return guarded<TextsResult>([&] { return texts_or_throw(format, file); });
}

/// Removes libtiff's message handlers: OpenImageIO 2.5 stores a message, but also lets libtiff print it.
void silence_libtiff() {
    using SetHandler = void* (*)(void*);
    if (void* library = ::dlopen("libtiff.so.6", RTLD_LAZY | RTLD_NOLOAD))
        for (const char* name : {"TIFFSetErrorHandler", "TIFFSetWarningHandler"})
            if (const auto set = reinterpret_cast<SetHandler>(::dlsym(library, name)))
                set(nullptr);
}

} // namespace

extern "C" __attribute__((visibility("default"))) const void* tidemark_picture_codec() {
    static const PictureCodec codec = [] {
        // Use only the calling thread: the other cores draw, and no thread pool remains to be ended at exit.
        OIIO::attribute("threads", 1);
        OIIO::attribute("exr_threads", -1);
        OIIO::attribute("debug", 0); // Debian's build prints on stderr otherwise
        silence_libtiff();
        return PictureCodec{k_picture_codec_version, encode, decode, texts, encode_rows, encode_parts};
    }();
    return &codec;
}

} // namespace tidemark::image
