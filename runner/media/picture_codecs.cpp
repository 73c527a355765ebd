#include "media/picture_codecs.hpp"

#include "base/dynamic_library.hpp"

#include <png.h>

#include <bit>
#include <cerrno>
#include <csetjmp>
#include <cstring>
#include <future>
#include <system_error>
#include <thread>

namespace tidemark::image {
namespace {

/// Checks that enough threads can be created. The plug-in's libraries start threads while loading, and end
/// the process or block forever if they cannot. The driver may start its own threads at the same time.
bool threads_are_to_be_had() {
    const unsigned count = 8 + 2 * std::thread::hardware_concurrency();
    std::promise<void> end;
    const std::shared_future<void> ended = end.get_future().share();
    bool good = true;
    std::vector<std::jthread> threads;
    try {
        while (threads.size() < count)
            threads.emplace_back([ended] { ended.wait(); });
    } catch (const std::system_error&) {
        good = false;
    }
    end.set_value();
    return good;
}

Result<const PictureCodec*> load_codec() {
    if (!threads_are_to_be_had())
        return fail(ErrorCode::load, "cannot load the picture plug-in: the system allows too few threads, or "
                                     "too little memory for them");
    const PlugIn plug_in{"tidemark_pictures.so", "picture plug-in",     "reading and writing pictures",
                         "OpenImageIO 2.4",      k_picture_codec_entry, k_picture_codec_version};
    return load_plug_in<PictureCodec>(plug_in);
}

} // namespace

const Result<const PictureCodec*>& picture_codec() {
    static const Result<const PictureCodec*> codec = load_codec();
    return codec;
}

namespace {

constexpr int k_kinds[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                           PNG_COLOR_TYPE_RGB_ALPHA};

/// Keeps libpng's error message and jumps out of libpng.
void keep_error(png_structp png, png_const_charp message) {
    *static_cast<std::string*>(png_get_error_ptr(png)) = message;
    longjmp(png_jmpbuf(png), 1);
}

void drop_warning(png_structp, png_const_charp) {}

/// Calls libpng in `work`, which must own nothing, because an error leaves it by longjmp. Returns false on an
/// error.
template <class Work>
bool guarded(png_structp png, const Work& work) {
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    work();
    return true;
}

/// Makes a text chunk that refers to `name` and `value`, which must outlive it. libpng does not modify them.
png_text text_chunk(const char* name, const char* value) {
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = const_cast<png_charp>(name);
    text.text = const_cast<png_charp>(value);
    text.text_length = std::strlen(value);
    return text;
}

/// Receives libpng's output; must not throw, and reports errors by png_error.
using Sink = void (*)(png_structp png, png_bytep data, size_t size);

void append(png_structp png, png_bytep data, size_t size) {
    auto& bytes = *static_cast<std::vector<unsigned char>*>(png_get_io_ptr(png));
    bytes.insert(bytes.end(), data, data + size);
}

void put(png_structp png, png_bytep data, size_t size) {
    if (std::fwrite(data, 1, size, static_cast<std::FILE*>(png_get_io_ptr(png))) != size)
        png_error(png, std::strerror(errno));
}

class Writer : public RowEncoder {
public:
    Writer(const EncodeJob& job, Sink sink, void* into)
        : row_bytes_(size_t(job.extent.width) * size_t(job.channels) *
                     (job.depth == SampleDepth::u16 ? 2 : 1)),
          png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &error_, keep_error, drop_warning)) {
        if (png_)
            info_ = png_create_info_struct(png_);
        if (info_)
            png_set_write_fn(png_, into, sink, nullptr);
    }
    ~Writer() override { png_destroy_write_struct(&png_, &info_); }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    Done begin(const EncodeJob& job) {
        if (!info_)
            return tl::unexpected<std::string>("out of memory");
        std::vector<png_text> texts{text_chunk("Software", "Tidemark")};
        for (const auto& [name, value] : job.attributes)
            texts.push_back(text_chunk(name.c_str(), value.c_str()));
        return done([&] { write_header(job, texts); });
    }
    Done add(std::span<const std::byte> samples, int rows) noexcept override {
        return done([&] {
            for (int y = rows; y-- > 0;) // files run from the top
                png_write_row(png_,
                              reinterpret_cast<png_const_bytep>(samples.data() + size_t(y) * row_bytes_));
        });
    }
    Done finish() noexcept override {
        return done([&] { png_write_end(png_, info_); });
    }

private:
    template <class Work>
    Done done(const Work& work) {
        if (!guarded(png_, work))
            return tl::unexpected(error_);
        return {};
    }

    void write_header(const EncodeJob& job, const std::vector<png_text>& texts) {
        // Level 1 takes a sixth of the time of level 6 for a quarter more bytes; SUB alone takes two thirds
        // of the time of trying all filters.
        png_set_compression_level(png_, 1);
        png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
        const int depth = job.depth == SampleDepth::u16 ? 16 : 8;
        png_set_IHDR(png_, info_, png_uint_32(job.extent.width), png_uint_32(job.extent.height), depth,
                     k_kinds[job.channels - 1], PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                     PNG_FILTER_TYPE_DEFAULT);
        if (job.transfer)
            write_transfer(*job.transfer);
        png_set_text(png_, info_, texts.data(), int(texts.size()));
        png_write_info(png_, info_);
        if (depth == 16 && std::endian::native == std::endian::little)
            png_set_swap(png_);
    }

    /// Writes the colour chunks; Transfer::data has none.
    void write_transfer(Transfer transfer) {
        if (transfer == Transfer::srgb)
            png_set_sRGB_gAMA_and_cHRM(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
        if (transfer == Transfer::linear) {
            png_set_gAMA_fixed(png_, info_, PNG_FP_1);
            png_set_cHRM_fixed(png_, info_, 31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000);
        }
    }

    size_t row_bytes_;
    std::string error_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

class Reader {
public:
    explicit Reader(std::span<const std::byte> file)
        : rest_(file),
          png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &error_, keep_error, drop_warning)) {
        if (png_)
            info_ = png_create_info_struct(png_);
    }
    ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    DecodeResult decode() {
        if (!info_)
            return tl::unexpected<std::string>("out of memory");
        if (!guarded(png_, [&] { read_header(); }))
            return tl::unexpected(error_);
        const Extent extent{int(png_get_image_width(png_, info_)), int(png_get_image_height(png_, info_))};
        const int channels = png_get_channels(png_, info_);
        const bool wide = png_get_bit_depth(png_, info_) == 16;
        const size_t row = png_get_rowbytes(png_, info_);
        if (const size_t total = row * size_t(extent.height) * (wide ? 2 : 1); total > k_largest_picture)
            return tl::unexpected("it takes " + std::to_string(total >> 20) + " MiB; the limit is " +
                                  std::to_string(k_largest_picture >> 20));
        std::vector<png_byte> samples(row * size_t(extent.height));
        std::vector<png_bytep> rows;
        for (int y = extent.height; y-- > 0;)
            rows.push_back(samples.data() + size_t(y) * row);
        if (!guarded(png_, [&] { png_read_image(png_, rows.data()), png_read_end(png_, nullptr); }))
            return tl::unexpected(error_);
        Image image(extent, channels, wide ? SampleType::f32 : SampleType::u8);
        if (wide)
            widen(samples, image);
        else
            std::memcpy(image.bytes.data(), samples.data(), samples.size());
        return image;
    }

private:
    void read_header() {
        png_set_read_fn(png_, this, take);
        png_read_info(png_, info_);
        png_set_expand(png_);
        if (std::endian::native == std::endian::little)
            png_set_swap(png_);
        png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
    }

    static void take(png_structp png, png_bytep data, size_t size) {
        auto& rest = static_cast<Reader*>(png_get_io_ptr(png))->rest_;
        if (size > rest.size())
            png_error(png, "the file is damaged or cut short");
        std::memcpy(data, rest.data(), size);
        rest = rest.subspan(size);
    }

    static void widen(const std::vector<png_byte>& samples, Image& image) {
        const std::span<float> wide = image.f32();
        for (size_t i = 0; i < wide.size(); ++i) {
            uint16_t sample = 0;
            std::memcpy(&sample, samples.data() + 2 * i, sizeof sample);
            wide[i] = float(sample) / 65535.0f;
        }
    }

    std::string error_;
    std::span<const std::byte> rest_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

} // namespace

EncodeResult encode_png(const EncodeJob& job) {
    std::vector<unsigned char> bytes;
    Writer writer(job, append, &bytes);
    return writer.begin(job)
        .and_then([&] { return writer.add(job.samples, job.extent.height); })
        .and_then([&] { return writer.finish(); })
        .map([&] { return std::move(bytes); });
}

RowEncoderResult encode_png_rows(const EncodeJob& job, std::FILE* file) {
    auto writer = std::make_unique<Writer>(job, put, file);
    return writer->begin(job).map([&]() -> std::unique_ptr<RowEncoder> { return std::move(writer); });
}

DecodeResult decode_png(std::span<const std::byte> file) {
    return Reader(file).decode();
}

} // namespace tidemark::image
