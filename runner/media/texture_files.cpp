#include "media/texture_files.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "media/file_samples.hpp"
#include "media/picture_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <numbers>
#include <span>
#include <type_traits>
#include <utility>

namespace tidemark::image {

Direction direction_of(const CubePlace& place) {
    const double sc = 2.0 * place.s - 1.0, tc = 2.0 * place.t - 1.0;
    switch (place.face) {
    case 0: return {1.0, -tc, -sc};
    case 1: return {-1.0, -tc, sc};
    case 2: return {sc, 1.0, tc};
    case 3: return {sc, -1.0, -tc};
    case 4: return {sc, -tc, 1.0};
    default: return {-sc, -tc, -1.0};
    }
}

CubePlace place_of(const Direction& direction) {
    const auto [x, y, z] = direction;
    const double ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
    const auto on = [](int face, double sc, double tc, double major) {
        return CubePlace{face, 0.5 * (sc / major + 1.0), 0.5 * (tc / major + 1.0)};
    };
    if (ax >= ay && ax >= az)
        return x > 0.0 ? on(0, -z, -y, ax) : on(1, z, -y, ax);
    if (ay >= az)
        return y > 0.0 ? on(2, x, z, ay) : on(3, x, -z, ay);
    return z > 0.0 ? on(4, x, -y, az) : on(5, -x, -y, az);
}

namespace {

constexpr int k_largest_resampled_side = 2048;

tl::unexpected<Error> cannot_use(const std::string& name, std::string_view why) {
    return fail(ErrorCode::load, fmt::format("cannot use '{}' as a cubemap: {}", name, why));
}

// --- Faces of one kind ---------------------------------------------------------------------------------

void make_alike(CubeFaces& faces) {
    bool colour = false, alpha = false, floats = false;
    for (const Image& face : faces) {
        colour |= face.channels >= 3;
        alpha |= face.has_alpha();
        floats |= face.type == SampleType::f32;
    }
    const int channels = (colour ? 3 : 1) + (alpha ? 1 : 0);
    for (Image& face : faces)
        face = with_channels(floats ? in_floats(std::move(face)) : face, channels);
}

// --- Several faces in a picture --------------------------------------------------------------------------

/// Position of a face in the picture, counted in faces from the left and from the top.
struct Cell {
    int column;
    int row;
    bool turned = false; ///< by 180 degrees
};

struct Layout {
    int columns;
    int rows;
    std::array<Cell, 6> cells;
};

const Layout* layout_of(Extent size) {
    static constexpr std::array<Layout, 4> layouts = {{
        {4, 3, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}}},
        {3, 4, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3, true}}}},
        {6, 1, {{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}}},
        {1, 6, {{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}}},
    }};
    for (const Layout& layout : layouts)
        if (size.width % layout.columns == 0 && size.height % layout.rows == 0 &&
            size.width / layout.columns == size.height / layout.rows)
            return &layout;
    return nullptr;
}

Image cut(const Image& picture, const Cell& cell, int side) {
    Image face({side, side}, picture.channels, picture.type);
    const size_t pixel = size_t(picture.channels) * size_of(picture.type);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const int from_left = cell.column * side + (cell.turned ? side - 1 - x : x);
            const int from_top = cell.row * side + (cell.turned ? side - 1 - y : y);
            const auto row = size_t(picture.extent.height - 1 - from_top);
            std::memcpy(&face.bytes[(size_t(y) * size_t(side) + size_t(x)) * pixel],
                        &picture.bytes[row * picture.row_bytes() + size_t(from_left) * pixel], pixel);
        }
    return face;
}

// --- Resampling ------------------------------------------------------------------------------------------

/// A texel of one of several pictures and its weight in a sample.
struct Tap {
    int picture = 0;
    size_t texel = 0;
    double weight = 0.0;
};

/// Returns the four texels around a point given in texels, whose centres are at halves. `tap(x, y)` returns
/// the texel at a column and row, which may be outside.
template <class TapAt>
std::array<Tap, 4> taps_around(double x, double y, const TapAt& tap) {
    const double left = std::floor(x - 0.5), below = std::floor(y - 0.5);
    const double across = x - 0.5 - left, up = y - 0.5 - below;
    std::array<Tap, 4> taps;
    for (int i = 0; i < 4; ++i) {
        const int dx = i & 1, dy = i >> 1;
        taps[size_t(i)] = tap(int(left) + dx, int(below) + dy);
        taps[size_t(i)].weight = (dx ? across : 1.0 - across) * (dy ? up : 1.0 - up);
    }
    return taps;
}

template <class Sample>
void blend(std::span<const Image> pictures, const std::array<Tap, 4>& taps, size_t channels, Sample* to) {
    std::array<double, 4> sums{};
    for (const Tap& tap : taps) {
        if (tap.weight == 0.0) // 0 times infinity would be NaN
            continue;
        const auto* from = reinterpret_cast<const Sample*>(pictures[size_t(tap.picture)].bytes.data());
        for (size_t channel = 0; channel < channels; ++channel)
            sums[channel] += tap.weight * double(from[tap.texel * channels + channel]);
    }
    constexpr double rounding = std::is_integral_v<Sample> ? 0.5 : 0.0;
    for (size_t channel = 0; channel < channels; ++channel)
        to[channel] = Sample(sums[channel] + rounding);
}

void blend(std::span<const Image> pictures, const std::array<Tap, 4>& taps, Image& to, size_t pixel) {
    const auto channels = size_t(to.channels);
    if (to.type == SampleType::u8)
        blend(pictures, taps, channels, &to.u8()[pixel * channels]);
    else
        blend(pictures, taps, channels, &to.f32()[pixel * channels]);
}

std::array<Tap, 4> panorama_taps(Extent size, const Direction& direction) {
    const auto [x, y, z] = direction;
    const double a = std::atan2(-x, z), b = std::atan2(y, std::hypot(x, z));
    const double u = a / (2.0 * std::numbers::pi), v = b / std::numbers::pi + 0.5;
    return taps_around(u * size.width, v * size.height, [&](int column, int row) {
        const int wrapped = ((column % size.width) + size.width) % size.width;
        const int clamped = std::clamp(row, 0, size.height - 1);
        return Tap{0, size_t(clamped) * size_t(size.width) + size_t(wrapped)};
    });
}

CubeFaces cube_of_panorama(const Image& panorama) {
    const int side = std::clamp(panorama.extent.width / 4, 1, k_largest_resampled_side);
    CubeFaces faces;
    for (int face = 0; face < 6; ++face) {
        Image& to = faces[size_t(face)] = Image({side, side}, panorama.channels, panorama.type);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const Direction direction = direction_of({face, (x + 0.5) / side, (y + 0.5) / side});
                blend({&panorama, 1}, panorama_taps(panorama.extent, direction), to,
                      size_t(y) * size_t(side) + size_t(x));
            }
    }
    return faces;
}

std::array<Tap, 4> cube_taps(int side, const Direction& direction) {
    const CubePlace place = place_of(direction);
    return taps_around(place.s * side, place.t * side, [&](int column, int row) {
        CubePlace at{place.face, (column + 0.5) / side, (row + 0.5) / side};
        if (column < 0 || column >= side || row < 0 || row >= side)
            at = place_of(direction_of(at)); // on the adjacent face
        const int x = std::clamp(int(at.s * side), 0, side - 1),
                  y = std::clamp(int(at.t * side), 0, side - 1);
        return Tap{at.face, size_t(y) * size_t(side) + size_t(x)};
    });
}

} // namespace

Result<CubeFaces> cube_of_faces(CubeFaces pictures, const std::array<std::string, 6>& names) {
    for (size_t i = 0; i < pictures.size(); ++i) {
        const Extent size = pictures[i].extent, first = pictures[0].extent;
        if (size.width != size.height || size.width < 1)
            return cannot_use(names[i],
                              fmt::format("it is {}x{} pixels; a face is square", size.width, size.height));
        if (size != first)
            return cannot_use(names[i],
                              fmt::format("it is {}x{} pixels and '{}' is {}x{}; faces are of one size",
                                          size.width, size.height, names[0], first.width, first.height));
    }
    make_alike(pictures);
    for (Image& picture : pictures)
        picture = flipped(picture);
    return pictures;
}

Result<CubeFaces> cube_of_picture(const Image& picture, const std::string& name) {
    const Extent size = picture.extent;
    if (size.width == 2 * size.height && size.height > 0)
        return cube_of_panorama(picture);
    const Layout* layout = size.pixels() > 0 ? layout_of(size) : nullptr;
    if (!layout)
        return cannot_use(name,
                          fmt::format("it is {}x{} pixels; one file is a cross (4:3 or 3:4), a row of faces "
                                      "(6:1 or 1:6) or a panorama (2:1)",
                                      size.width, size.height));
    CubeFaces faces;
    for (size_t face = 0; face < faces.size(); ++face)
        faces[face] = cut(picture, layout->cells[face], size.width / layout->columns);
    return faces;
}

Result<CubeFaces> read_cubemap(const std::vector<std::filesystem::path>& files) {
    if (files.size() == 1)
        return read_picture(files[0]).and_then(
            [&](const Image& picture) { return cube_of_picture(picture, files[0].string()); });
    if (files.size() != 6)
        return fail(ErrorCode::load,
                    fmt::format("a cubemap is made of six files or of one, not of {}{}", files.size(),
                                files.empty() ? "" : fmt::format(" ('{}', …)", files[0].string())));
    CubeFaces pictures;
    std::array<std::string, 6> names;
    for (size_t i = 0; i < files.size(); ++i) {
        Result<Image> picture = read_picture(files[i]);
        if (!picture)
            return fail(std::move(picture.error()));
        pictures[i] = std::move(*picture);
        names[i] = files[i].string();
    }
    return cube_of_faces(std::move(pictures), names);
}

CubeFaces vflipped(const CubeFaces& faces) {
    return {flipped(faces[0]), flipped(faces[1]), flipped(faces[3]),
            flipped(faces[2]), flipped(faces[4]), flipped(faces[5])};
}

Image equirectangular_of(const CubeFaces& faces, Extent size) {
    Image panorama(size, faces[0].channels, faces[0].type);
    const int side = faces[0].extent.width;
    std::vector<Direction> around; // directions on the equator
    for (int x = 0; x < size.width; ++x) {
        const double a = 2.0 * std::numbers::pi * (x + 0.5) / size.width;
        around.push_back({-std::sin(a), 0.0, std::cos(a)});
    }
    for (int y = 0; y < size.height; ++y) {
        const double b = std::numbers::pi * ((y + 0.5) / size.height - 0.5);
        const double up = std::sin(b), out = std::cos(b);
        for (int x = 0; x < size.width; ++x) {
            const Direction& level = around[size_t(x)];
            const Direction direction{out * level.x, up, out * level.z};
            blend(faces, cube_taps(side, direction), panorama, size_t(y) * size_t(size.width) + size_t(x));
        }
    }
    return panorama;
}

namespace {

using namespace std::string_view_literals;

constexpr std::string_view k_signature = "BIN\0"sv;
constexpr size_t k_header = 20;

/// Parses the header in `file` for a file of `file_size` bytes; returns a volume without its samples.
Result<VolumeData> described(std::string_view file, size_t file_size, const std::string& name) {
    const auto refuse = [&](std::string_view why) {
        return fail(ErrorCode::load, fmt::format("cannot read '{}': {}", name, why));
    };
    if (!file.starts_with(k_signature))
        return refuse("it is not a ShaderToy volume: it does not start with \"BIN\" and a zero byte");
    if (file.size() < k_header)
        return refuse("the file is cut short: a volume's header has 20 bytes");
    const uint32_t width = little_endian(file, 4, 4);
    const uint32_t height = little_endian(file, 8, 4);
    const uint32_t depth = little_endian(file, 12, 4);
    const uint32_t channels = little_endian(file, 16, 1);
    const uint32_t format = little_endian(file, 18, 2);
    if (width == 0 || height == 0 || depth == 0)
        return refuse(fmt::format("its size is {}x{}x{}: it has no texels", width, height, depth));
    constexpr uint32_t limit = k_largest_volume_side;
    if (width > limit || height > limit || depth > limit)
        return refuse(fmt::format("its size is {}x{}x{}; the limit is {} on a side", width, height, depth,
                                  k_largest_volume_side));
    if (channels < 1 || channels > 4)
        return refuse(fmt::format("it has {} channels; 1 to 4 are allowed", channels));
    if (format != 0 && format != 10)
        return refuse(
            fmt::format("its sample format is {}; known are 0 (bytes) and 10 (32-bit floats)", format));
    VolumeData volume{int(width), int(height), int(depth), int(channels),
                      format == 0 ? SampleType::u8 : SampleType::f32};
    const size_t wanted = volume.samples() * size_of(volume.type);
    if (wanted > k_largest_volume)
        return refuse(
            fmt::format("it has {} bytes of samples; the limit is {} MiB", wanted, k_largest_volume >> 20));
    if (file_size - k_header != wanted)
        return refuse(fmt::format("{}x{}x{} texels of {} channel{} need {} bytes of samples, but it has {}",
                                  width, height, depth, channels, channels == 1 ? "" : "s", wanted,
                                  file_size - k_header));
    return volume;
}

} // namespace

Result<VolumeData> volume_of(std::string_view file, const std::string& name) {
    VolumeData volume = TRY(described(file, file.size(), name));
    const auto samples = std::as_bytes(std::span(file.substr(k_header)));
    volume.bytes.assign(samples.begin(), samples.end());
    return volume;
}

/// Checks the header before it reads the whole file.
Result<VolumeData> read_volume(const std::filesystem::path& path) {
    std::error_code error;
    if (const auto size = std::filesystem::file_size(path, error);
        !error && std::filesystem::is_regular_file(path, error)) {
        std::array<char, k_header> head{};
        std::ifstream file(path, std::ios::binary);
        file.read(head.data(), head.size());
        TRY(described({head.data(), size_t(file.gcount())}, size, path.string()));
    }
    return read_file(path, k_largest_volume + k_header).and_then([&](const std::string& file) {
        return volume_of(file, path.string());
    });
}

} // namespace tidemark::image
