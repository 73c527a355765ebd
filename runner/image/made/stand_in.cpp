#include "image/made/stand_in.hpp"

#include "base/hash.hpp"
#include "image/cube_directions.hpp"
#include "image/files/camera.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <string>

namespace tidemark::image {
namespace {

constexpr int k_octaves = 6;
constexpr int k_lattice = 4; ///< cells of the coarsest octave across the picture; a power of two

using Colour = std::array<double, 3>;

Colour mixed(const Colour& a, const Colour& b, double part) {
    return {a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), a[2] + part * (b[2] - a[2])};
}

/// Three colours from dark to light: stone, moss, sand, sea, rust, slate.
constexpr std::array<std::array<Colour, 3>, 6> k_palettes = {{
    {{{0.24, 0.23, 0.22}, {0.48, 0.46, 0.43}, {0.74, 0.71, 0.66}}},
    {{{0.17, 0.22, 0.13}, {0.37, 0.44, 0.25}, {0.69, 0.71, 0.50}}},
    {{{0.36, 0.27, 0.18}, {0.62, 0.50, 0.35}, {0.83, 0.74, 0.58}}},
    {{{0.12, 0.24, 0.32}, {0.26, 0.46, 0.54}, {0.66, 0.77, 0.76}}},
    {{{0.25, 0.15, 0.11}, {0.51, 0.32, 0.21}, {0.76, 0.61, 0.46}}},
    {{{0.19, 0.22, 0.27}, {0.40, 0.44, 0.50}, {0.70, 0.73, 0.76}}},
}};

uint32_t seed_of(std::string_view name) {
    uint32_t seed = 0;
    const std::string digits = sha256(std::as_bytes(std::span(name)));
    std::from_chars(digits.data(), digits.data() + 8, seed, 16);
    return seed;
}

/// Value noise of several octaves in a cube of side 1 that repeats in every direction. Uses only sums and
/// products, so that the bytes do not depend on a mathematics library.
class Clouds {
public:
    explicit Clouds(uint32_t seed) {
        std::mt19937 random(seed);
        palette_ = random() % k_palettes.size();
        for (float& value : values_)
            value = float(random() >> 8) / float(1 << 24);
    }

    /// Returns 0..1, about 1/2 on average. The coordinates must not be negative.
    double at(double x, double y, double z) const {
        double sum = 0.0, weight = 0.5, total = 0.0;
        for (int octave = 0, cells = k_lattice; octave < k_octaves; ++octave, cells *= 2) {
            sum += weight * octave_at(x * cells, y * cells, z * cells, cells, octave);
            total += weight;
            weight *= 0.6;
        }
        return std::clamp(0.5 + 1.4 * (sum / total - 0.5), 0.0, 1.0);
    }

    Colour colour(double lightness) const {
        const auto& palette = k_palettes[palette_];
        return lightness < 0.5 ? mixed(palette[0], palette[1], 2.0 * lightness)
                               : mixed(palette[1], palette[2], 2.0 * lightness - 1.0);
    }

private:
    static constexpr size_t k_values = 1 << 12;

    /// Returns one of the random values, the same for corners that are a whole period apart.
    double corner(int x, int y, int z, int cells, int octave) const {
        const auto wrapped = [&](int i) { return uint32_t(i & (cells - 1)); };
        uint32_t index = wrapped(x) * 0x9e3779b1u + wrapped(y) * 0x85ebca77u + wrapped(z) * 0xc2b2ae3du;
        index = (index + uint32_t(octave)) * 0x27d4eb2fu;
        return double(values_[(index ^ index >> 15) % k_values]);
    }

    double octave_at(double x, double y, double z, int cells, int octave) const {
        const std::array<double, 3> place = {x, y, z};
        std::array<int, 3> cell;
        std::array<double, 3> part;
        for (size_t i = 0; i < 3; ++i) {
            cell[i] = int(place[i]);
            const double f = place[i] - cell[i];
            part[i] = f * f * f * (f * (6.0 * f - 15.0) + 10.0);
        }
        double sum = 0.0;
        for (int i = 0; i < 8; ++i) {
            const int dx = i & 1, dy = i >> 1 & 1, dz = i >> 2;
            const double weight = (dx ? part[0] : 1.0 - part[0]) * (dy ? part[1] : 1.0 - part[1]) *
                                  (dz ? part[2] : 1.0 - part[2]);
            if (weight > 0.0) // in a picture z is 0, so half of the corners have no weight
                sum += weight * corner(cell[0] + dx, cell[1] + dy, cell[2] + dz, cells, octave);
        }
        return sum;
    }

    size_t palette_ = 0;
    std::array<float, k_values> values_;
};

uint8_t byte_of(double value) {
    return uint8_t(std::clamp(value, 0.0, 1.0) * 255.0 + 0.5);
}

/// Writes one pixel of 1 to 4 channels; with fewer than 3, the lightness alone.
void put(const Clouds& clouds, double lightness, int channels, uint8_t* to) {
    if (channels <= 2) {
        to[0] = byte_of(0.2 + 0.6 * lightness);
    } else {
        const Colour colour = clouds.colour(lightness);
        for (size_t i = 0; i < 3; ++i)
            to[i] = byte_of(colour[i]);
    }
    if (channels % 2 == 0)
        to[channels - 1] = 255;
}

} // namespace

Image make_stand_in_picture(std::string_view name, Extent size, int channels) {
    assert(channels >= 1 && channels <= 4);
    const Clouds clouds(seed_of(name));
    Image image(size, channels, SampleType::u8);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const size_t pixel = size_t(y) * size_t(size.width) + size_t(x);
            put(clouds, clouds.at((x + 0.5) / size.width, (y + 0.5) / size.height, 0.0), channels,
                &image.u8()[pixel * size_t(channels)]);
        }
    return image;
}

Image make_stand_in_camera() {
    return make_stand_in_picture("640x480x4", k_camera_extent, 4);
}

CubeFaces make_stand_in_cube(std::string_view name, int side, int channels) {
    assert(channels >= 1 && channels <= 4);
    const Clouds clouds(seed_of(name));
    CubeFaces faces;
    for (int face = 0; face < 6; ++face) {
        Image& image = faces[size_t(face)] = Image({side, side}, channels, SampleType::u8);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const Direction d = direction_of({face, (x + 0.5) / side, (y + 0.5) / side});
                const double scale = 0.4 / std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
                const double light = clouds.at(0.5 + scale * d.x, 0.5 + scale * d.y, 0.5 + scale * d.z);
                // The sky is lighter than the ground, so that "up" is visible.
                put(clouds, std::clamp(0.75 * light + 0.125 + 0.3 * scale * d.y, 0.0, 1.0), channels,
                    &image.u8()[(size_t(y) * size_t(side) + size_t(x)) * size_t(channels)]);
            }
    }
    return faces;
}

VolumeData make_stand_in_volume(std::string_view name, int width, int height, int depth, int channels) {
    assert(channels >= 1 && channels <= 4);
    const Clouds clouds(seed_of(name));
    VolumeData volume{width, height, depth, channels, SampleType::u8};
    volume.bytes.resize(volume.samples());
    auto* to = reinterpret_cast<uint8_t*>(volume.bytes.data());
    for (int z = 0; z < depth; ++z)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x, to += channels)
                put(clouds, clouds.at((x + 0.5) / width, (y + 0.5) / height, (z + 0.5) / depth), channels,
                    to);
    return volume;
}

} // namespace tidemark::image
