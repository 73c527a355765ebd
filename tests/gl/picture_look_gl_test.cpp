// A buffer's numbers as colours, cubes and volumes as flat pictures: known numbers in, bytes by hand out.
#include "gl_test.hpp"
#include "media/texture_files.hpp"
#include "render/buffer_views.hpp"

#include <cmath>
#include <limits>
#include <span>

namespace tidemark::render::picture_look_gl_test {

constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
constexpr float k_infinity = std::numeric_limits<float>::infinity();

/// One row of pixels, in floats.
gl::Texture row_of(const std::vector<Floats4>& pixels) {
    gl::Texture texture = gl::make_texture({int(pixels.size()), 1}, GL_RGBA32F, 1);
    gl::upload(texture, 0, GL_RGBA, GL_FLOAT, std::as_bytes(std::span(pixels)));
    return texture;
}

Bytes4 bytes_of(const gl::Texture& texture, int x, int y = 0) {
    const std::vector<float> values = gl::read_part(texture, 0, {x, y, {1, 1}});
    Bytes4 bytes{};
    for (size_t i = 0; i < 4; ++i)
        bytes[i] = int(std::lround(values[i] * 255));
    return bytes;
}

class PictureLookTest : public RenderTest {
protected:
    void SetUp() override {
        auto made = PictureLook::create();
        ASSERT_TRUE(made) << to_string(made.error());
        look_.emplace(*std::move(made));
    }
    Bytes4 seen(const Floats4& pixel, const Look& look) {
        const gl::Texture* drawn = look_->draw(row_of({pixel}), look);
        return drawn ? bytes_of(*drawn, 0) : Bytes4{};
    }

    std::optional<PictureLook> look_;
};

TEST_F(PictureLookTest, exposure_multiplies_by_powers_of_two) {
    const Floats4 pixel{0.2F, 3.0F, -1.0F, 0.0F};
    EXPECT_EQ(seen(pixel, {}), (Bytes4{51, 255, 0, 255}));
    EXPECT_EQ(seen(pixel, {.stops = 1}), (Bytes4{102, 255, 0, 255}));
    EXPECT_EQ(seen(pixel, {.stops = -2}), (Bytes4{13, 191, 0, 255}));
    EXPECT_EQ(seen(pixel, {.stops = 1000}), (Bytes4{255, 255, 0, 255}));
    EXPECT_EQ(seen({0, 1e-30F, 0, 0}, {.stops = 1000}), (Bytes4{0, 255, 0, 255}));
    EXPECT_EQ(look_->stops(), 126);
    EXPECT_EQ(seen({16000.0F, 4000.0F, 0.0F, 1.0F}, {.stops = -14}), (Bytes4{249, 62, 0, 255}));
}

TEST_F(PictureLookTest, a_single_channel_is_shown_in_grey) {
    const Floats4 pixel{0.2F, 0.4F, 0.6F, 0.8F};
    const int grey[] = {51, 102, 153, 204};
    for (int channel = 0; channel < 4; ++channel) {
        const int value = grey[channel];
        EXPECT_EQ(seen(pixel, {.channel = channel}), (Bytes4{value, value, value, 255}));
    }
}

TEST_F(PictureLookTest, a_difference_is_coloured_from_blue_over_grey_to_red) {
    const auto difference = [&](float x, float y, double stops = 0) {
        return seen({9, x, 9, y}, {.channel = 1, .less = 3, .stops = stops});
    };
    EXPECT_EQ(difference(0.3F, 0.3F), (Bytes4{221, 221, 221, 255}));
    EXPECT_EQ(difference(1, 0), (Bytes4{180, 4, 38, 255}));
    EXPECT_EQ(difference(0, 1), (Bytes4{59, 76, 192, 255}));
    EXPECT_EQ(difference(0, 7), (Bytes4{59, 76, 192, 255}));
    EXPECT_EQ(difference(0, 0.2F), (Bytes4{189, 192, 215, 255})); // 221 - 162 / 5, and so on
    EXPECT_EQ(difference(0, 0.1F, 1), (Bytes4{189, 192, 215, 255}));
}

TEST_F(PictureLookTest, non_finite_channels_are_marked) {
    const Bytes4 magenta{255, 0, 255, 255}, green{0, 255, 0, 255};
    EXPECT_EQ(seen({0, k_nan, 0, 1}, {.stops = 1}), magenta);
    EXPECT_EQ(seen({0, -k_infinity, 0, 1}, {.stops = 1}), green);
    EXPECT_EQ(seen({0, k_nan, 0, 1}, {.channel = 0}), (Bytes4{0, 0, 0, 255}));
    EXPECT_EQ(seen({k_infinity, k_infinity, 0, 1}, {.channel = 0, .less = 1}), magenta);
}

TEST_F(PictureLookTest, automatic_exposure_maps_the_largest_number_to_1) {
    std::vector<Floats4> pixels(1000, {0.5F, 0, 0, 50});
    pixels[777] = {0, -4, 0, 0};
    pixels[778] = {k_nan, k_infinity, 0, 0};
    const gl::Texture row = row_of(pixels);
    EXPECT_EQ(bytes_of(*look_->draw(row, {.automatic = true}), 0), (Bytes4{32, 0, 0, 255}));
    EXPECT_EQ(look_->stops(), -2);
    EXPECT_EQ(bytes_of(*look_->draw(row, {.channel = 0, .automatic = true}), 0),
              (Bytes4{255, 255, 255, 255}));
    EXPECT_EQ(look_->stops(), 1);
    EXPECT_EQ(bytes_of(*look_->draw(row, {.channel = 3, .less = 0, .automatic = true}), 0),
              (Bytes4{180, 4, 38, 255}));
    look_->draw(row_of({{0, 0, 0, 1}}), {.automatic = true});
    EXPECT_EQ(look_->stops(), 0);
}

class FlatViewTest : public RenderTest {};

TEST_F(FlatViewTest, the_faces_of_a_cube_match_their_directions) {
    constexpr int k_side = 4;
    const gl::Texture cube = gl::make_cube_texture(k_side, GL_RGBA16F, 1);
    for (int face = 0; face < 6; ++face) {
        std::vector<Floats4> texels;
        for (int i = 0; i < k_side * k_side; ++i) {
            const int row = i / k_side;
            texels.push_back({float(face), float(i % k_side), float(row), 1});
        }
        gl::upload(cube, face, GL_RGBA, GL_FLOAT, std::as_bytes(std::span(texels)));
    }
    auto view = FlatView::create(cube);
    ASSERT_TRUE(view) << to_string(view.error());
    const gl::Texture* flat = view->draw(cube, 0, 512);
    ASSERT_TRUE(flat);
    EXPECT_EQ(flat->extent, (Extent{16, 12}));
    // OpenGL's rows of a face begin at its top; those of a picture at the bottom.
    constexpr int k_cells[6][2] = {{2, 1}, {0, 1}, {1, 2}, {1, 0}, {1, 1}, {3, 1}};
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < k_side; ++y)
            for (int x = 0; x < k_side; ++x) {
                const int column = k_cells[face][0] * k_side + x, row = k_cells[face][1] * k_side + y;
                EXPECT_EQ(gl::read_part(*flat, 0, {column, row, {1, 1}}),
                          (std::vector<float>{float(face), float(x), float(k_side - 1 - y), 1}))
                    << face << ' ' << x << ' ' << y;
            }
    EXPECT_EQ(gl::read_part(*flat, 0, {0, 0, {1, 1}}), std::vector<float>(4, 0));
    EXPECT_EQ(view->draw(cube, 0, 2)->extent, (Extent{8, 6}));
}

/// Over an edge between neighbours the direction turns by no more than within a face.
TEST_F(FlatViewTest, neighbouring_faces_in_the_cross_share_an_edge) {
    constexpr int k_side = 16;
    const gl::Texture cube = gl::make_cube_texture(k_side, GL_RGBA16F, 1);
    for (int face = 0; face < 6; ++face) {
        std::vector<Floats4> texels;
        for (int i = 0; i < k_side * k_side; ++i) {
            const int row = i / k_side;
            const auto [x, y, z] =
                image::direction_of({face, (i % k_side + 0.5) / k_side, (row + 0.5) / k_side});
            const double length = std::sqrt(x * x + y * y + z * z);
            texels.push_back({float(x / length), float(y / length), float(z / length), 1});
        }
        gl::upload(cube, face, GL_RGBA, GL_FLOAT, std::as_bytes(std::span(texels)));
    }
    auto view = FlatView::create(cube);
    ASSERT_TRUE(view) << to_string(view.error());
    const gl::Texture* flat = view->draw(cube, 0, 512);
    ASSERT_TRUE(flat);
    const auto turn = [&](int x, int y, int to_x, int to_y) {
        const std::vector<float> a = gl::read_part(*flat, 0, {x, y, {1, 1}});
        const std::vector<float> b = gl::read_part(*flat, 0, {to_x, to_y, {1, 1}});
        return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    };
    constexpr double k_most = 2.0 / k_side; // between texels in the middle of a face
    for (int along = 0; along < k_side; ++along) {
        for (const int edge : {1, 2, 3})
            EXPECT_LT(turn(edge * k_side - 1, k_side + along, edge * k_side, k_side + along), k_most);
        for (const int edge : {1, 2})
            EXPECT_LT(turn(k_side + along, edge * k_side - 1, k_side + along, edge * k_side), k_most);
    }
}

TEST_F(FlatViewTest, a_slice_of_a_volume) {
    const gl::Texture volume = gl::make_volume_texture({3, 2}, 5, GL_RGBA32F, 1);
    for (int slice = 0; slice < 5; ++slice) {
        std::vector<Floats4> texels;
        for (int i = 0; i < 6; ++i)
            texels.push_back({float(slice), float(i), -1, k_infinity});
        gl::upload(volume, slice, GL_RGBA, GL_FLOAT, std::as_bytes(std::span(texels)));
    }
    auto view = FlatView::create(volume);
    ASSERT_TRUE(view) << to_string(view.error());
    for (const auto& [asked, shown] : {std::pair(0, 0), {3, 3}, {4, 4}, {99, 4}, {-1, 0}}) {
        const gl::Texture* flat = view->draw(volume, asked, 512);
        ASSERT_TRUE(flat);
        EXPECT_EQ(flat->extent, (Extent{3, 2}));
        EXPECT_EQ(gl::read_part(*flat, 0, {1, 1, {1, 1}}),
                  (std::vector<float>{float(shown), 4, -1, k_infinity}));
    }
}

} // namespace tidemark::render::picture_look_gl_test
