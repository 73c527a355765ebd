#include "image/files/icc_profile.hpp"

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

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

} // namespace tidemark::image
