#include "image/files/file_check.hpp"

#include "image/byte_order.hpp"
#include "image/files/png_chunks.hpp"
#include "image/files/tiff_check.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace tidemark::image {
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
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    return extension == ".tga";
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
        return "it has a PNG chunk of a kind that is not known";
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

} // namespace tidemark::image
