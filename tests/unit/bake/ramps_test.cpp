#include "bake/ramps.hpp"
#include "base/encoding.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace tidemark::bake {

using image::Image;
using image::SampleType;
namespace ramps_test {

struct Texel {
    int r, g, b, a;

    int luma() const { return 2126 * r + 7152 * g + 722 * b; } // of 2,550,000
};

Texel texel(const Image& image, int x, int y) {
    const auto at = image.u8().subspan(4 * (size_t(y) * size_t(image.extent.width) + size_t(x)), 4);
    return {at[0], at[1], at[2], at[3]};
}

class Ramps : public testing::Test {
protected:
    std::vector<NamedImage> ramps = make_ramps();
    const Image& water = ramps.at(0).image;
    const Image& foam = ramps.at(1).image;
    const Image& wave = ramps.at(2).image;
    const int last = water.extent.width - 1;
};

TEST_F(Ramps, colour_ramps_are_small_squares_with_alpha) {
    ASSERT_EQ(ramps.size(), 3U);
    EXPECT_EQ(ramps[0].name, "water_ramp");
    EXPECT_EQ(ramps[1].name, "foam_ramp");
    for (const NamedImage& ramp : {ramps[0], ramps[1]}) {
        EXPECT_EQ(ramp.image.extent, (Extent{64, 64})) << ramp.name;
        EXPECT_EQ(ramp.image.channels, 4) << ramp.name;
        EXPECT_EQ(ramp.image.type, SampleType::u8) << ramp.name;
    }
}

TEST_F(Ramps, have_the_same_bytes_on_every_machine) {
    EXPECT_EQ(sha256(water.bytes), "5fe4f8a3fe96afff711ef68607f3f3d8fea051df6a5ebe61305192e6fbb44962");
    EXPECT_EQ(sha256(foam.bytes), "7911e56dc33eaac09c3ca792cf055fe23f72056c91565b913dcfc804822b83c2");
}

TEST_F(Ramps, water_is_opaque_and_never_darkens_with_lightness) {
    for (int y = 0; y <= last; ++y) {
        EXPECT_EQ(texel(water, 0, y).a, 255);
        for (int x = 1; x <= last; ++x) {
            EXPECT_EQ(texel(water, x, y).a, 255);
            EXPECT_GE(texel(water, x, y).luma(), texel(water, x - 1, y).luma()) << x << ' ' << y;
        }
    }
}

TEST_F(Ramps, water_is_dark_at_the_feet_and_pale_and_flat_at_the_horizon) {
    const auto range = [&](int y) { return texel(water, last, y).luma() - texel(water, 0, y).luma(); };
    EXPECT_LT(texel(water, 0, 0).luma(), 400'000);
    EXPECT_GT(texel(water, 0, last).luma(), 1'250'000);
    EXPECT_GT(range(0), 2 * range(last));
}

TEST_F(Ramps, water_is_blue_or_green_before_it_is_red) {
    for (int y = 0; y <= last; ++y) {
        for (int x = 0; x <= last; ++x) {
            const Texel t = texel(water, x, y);
            EXPECT_LT(t.r, std::min(t.g, t.b)) << x << ' ' << y;
        }
    }
}

TEST_F(Ramps, foam_covers_more_with_lightness_and_less_with_distance) {
    for (int y = 0; y <= last; ++y) {
        for (int x = 0; x <= last; ++x) {
            if (x > 0) {
                EXPECT_GE(texel(foam, x, y).a, texel(foam, x - 1, y).a) << x << ' ' << y;
            }
            if (y > 0) {
                EXPECT_LE(texel(foam, x, y).a, texel(foam, x, y - 1).a) << x << ' ' << y;
            }
        }
    }
}

TEST_F(Ramps, foam_leaves_the_darker_half_clear_and_covers_the_lightest_at_the_feet) {
    for (int y = 0; y <= last; ++y) {
        EXPECT_EQ(texel(foam, last / 2, y).a, 0) << y;
    }
    EXPECT_GT(texel(foam, last, 0).a, 240);
}

// A filter that looks between a clear and a covered texel must not find a dark seam.
TEST_F(Ramps, transparent_foam_is_white) {
    for (int y = 0; y <= last; ++y) {
        for (int x = 0; x <= last; ++x) {
            const Texel t = texel(foam, x, y);
            EXPECT_GT(std::min({t.r, t.g, t.b}), 215) << x << ' ' << y;
        }
    }
}

class WaveRamps : public Ramps {
protected:
    static constexpr int k_size = 256;
    enum Ramp { height, front, tail, rollback };

    float at(int x, int ramp) const { return wave.f32()[size_t(4 * ((x + k_size) % k_size) + ramp)]; }
    int highest(int ramp) const {
        int found = 0;
        for (int x = 1; x < k_size; ++x)
            found = at(x, ramp) > at(found, ramp) ? x : found;
        return found;
    }
};

TEST_F(WaveRamps, are_one_row_of_the_same_bytes_on_every_machine) {
    EXPECT_EQ(ramps[2].name, "wave_ramps");
    EXPECT_EQ(wave.extent, (Extent{k_size, 1}));
    EXPECT_EQ(sha256(wave.bytes), "8d9a00ca0e938e80241de3c4c4da7987bef4995857bca12d53d8ffb7f31de02e");
}

TEST_F(WaveRamps, wrap_from_the_right_edge_to_the_left) {
    for (int x = 0; x < k_size; ++x)
        for (int ramp = 0; ramp < 4; ++ramp) {
            EXPECT_TRUE(at(x, ramp) >= 0.0F && at(x, ramp) <= 1.0F) << x << ' ' << ramp;
            EXPECT_NEAR(at(x, ramp), at(x + 1, ramp), 0.12F) << x << ' ' << ramp;
        }
    for (int ramp = 0; ramp < 4; ++ramp)
        EXPECT_EQ(at(-1, ramp), 0.0F) << ramp;
}

TEST_F(WaveRamps, wave_is_steeper_before_its_crest_than_after) {
    const int crest = highest(height);
    EXPECT_GT(at(crest, height), 0.99F);
    for (int x = 0; x < crest; ++x)
        EXPECT_LE(at(x, height), at(x + 1, height)) << x;
    for (int x = crest; x < k_size - 1; ++x)
        EXPECT_GE(at(x, height), at(x + 1, height)) << x;
    EXPECT_GT(at(crest - 48, height), 0.2F);
    EXPECT_LT(at(crest + 48, height), 0.01F);
}

TEST_F(WaveRamps, foam_has_the_order_front_tail_rollback) {
    EXPECT_GT(highest(front), highest(height));
    EXPECT_LT(highest(tail), highest(front));
    EXPECT_LT(highest(rollback), highest(tail));
}

} // namespace ramps_test
} // namespace tidemark::bake
