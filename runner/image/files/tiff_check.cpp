#include "image/files/tiff_check.hpp"

#include "image/byte_order.hpp"

#include <array>
#include <cstdint>

namespace tidemark::image {
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

std::optional<std::string> tiff_objection(std::string_view file) {
    if (TiffWalk(file).is_whole())
        return {};
    return "the file is damaged or cut short";
}

} // namespace tidemark::image
