// Held against filters written out by hand, at points and over boxes.
#include "proof/texels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tidemark::proof::texels_test {

constexpr int k_width = 7, k_height = 5;

/// A number for every texel; the components differ.
float texel(int x, int y, uint32_t component) {
    return float(std::sin(12.9898 * x + 78.233 * y + 3.1 * component));
}

TexelLevel level(int width, int height) {
    std::vector<float> rgba;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (uint32_t component = 0; component < 4; ++component)
                rgba.push_back(texel(x, y, component));
    return {{width, height, 1}, std::move(rgba)};
}

Texels texels(Texels::Wrap wrap, bool linear = true) {
    Texels result;
    result.wrap = wrap;
    result.magnify_linear = result.minify_linear = linear;
    result.levels.push_back(level(k_width, k_height));
    return result;
}

int wrapped(int index, int size, Texels::Wrap wrap) {
    switch (wrap) {
    case Texels::Wrap::repeat: return ((index % size) + size) % size;
    case Texels::Wrap::clamp: return std::clamp(index, 0, size - 1);
    case Texels::Wrap::mirror: {
        const int at = ((index % (2 * size)) + 2 * size) % (2 * size);
        return std::min(at, 2 * size - 1 - at);
    }
    }
    return 0;
}

double by_hand(double u, double v, const Texels& texture, uint32_t component) {
    const auto at = [&](int x, int y) {
        return double(
            texel(wrapped(x, k_width, texture.wrap), wrapped(y, k_height, texture.wrap), component));
    };
    if (!texture.magnify_linear)
        return at(int(std::floor(u * k_width)), int(std::floor(v * k_height)));
    const double x = u * k_width - 0.5, y = v * k_height - 0.5;
    const int i = int(std::floor(x)), j = int(std::floor(y));
    const double s = x - i, t = y - j;
    return (1 - t) * ((1 - s) * at(i, j) + s * at(i + 1, j)) +
           t * ((1 - s) * at(i, j + 1) + s * at(i + 1, j + 1));
}

constexpr std::array k_wraps{Texels::Wrap::repeat, Texels::Wrap::clamp, Texels::Wrap::mirror};

TEST(Texels, are_filtered_as_calculated_by_hand) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> anywhere(-3, 3);
    for (const Texels::Wrap wrap : k_wraps)
        for (const bool linear : {false, true}) {
            const Texels texture = texels(wrap, linear);
            for (int i = 0; i < 500; ++i) {
                const double u = anywhere(random), v = anywhere(random);
                const std::array<Interval, 2> at{{{u, u}, {v, v}}};
                const Interval found = texture.look_up({.component = 2}, at);
                ASSERT_NEAR(found.low, by_hand(u, v, texture, 2), 1e-9) << u << ", " << v;
                ASSERT_LT(found.width(), 1e-9);
            }
        }
}

TEST(Texels, of_a_box_have_bounds) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> part(0, 1);
    for (const Texels::Wrap wrap : k_wraps)
        for (const bool linear : {false, true})
            for (int i = 0; i < 300; ++i) {
                const Texels texture = texels(wrap, linear);
                const double size = std::ldexp(1, -i % 12);
                const double u = 6 * part(random) - 3, v = 6 * part(random) - 3;
                const std::array<Interval, 2> box{
                    {{u, u + size * part(random)}, {v, v + size * part(random)}}};
                const Interval found = texture.look_up({}, box);
                for (int k = 0; k < 20; ++k) {
                    const double x = box[0].low + part(random) * box[0].width(),
                                 y = box[1].low + part(random) * box[1].width();
                    const double exact = by_hand(x, y, texture, 0);
                    ASSERT_GE(exact, found.low - 1e-12) << x << ", " << y << ", " << size;
                    ASSERT_LE(exact, found.high + 1e-12) << x << ", " << y << ", " << size;
                }
            }
}

TEST(Texels, of_a_narrow_box_have_narrow_bounds) {
    const Texels texture = texels(Texels::Wrap::repeat);
    const std::array<Interval, 2> box{{{0.3, 0.3 + 1e-7}, {0.5, 0.5 + 1e-7}}};
    EXPECT_LT(texture.look_up({}, box).width(), 1e-5);
}

TEST(Texels, of_a_whole_picture_have_its_extremes_as_bounds) {
    const std::array<Interval, 2> everywhere{everything(), {0, 1}};
    const Texels texture = texels(Texels::Wrap::repeat);
    const Interval all = texture.look_up({}, everywhere);
    double low = 1, high = -1;
    for (int y = 0; y < k_height; ++y)
        for (int x = 0; x < k_width; ++x) {
            low = std::min(low, double(texel(x, y, 0)));
            high = std::max(high, double(texel(x, y, 0)));
        }
    EXPECT_EQ(all.low, low);
    EXPECT_EQ(all.high, high);
}

Texels with_levels(Texels::Mipmaps mipmaps) {
    Texels result;
    result.mipmaps = mipmaps;
    for (const float value : {0.0f, 10.0f, 30.0f})
        result.levels.push_back({{1, 1, 1}, {value, value, value, value}});
    return result;
}

TEST(Texels, lie_between_their_levels) {
    const Lookup lookup{.has_level = true};
    const auto at = [&](Texels::Mipmaps mipmaps, Interval wanted) {
        return with_levels(mipmaps).look_up(lookup, std::array<Interval, 3>{{{0, 0}, {0, 0}, wanted}});
    };
    EXPECT_NEAR(at(Texels::Mipmaps::linear, {0.25, 0.25}).low, 2.5, 1e-9);
    EXPECT_NEAR(at(Texels::Mipmaps::linear, {7, 7}).low, 30, 1e-9);
    EXPECT_NEAR(at(Texels::Mipmaps::nearest, {1.2, 1.2}).low, 10, 1e-9);
    EXPECT_NEAR(at(Texels::Mipmaps::none, {1.2, 1.2}).high, 0, 1e-9);
    EXPECT_NEAR(at(Texels::Mipmaps::linear, {-3, -1}).high, 0, 1e-9);
    EXPECT_LE(at(Texels::Mipmaps::linear, {0.5, 1.5}).low, 5);
    EXPECT_GE(at(Texels::Mipmaps::linear, {0.5, 1.5}).high, 20);
    EXPECT_TRUE(with_levels(Texels::Mipmaps::linear).chooses_level({}));
    EXPECT_FALSE(with_levels(Texels::Mipmaps::linear).chooses_level(lookup));
}

TEST(Texels, of_an_implicit_level_include_all_levels) {
    const auto at = [](Texels::Mipmaps mipmaps, const Lookup& lookup, UnnamedLevel unnamed) {
        return with_levels(mipmaps).look_up(lookup, std::array<Interval, 3>{}, unnamed);
    };
    for (const auto mipmaps : {Texels::Mipmaps::linear, Texels::Mipmaps::nearest}) {
        EXPECT_LE(at(mipmaps, {}, UnnamedLevel::any).low, 0);
        EXPECT_GE(at(mipmaps, {}, UnnamedLevel::any).high, 30);
        EXPECT_EQ(at(mipmaps, {}, UnnamedLevel::base).high, 0);
        EXPECT_EQ(at(mipmaps, {.has_level = true}, UnnamedLevel::any).high, 0);
    }
    EXPECT_EQ(at(Texels::Mipmaps::none, {}, UnnamedLevel::any).high, 0);
}

TEST(Texels, are_fetched_by_their_indices) {
    const Texels texture = texels(Texels::Wrap::repeat);
    const Lookup fetch{.form = Lookup::Form::fetch, .component = 1, .has_level = true};
    const auto at = [&](Interval x, Interval y) {
        return texture.look_up(fetch, std::array<Interval, 3>{x, y, Interval{0, 0}});
    };
    EXPECT_EQ(at({3, 3}, {2, 2}).low, texel(3, 2, 1));
    EXPECT_TRUE(at({3, 3}, {2, 2}).point());
    EXPECT_EQ(at({9, 9}, {2, 2}).high, 0);
    EXPECT_TRUE(at({6, 8}, {2, 2}).contains(0));
    const Lookup size{.form = Lookup::Form::size, .component = 1, .coordinates = 0, .has_level = true};
    EXPECT_EQ(texture.look_up(size, std::array<Interval, 1>{{{0, 0}}}).low, k_height);
}

TEST(Texels, of_a_cube_come_from_the_face) {
    Texels cube;
    cube.kind = Texels::Kind::cube;
    std::vector<float> rgba;
    for (const float face : {0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f})
        rgba.insert(rgba.end(), 2 * 2 * 4, face);
    cube.levels.push_back({{2, 2, 6}, std::move(rgba)});
    const auto at = [&](double x, double y, double z, double more = 0) {
        return cube.look_up({.coordinates = 3},
                            std::array<Interval, 3>{{{x, x + more}, {y, y + more}, {z, z + more}}});
    };
    EXPECT_NEAR(at(1, 0.2, 0.1).low, 0, 1e-9);
    EXPECT_NEAR(at(-1, 0.2, 0.1).low, 1, 1e-9);
    EXPECT_NEAR(at(0.1, 1, 0.1).low, 2, 1e-9);
    EXPECT_NEAR(at(0.1, -1, 0.1).low, 3, 1e-9);
    EXPECT_NEAR(at(0.1, 0.3, 1).low, 4, 1e-9);
    EXPECT_NEAR(at(0.1, 0.3, -1).low, 5, 1e-9);
    EXPECT_LE(at(0.9, 0.9, 0.1, 0.2).low, 0);
    EXPECT_GE(at(0.9, 0.9, 0.1, 0.2).high, 2);
}

TEST(Texels, non_finite_texels_make_the_result_partial) {
    Texels texture;
    texture.levels.push_back({{1, 1, 1}, {NAN, 0, 0, 0}});
    EXPECT_TRUE(texture.look_up({}, std::array<Interval, 2>{{{0, 0}, {0, 0}}}).partial);
    EXPECT_TRUE(look_up({}, {.sampler = "iChannel0"}, std::array<Interval, 2>{{{0, 0}, {0, 0}}}).partial);
}

} // namespace tidemark::proof::texels_test
