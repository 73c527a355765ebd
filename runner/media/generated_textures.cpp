// Blue noise of one channel: a mask in which similar values keep their distance.

#include "media/generated_textures.hpp"

#include "base/encoding.hpp"
#include "media/texture_files.hpp"
#include "media/video_input.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace tidemark::image {

/// The side of the mask.
inline constexpr int k_blue_side = 128;

namespace {

constexpr int k_side = k_blue_side;
constexpr int k_texels = k_side * k_side;
constexpr int k_reach = 7; ///< of the Gaussian; it is below 2^-15 beyond
constexpr int k_width = 2 * k_reach + 1;
constexpr int k_block = 16; ///< texels in a row that share a stored minimum of the energy
constexpr int k_row_blocks = k_side / k_block;
constexpr int32_t k_taken = std::numeric_limits<int32_t>::max();

using Energies = std::array<int32_t, size_t{k_width} * k_width>;

Energies gaussian() {
    constexpr double variance = 1.5 * 1.5;
    Energies kernel;
    for (int y = 0; y < k_width; ++y)
        for (int x = 0; x < k_width; ++x) {
            const double square = (x - k_reach) * (x - k_reach) + (y - k_reach) * (y - k_reach);
            kernel[size_t(y * k_width + x)] =
                int32_t(std::lround(std::exp(-0.5 * square / variance) * (1 << 20)));
        }
    return kernel;
}

static_assert(k_width <= k_block + 1);

/// Points on a torus and the energy (crowding) of each texel. Keeps the least energy of every block of texels
/// without a point up to date, so that the largest void is found fast.
class Pattern {
public:
    /// Adds a little noise to decide between texels of equal energy; otherwise they would be taken row by
    /// row.
    Pattern(std::mt19937& random, const Energies& kernel) : kernel_(&kernel) {
        for (int32_t& energy : energy_)
            energy = int32_t(random() & 15u);
        free_ = energy_;
        for (int block = 0; block < int(least_.size()); ++block)
            refresh(block);
    }

    bool has_point(int texel) const { return free_[size_t(texel)] == k_taken; }

    void add(int texel) {
        points_.push_back(texel);
        free_[size_t(texel)] = k_taken;
        spread(texel, 1);
    }

    void remove(int texel) {
        points_.erase(std::find(points_.begin(), points_.end(), texel));
        free_[size_t(texel)] = 0; // anything but k_taken; `spread` sets it
        spread(texel, -1);
    }

    int largest_void() const {
        const auto block = std::min_element(least_.begin(), least_.end()) - least_.begin();
        const auto first = free_.begin() + block * k_block;
        return int(std::min_element(first, first + k_block) - free_.begin());
    }

    int tightest_cluster() const {
        return *std::max_element(points_.begin(), points_.end(), [&](int left, int right) {
            return energy_[size_t(left)] < energy_[size_t(right)];
        });
    }

private:
    void spread(int texel, int32_t sign) {
        const int first = (texel % k_side - k_reach + k_side) % k_side;
        const int before_edge = std::min(k_width, k_side - first);
        for (int j = 0; j < k_width; ++j) {
            const int row = (texel / k_side + j - k_reach + k_side) % k_side;
            const int32_t* kernel = &(*kernel_)[size_t(j * k_width)];
            spread_row(row * k_side + first, before_edge, kernel, sign);
            spread_row(row * k_side, k_width - before_edge, kernel + before_edge, sign);
            const int block = first / k_block; // k_width texels touch this one and the next
            refresh(row * k_row_blocks + block);
            refresh(row * k_row_blocks + (block + 1) % k_row_blocks);
        }
    }

    void spread_row(int first, int count, const int32_t* kernel, int32_t sign) {
        int32_t* energy = energy_.data() + first;
        int32_t* free = free_.data() + first;
        for (int i = 0; i < count; ++i) {
            energy[i] += sign * kernel[i];
            free[i] = free[i] == k_taken ? k_taken : energy[i];
        }
    }

    void refresh(int block) {
        const int32_t* first = free_.data() + block * k_block;
        int32_t least = first[0];
        for (int i = 1; i < k_block; ++i)
            least = std::min(least, first[i]);
        least_[size_t(block)] = least;
    }

    const Energies* kernel_;
    std::vector<int> points_;
    std::array<int32_t, k_texels> energy_;
    std::array<int32_t, k_texels> free_; ///< the energy where there is no point, else k_taken
    std::array<int32_t, k_texels / k_block> least_;
};

/// Places a tenth of the texels and moves them from clusters into voids until a move would be undone.
Pattern initial_pattern(std::mt19937& random, const Energies& kernel) {
    Pattern pattern(random, kernel);
    for (int points = 0; points < k_texels / 10;) {
        const int texel = int(random() % k_texels);
        if (pattern.has_point(texel))
            continue;
        pattern.add(texel);
        ++points;
    }
    for (int moves = 0; moves < k_texels; ++moves) {
        const int crowded = pattern.tightest_cluster();
        pattern.remove(crowded);
        const int empty = pattern.largest_void();
        pattern.add(empty);
        if (empty == crowded)
            break;
    }
    return pattern;
}

} // namespace

/// Returns a mask of k_blue_side² bytes, row by row, that tiles; each value 0..255 occurs 64 times. Void and
/// cluster (R. Ulichney, "The void-and-cluster method for dither array generation", 1993) with a Gaussian of
/// deviation 1.5 texels. The energies are integers, so the bytes are the same on every machine.
std::vector<uint8_t> make_blue_mask(std::mt19937& random) {
    const Energies kernel = gaussian();
    const Pattern initial = initial_pattern(random, kernel);
    std::vector<uint8_t> mask(k_texels);
    const auto put = [&](int texel, int rank) { mask[size_t(texel)] = uint8_t(rank * 256 / k_texels); };
    Pattern pattern = initial;
    for (int rank = k_texels / 10; rank-- > 0;) {
        const int texel = pattern.tightest_cluster();
        pattern.remove(texel);
        put(texel, rank);
    }
    pattern = initial;
    // Up to the last texel: the tightest cluster of voids is where the points are fewest.
    for (int rank = k_texels / 10; rank < k_texels; ++rank) {
        const int texel = pattern.largest_void();
        pattern.add(texel);
        put(texel, rank);
    }
    return mask;
}

namespace {

constexpr int k_shift_x = 37;
constexpr int k_shift_y = 17;

/// Separate random streams, so that grey noise differs from the green of the RGBA noise.
enum class Stream : uint32_t { grey_256 = 1, grey_64, rgba_64, blue, volume };

std::mt19937 random_of(Stream stream, uint32_t seed) {
    std::seed_seq seeds{seed, uint32_t(stream)};
    return std::mt19937(seeds);
}

constexpr size_t k_noise_texels = size_t{k_noise_side} * size_t{k_noise_side};

size_t texel(int x, int y) {
    return size_t(y % k_noise_side) * size_t{k_noise_side} + size_t(x % k_noise_side);
}

/// Returns uniform bytes from the engine's raw output, which the standard fixes, unlike that of
/// std::uniform_int_distribution.
std::vector<uint8_t> uniform_bytes(std::mt19937& random, size_t count) {
    assert(count % 4 == 0);
    std::vector<uint8_t> bytes(count);
    for (size_t i = 0; i < count; i += 4) {
        const auto word = uint32_t(random());
        for (size_t byte = 0; byte < 4; ++byte)
            bytes[i + byte] = uint8_t(word >> (8 * byte));
    }
    return bytes;
}

/// Draws a picture by `sample(x, y, channel)`, with y from the top, as in a file.
template <class Sample>
Image draw(int side, int channels, const Sample& sample) {
    Image image({side, side}, channels, SampleType::u8);
    size_t next = 0;
    for (int y = side; y-- > 0;)
        for (int x = 0; x < side; ++x)
            for (int channel = 0; channel < channels; ++channel)
                image.u8()[next++] = sample(x, y, channel);
    return image;
}

Image make_grey(int side, std::mt19937 random) {
    const std::vector<uint8_t> bytes = uniform_bytes(random, size_t(side) * size_t(side));
    return draw(side, 1, [&](int x, int y, int) { return bytes[size_t(y * side + x)]; });
}

Image make_small_rgba(uint32_t seed) {
    constexpr size_t side = 64, texels = side * side;
    std::mt19937 random = random_of(Stream::rgba_64, seed);
    const std::vector<uint8_t> planes = uniform_bytes(random, 3 * texels);
    return draw(side, 4, [&](int x, int y, int channel) {
        const size_t here = size_t(y) * side + size_t(x);
        return channel < 3 ? planes[size_t(channel) * texels + here]
                           : planes[2 * texels + (here + 1) % texels];
    });
}

Image make_blue(uint32_t seed) {
    std::mt19937 random = random_of(Stream::blue, seed);
    std::array<std::vector<uint8_t>, 4> masks;
    for (std::vector<uint8_t>& mask : masks)
        mask = make_blue_mask(random);
    return draw(1024, 4, [&](int x, int y, int channel) {
        return masks[size_t(channel)][size_t(y % k_blue_side * k_blue_side + x % k_blue_side)];
    });
}

/// Returns a level of B. E. Bayer's pattern (1973): the order of a texel interleaves the bits of x xor y and
/// of y, the lowest first.
uint8_t bayer_level(int x, int y) {
    int order = 0;
    for (int bit = 0; bit < 3; ++bit) {
        order = 4 * order + 2 * (((x ^ y) >> bit) & 1) + ((y >> bit) & 1);
    }
    return uint8_t(4 * order + 2);
}

} // namespace

Image make_noise(uint32_t seed) {
    std::mt19937 random(seed);
    const std::vector<uint8_t> green = uniform_bytes(random, k_noise_texels);
    const std::vector<uint8_t> alpha = uniform_bytes(random, k_noise_texels);
    Image noise({k_noise_side, k_noise_side}, 4, SampleType::u8);
    for (int y = 0; y < k_noise_side; ++y) {
        for (int x = 0; x < k_noise_side; ++x) {
            const size_t here = texel(x, y);
            const size_t shifted = texel(x + k_shift_x, y + k_shift_y);
            uint8_t* pixel = &noise.u8()[4 * texel(x, k_noise_side - 1 - y)];
            pixel[0] = green[shifted];
            pixel[1] = green[here];
            pixel[2] = alpha[shifted];
            pixel[3] = alpha[here];
        }
    }
    return noise;
}

Image make_noise(NoiseTexture kind, uint32_t seed) {
    switch (kind) {
    case NoiseTexture::rgba_256: return make_noise(seed);
    case NoiseTexture::rgba_64: return make_small_rgba(seed);
    case NoiseTexture::grey_256: return make_grey(256, random_of(Stream::grey_256, seed));
    case NoiseTexture::grey_64: return make_grey(64, random_of(Stream::grey_64, seed));
    case NoiseTexture::blue_1024: return make_blue(seed);
    case NoiseTexture::bayer_8: return draw(8, 1, [](int x, int y, int) { return bayer_level(x, y); });
    }
    assert(false);
    return {};
}

VolumeData make_noise_volume(NoiseVolume kind, uint32_t seed) {
    constexpr int side = 32;
    VolumeData volume{side, side, side, kind == NoiseVolume::grey_32 ? 1 : 4, SampleType::u8};
    std::mt19937 random = random_of(Stream::volume, seed);
    for (const uint8_t byte : uniform_bytes(random, volume.samples()))
        volume.bytes.push_back(std::byte(byte));
    return volume;
}

namespace {

constexpr int k_octaves = 6;
constexpr int k_lattice = 4; ///< cells of the coarsest octave across the picture; a power of two

using Rgb = std::array<double, 3>;

Rgb mixed(const Rgb& a, const Rgb& b, double part) {
    return {a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), a[2] + part * (b[2] - a[2])};
}

/// Three colours from dark to light: stone, moss, sand, sea, rust, slate.
constexpr std::array<std::array<Rgb, 3>, 6> k_palettes = {{
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

    Rgb colour(double lightness) const {
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
void fill_texel(const Clouds& clouds, double lightness, int channels, uint8_t* to) {
    if (channels <= 2) {
        to[0] = byte_of(0.2 + 0.6 * lightness);
    } else {
        const Rgb colour = clouds.colour(lightness);
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
            fill_texel(clouds, clouds.at((x + 0.5) / size.width, (y + 0.5) / size.height, 0.0), channels,
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
                fill_texel(clouds, std::clamp(0.75 * light + 0.125 + 0.3 * scale * d.y, 0.0, 1.0), channels,
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
                fill_texel(clouds, clouds.at((x + 0.5) / width, (y + 0.5) / height, (z + 0.5) / depth),
                           channels, to);
    return volume;
}

} // namespace tidemark::image
