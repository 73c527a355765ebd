// Splits a PNG file into its chunks. Neither interprets them nor verifies their checksums.

#include "media/picture_check.hpp"

#include "base/encoding.hpp"
#include "base/file.hpp"
#include "media/picture_codecs.hpp"
#include "media/picture_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tidemark::image {

inline constexpr size_t k_png_signature = 8;
inline constexpr size_t k_png_chunk_frame = 12; ///< bytes of a chunk's length, name and checksum

struct PngChunk {
    std::string_view whole; ///< from its length to its checksum, inclusive

    std::string_view name() const { return whole.substr(4, 4); }
    std::string_view data() const { return whole.substr(8, whole.size() - k_png_chunk_frame); }
    /// Returns the bytes that the checksum covers.
    std::string_view checked() const { return whole.substr(4, whole.size() - 8); }
    uint32_t checksum() const { return big_endian(whole, whole.size() - 4, 4); }
};

/// Takes the next chunk from the rest after the signature; returns nothing if it is incomplete.
inline std::optional<PngChunk> take_png_chunk(std::string_view& rest) {
    if (rest.size() < k_png_chunk_frame)
        return std::nullopt;
    const size_t length = big_endian(rest, 0, 4);
    if (length > rest.size() - k_png_chunk_frame)
        return std::nullopt;
    const PngChunk chunk{rest.substr(0, length + k_png_chunk_frame)};
    rest.remove_prefix(chunk.whole.size());
    return chunk;
}

// Checks that a TIFF contains all its directories and the data of its first picture, because libtiff silently
// fills missing pixels with black. Handles classic TIFF and BigTIFF in either byte order. Does not decode.

namespace {

/// Location of a tag's values.
struct Values {
    uint64_t at = 0;
    uint64_t count = 0;
    size_t bytes = 0; ///< per value
};

enum Tag : uint64_t { strip_offsets = 273, strip_sizes = 279, tile_offsets = 324, tile_sizes = 325 };

/// Bytes per value of each type (TIFF 6.0 and BigTIFF); 0: undefined type.
constexpr std::array<size_t, 19> k_type_bytes = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};

class TiffWalk {
public:
    explicit TiffWalk(std::string_view file) : file_(file), from_back_(file[0] == 'M') {
        big_ = number(2, 2) == 43;
    }

    /// Returns whether all directories and the data of the first picture, which must have some, lie within
    /// the file.
    bool is_whole() {
        uint64_t directory = big_ ? number(8, 8) : number(4, 4);
        if (!read_directory(directory))
            return false;
        constexpr int most = 1000; // pictures; their links may form a cycle
        for (int i = 0; i < most && directory != 0; ++i) {
            if (!has(directory, count_bytes()) || !has(directory, directory_bytes(directory)))
                return false;
            directory = number(directory + directory_bytes(directory) - offset_bytes(), offset_bytes());
        }
        return true;
    }

private:
    bool has(uint64_t at, uint64_t bytes) const { return at <= file_.size() && bytes <= file_.size() - at; }

    /// Reads an integer; 0 past the end of the file.
    uint64_t number(uint64_t at, size_t bytes) const {
        if (!has(at, bytes))
            return 0;
        const auto word = [&](uint64_t from, size_t size) -> uint64_t {
            return from_back_ ? big_endian(file_, from, size) : little_endian(file_, from, size);
        };
        if (bytes <= 4)
            return word(at, bytes);
        return from_back_ ? word(at, 4) << 32 | word(at + 4, 4) : word(at + 4, 4) << 32 | word(at, 4);
    }

    size_t offset_bytes() const { return big_ ? 8 : 4; }
    size_t count_bytes() const { return big_ ? 8 : 2; }
    size_t entry_bytes() const { return big_ ? 20 : 12; }
    /// Returns the size of a directory, with the entry count before its entries and the offset of the next
    /// directory after them.
    uint64_t directory_bytes(uint64_t at) const {
        const uint64_t entries = number(at, count_bytes());
        if (entries > file_.size()) // avoids overflow below
            return UINT64_MAX;
        return count_bytes() + entries * entry_bytes() + offset_bytes();
    }

    bool read_directory(uint64_t at) {
        if (at == 0 || !has(at, count_bytes()) || !has(at, directory_bytes(at)))
            return false;
        const uint64_t entries = number(at, count_bytes());
        for (uint64_t i = 0; i < entries; ++i)
            if (!read_entry(at + count_bytes() + i * entry_bytes()))
                return false;
        const bool strips = has_all(strip_offsets_, strip_sizes_);
        const bool tiles = has_all(tile_offsets_, tile_sizes_);
        return strips && tiles && strip_offsets_.count + tile_offsets_.count > 0;
    }

    bool read_entry(uint64_t at) {
        const uint64_t type = number(at + 2, 2);
        Values values{at + 4 + offset_bytes(), number(at + 4, offset_bytes()),
                      type < k_type_bytes.size() ? k_type_bytes[type] : 0};
        if (values.bytes == 0) // libtiff skips unknown types, too
            return true;
        if (values.count > file_.size())
            return false;
        if (values.count * values.bytes > offset_bytes())
            values.at = number(values.at, offset_bytes());
        if (!has(values.at, values.count * values.bytes))
            return false;
        if (Values* wanted = values_of(number(at, 2)); wanted && wanted->count == 0)
            *wanted = values;
        return true;
    }

    Values* values_of(uint64_t tag) {
        switch (tag) {
        case strip_offsets: return &strip_offsets_;
        case strip_sizes: return &strip_sizes_;
        case tile_offsets: return &tile_offsets_;
        case tile_sizes: return &tile_sizes_;
        default: return nullptr;
        }
    }

    /// Checks that all strips or tiles lie within the file. Their sizes may be missing in uncompressed files.
    bool has_all(const Values& offsets, const Values& sizes) const {
        for (uint64_t i = 0; i < offsets.count; ++i) {
            const uint64_t size = i < sizes.count ? number(sizes.at + i * sizes.bytes, sizes.bytes) : 1;
            if (!has(number(offsets.at + i * offsets.bytes, offsets.bytes), size))
                return false;
        }
        return true;
    }

    std::string_view file_;
    bool from_back_; ///< big-endian
    bool big_ = false;
    Values strip_offsets_, strip_sizes_, tile_offsets_, tile_sizes_;
};

} // namespace

/// Returns the error, or nothing.
std::optional<std::string> tiff_objection(std::string_view file) {
    if (TiffWalk(file).is_whole())
        return {};
    return "the file is damaged or cut short";
}

namespace {

using Checked = tl::expected<std::string, std::string>;
using Objection = std::optional<std::string>;

tl::unexpected<std::string> refuse(std::string why) {
    return tl::unexpected<std::string>(std::move(why));
}

constexpr std::string_view k_cut_short = "the file is damaged or cut short";

uint8_t byte_at(std::string_view file, size_t at) {
    return uint8_t(file[at]);
}

/// Computes the CRC of the PNG specification, annex D.
uint32_t checksum(std::string_view bytes) {
    return uint32_t(crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), uInt(bytes.size())));
}

struct Signature {
    FileFormat format;
    std::string_view bytes;
};

bool is_webp(std::string_view file) {
    return file.starts_with("RIFF") && file.size() >= 12 && file.substr(8, 4) == "WEBP";
}

/// Recognises "P1" to "P6" and the float formats "Pf", "PF", followed by white space.
bool is_pnm(std::string_view file) {
    return file.size() > 2 && file[0] == 'P' && std::string_view("123456fF").find(file[1]) != file.npos &&
           std::string_view(" \t\r\n").find(file[2]) != file.npos;
}

bool has_tga_name(const std::filesystem::path& path) {
    return lower_case(path.extension().string()) == ".tga";
}

// --- PNG -------------------------------------------------------------------------------------------

/// Returns whether the pair of colour type and depth exists (PNG specification, table 11.1).
bool is_png_kind(uint8_t colour, uint8_t depth) {
    const bool small = depth == 1 || depth == 2 || depth == 4;
    switch (colour) {
    case 0: return small || depth == 8 || depth == 16;
    case 3: return small || depth == 8;
    case 2:
    case 4:
    case 6: return depth == 8 || depth == 16;
    default: return false;
    }
}

Objection png_header_objection(std::string_view data) {
    if (data.size() != 13)
        return std::string(k_cut_short);
    if (Objection size = size_objection(big_endian(data, 0, 4), big_endian(data, 4, 4)))
        return size;
    const bool sound = is_png_kind(byte_at(data, 9), byte_at(data, 8)) && data[10] == 0 && data[11] == 0 &&
                       byte_at(data, 12) <= 1;
    return sound ? Objection() : Objection("its PNG header is not valid");
}

bool makes_samples(std::string_view chunk) {
    return chunk == "IHDR" || chunk == "PLTE" || chunk == "tRNS" || chunk == "IDAT" || chunk == "IEND";
}

/// Returns whether a chunk is ancillary: its name begins with a small letter.
bool may_be_left_out(std::string_view chunk) {
    return (byte_at(chunk, 0) & 0x20u) != 0;
}

/// Checks one chunk: its checksum, its position, and that it is not repeated.
Objection chunk_objection(const PngChunk& chunk, bool is_first, int palettes) {
    if (checksum(chunk.checked()) != chunk.checksum())
        return "the file is damaged: a checksum in it is wrong";
    if ((chunk.name() == "IHDR") != is_first)
        return "its PNG header is not valid";
    if (is_first)
        return png_header_objection(chunk.data());
    if (chunk.name() == "PLTE" && palettes > 1)
        return "it has more than one palette";
    if (!makes_samples(chunk.name()) && !may_be_left_out(chunk.name()))
        return "it has an unknown kind of PNG chunk";
    return {};
}

Checked checked_png(std::string_view file) {
    std::string kept(file.substr(0, k_png_signature));
    std::string_view rest = file.substr(kept.size());
    bool has_data = false;
    int palettes = 0;
    for (bool is_first = true; const auto chunk = take_png_chunk(rest); is_first = false) {
        const std::string_view name = chunk->name();
        has_data |= name == "IDAT";
        palettes += name == "PLTE";
        if (Objection objection = chunk_objection(*chunk, is_first, palettes))
            return refuse(std::move(*objection));
        if (makes_samples(name))
            kept += chunk->whole;
        if (name == "IEND")
            return has_data ? Checked(std::move(kept)) : refuse("it has no pixels");
    }
    return refuse(std::string(k_cut_short));
}

// --- JPEG ------------------------------------------------------------------------------------------

bool is_frame_header(uint8_t marker) {
    return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

/// Returns whether the marker has no segment: padding, restarts, and an escaped 0xff in the data.
bool is_bare_marker(uint8_t marker) {
    return marker == 0x00 || marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8);
}

/// Checks a JPEG from marker to marker, through the compressed data, up to the end-of-image marker.
Objection jpeg_objection(std::string_view file) {
    size_t at = 2;
    while ((at = file.find('\xff', at)) != file.npos && at + 1 < file.size()) {
        const uint8_t marker = byte_at(file, at + 1);
        if (marker == 0xff) {
            ++at;
            continue;
        }
        if (marker == 0xd9)
            return {};
        if (is_bare_marker(marker)) {
            at += 2;
            continue;
        }
        if (at + 9 > file.size())
            break;
        if (is_frame_header(marker))
            if (Objection size = size_objection(big_endian(file, at + 7, 2), big_endian(file, at + 5, 2)))
                return size;
        at += 2 + big_endian(file, at + 2, 2);
    }
    return std::string(k_cut_short);
}

// --- OpenEXR ---------------------------------------------------------------------------------------

/// Returns the text up to the next zero byte and moves `at` past that byte; nothing when there is none.
std::optional<std::string_view> zero_terminated(std::string_view file, size_t& at) {
    const size_t end = file.find('\0', at);
    if (end == file.npos)
        return {};
    const std::string_view text = file.substr(at, end - at);
    at = end + 1;
    return text;
}

Objection window_objection(std::string_view box) {
    if (box.size() != 16)
        return std::string(k_cut_short);
    const auto corner = [&](size_t at) { return int64_t(int32_t(little_endian(box, at, 4))); };
    return size_objection(corner(8) - corner(0) + 1, corner(12) - corner(4) + 1);
}

/// Checks the attributes of the first part: name, type, size, value; an empty name ends them.
Objection exr_objection(std::string_view file) {
    size_t at = 8;
    bool has_window = false;
    while (at < file.size()) {
        const auto name = zero_terminated(file, at);
        if (name && name->empty())
            return has_window ? Objection() : Objection("it has no pixels");
        const auto type = name ? zero_terminated(file, at) : std::nullopt;
        if (!type || file.size() - at < 4)
            break;
        const size_t size = little_endian(file, at, 4);
        at += 4;
        if (size > file.size() - at)
            break;
        if (*name == "dataWindow") {
            has_window = true;
            if (Objection objection = window_objection(file.substr(at, size)))
                return objection;
        }
        at += size;
    }
    return std::string(k_cut_short);
}

} // namespace

std::optional<std::string> size_objection(int64_t width, int64_t height) {
    if (width < 1 || height < 1)
        return "it has no pixels";
    if (width > k_largest_side || height > k_largest_side)
        return fmt::format("it is {}x{} pixels; the limit is {} on a side", width, height, k_largest_side);
    return {};
}

std::optional<FileFormat> format_of(std::string_view file, const std::filesystem::path& path) {
    using namespace std::string_view_literals;
    static constexpr std::array<Signature, 10> signatures = {{
        {FileFormat::png, "\x89PNG\r\n\x1a\n"sv},
        {FileFormat::jpeg, "\xff\xd8\xff"sv},
        {FileFormat::tiff, "II*\0"sv},
        {FileFormat::tiff, "MM\0*"sv},
        {FileFormat::tiff, "II+\0"sv}, // BigTIFF
        {FileFormat::tiff, "MM\0+"sv},
        {FileFormat::exr, "v/1\x01"sv},
        {FileFormat::hdr, "#?RADIANCE"sv},
        {FileFormat::hdr, "#?RGBE"sv},
        {FileFormat::bmp, "BM"sv},
    }};
    for (const Signature& signature : signatures)
        if (file.starts_with(signature.bytes))
            return signature.format;
    if (is_webp(file))
        return FileFormat::webp;
    if (is_pnm(file))
        return FileFormat::pnm;
    if (has_tga_name(path))
        return FileFormat::tga;
    return {};
}

Checked checked_file(FileFormat format, std::string file) {
    if (format == FileFormat::png)
        return checked_png(file);
    Objection objection;
    if (format == FileFormat::jpeg)
        objection = jpeg_objection(file);
    if (format == FileFormat::exr)
        objection = exr_objection(file);
    if (format == FileFormat::tiff)
        objection = tiff_objection(file);
    if (objection)
        return refuse(std::move(*objection));
    return file;
}

namespace {

constexpr std::string_view k_prefix = "tidemark:";

/// Returns the uncompressed text chunks, which include all of ours.
Metadata texts_of_png(std::string_view file) {
    Metadata texts;
    std::string_view rest = file.substr(k_png_signature);
    while (const auto chunk = take_png_chunk(rest)) {
        const std::string_view data = chunk->data();
        const size_t end = data.find('\0');
        if (chunk->name() == "tEXt" && end != data.npos)
            texts.emplace_back(data.substr(0, end), data.substr(end + 1));
    }
    return texts;
}

void add(Metadata& ours, std::string_view name, std::string_view value) {
    if (name.starts_with(k_prefix))
        ours.emplace_back(name.substr(k_prefix.size()), value);
}

/// Adds lines of the form `tidemark:NAME=VALUE`.
void add_lines(Metadata& ours, std::string_view text) {
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        if (const size_t equals = line.find('='); equals != line.npos)
            add(ours, line.substr(0, equals), line.substr(equals + 1));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
    }
}

/// Finds our names and values, which are separate texts or lines of a description.
Metadata ours_of(const Metadata& texts) {
    Metadata ours;
    for (const auto& [name, value] : texts) {
        add(ours, name, value);
        if (name == "ImageDescription")
            add_lines(ours, value);
    }
    return ours;
}

} // namespace

tl::expected<Metadata, std::string> read_metadata(const std::filesystem::path& path) {
    const auto refuse = [](std::string why) { return tl::unexpected(std::move(why)); };
    const auto file = read_file(path, k_largest_picture);
    if (!file)
        return refuse(file.error().message);
    const std::optional<FileFormat> format = format_of(*file, path);
    if (!format)
        return refuse(file->empty() ? "the file is empty" : "it is not a picture");
    if (const auto checked = checked_file(*format, *file); !checked)
        return refuse(checked.error());
    if (*format == FileFormat::png)
        return ours_of(texts_of_png(*file));
    const auto& codec = picture_codec();
    if (!codec)
        return refuse(codec.error().message);
    return (*codec)->texts(*format, std::as_bytes(std::span(*file))).map(ours_of);
}

const std::string* find(const Metadata& metadata, std::string_view name) {
    const auto found = std::ranges::find(metadata, name, &Metadata::value_type::first);
    return found == metadata.end() ? nullptr : &found->second;
}

} // namespace tidemark::image
