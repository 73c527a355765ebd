#include "image/made/void_and_cluster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace tidemark::image {
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

} // namespace tidemark::image
