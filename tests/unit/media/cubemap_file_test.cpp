#include "media/picture_file.hpp"
#include "media/texture_files.hpp"
#include "support/largest_difference.hpp"
#include "unit/media/picture_support.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace tidemark::image::cubemap_file_test {

using Vector = std::array<double, 3>;

const std::array<std::string, 6> k_names = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};

// The direction of a texel by ShaderToy's own table: at uv it is the bilinear mix of those at the corners A
// (0,0), B (1,0), C (1,1), D (0,1) of a face.
constexpr Vector k_corners[6][4] = {
    {{1, 1, 1}, {1, 1, -1}, {1, -1, -1}, {1, -1, 1}}, {{-1, 1, -1}, {-1, 1, 1}, {-1, -1, 1}, {-1, -1, -1}},
    {{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}}, {{-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}},
    {{-1, 1, 1}, {1, 1, 1}, {1, -1, 1}, {-1, -1, 1}}, {{1, 1, -1}, {-1, 1, -1}, {-1, -1, -1}, {1, -1, -1}},
};

Vector unit(const Vector& v) {
    const double length = std::hypot(v[0], v[1], v[2]);
    return {v[0] / length, v[1] / length, v[2] / length};
}

Vector seen_by(int face, double s, double t) {
    Vector direction;
    for (size_t i = 0; i < 3; ++i) {
        const auto& corner = k_corners[face];
        direction[i] = (1 - t) * ((1 - s) * corner[0][i] + s * corner[1][i]) +
                       t * ((1 - s) * corner[3][i] + s * corner[2][i]);
    }
    return unit(direction);
}

/// Faces, or the pictures of faces, in which each texel holds the direction it is seen in.
CubeFaces compass(int side) {
    CubeFaces faces;
    for (int face = 0; face < 6; ++face) {
        Image& image = faces[size_t(face)] = Image({side, side}, 3, SampleType::f32);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const Vector direction = seen_by(face, (x + 0.5) / side, (y + 0.5) / side);
                for (size_t i = 0; i < 3; ++i)
                    image.f32()[size_t(3 * (y * side + x)) + i] = float(direction[i]);
            }
    }
    return faces;
}

float* pixel_from_top(Image& image, int x, int y) {
    return &image.f32()[size_t(image.channels * ((image.extent.height - 1 - y) * image.extent.width + x))];
}

/// Puts a face into a picture, its top left corner at a column and row counted in faces from the top.
void put(Image& picture, const Image& face, int column, int row, bool turned = false) {
    const int side = face.extent.width;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const int fx = turned ? side - 1 - x : x, fy = turned ? side - 1 - y : y;
            std::copy_n(&face.f32()[size_t(3 * (fy * side + fx))], 3,
                        pixel_from_top(picture, column * side + x, row * side + y));
        }
}

/// Whether the picture has no step between two neighbouring cells.
bool continuous(Image& picture, int side, int column, int row, int to_column, int to_row) {
    double largest = 0.0;
    for (int i = 0; i < side; ++i) {
        const bool across = row == to_row;
        const int x = column * side + (across ? side - 1 : i), y = row * side + (across ? i : side - 1);
        const float* a = pixel_from_top(picture, x, y);
        const float* b = pixel_from_top(picture, across ? x + 1 : x, across ? y : y + 1);
        EXPECT_TRUE(to_column == column + (across ? 1 : 0));
        for (int c = 0; c < 3; ++c)
            largest = std::max(largest, std::abs(double(a[c]) - double(b[c])));
    }
    return largest < 2.0 / side;
}

Image cross(const CubeFaces& faces, bool tall) {
    const int side = faces[0].extent.width;
    Image picture(tall ? Extent{3 * side, 4 * side} : Extent{4 * side, 3 * side}, 3, SampleType::f32);
    put(picture, faces[2], 1, 0);
    put(picture, faces[1], 0, 1);
    put(picture, faces[4], 1, 1);
    put(picture, faces[0], 2, 1);
    put(picture, faces[3], 1, 2);
    put(picture, faces[5], tall ? 1 : 3, tall ? 3 : 1, tall);
    return picture;
}

TEST(CubemapFile, crosses_are_unfolded_cubes_and_return_the_faces) {
    const CubeFaces faces = compass(16);
    for (const bool tall : {false, true}) {
        Image picture = cross(faces, tall);
        EXPECT_TRUE(continuous(picture, 16, 0, 1, 1, 1));
        EXPECT_TRUE(continuous(picture, 16, 1, 1, 2, 1));
        EXPECT_TRUE(continuous(picture, 16, 1, 0, 1, 1));
        EXPECT_TRUE(continuous(picture, 16, 1, 1, 1, 2));
        if (tall)
            EXPECT_TRUE(continuous(picture, 16, 1, 2, 1, 3));
        else
            EXPECT_TRUE(continuous(picture, 16, 2, 1, 3, 1));
        const Result<CubeFaces> cube = cube_of_picture(picture);
        ASSERT_TRUE(cube) << cube.error().message;
        EXPECT_EQ(*cube, faces);
    }
}

TEST(CubemapFile, strips_hold_the_faces_in_order) {
    const CubeFaces faces = compass(5);
    Image row({30, 5}, 3, SampleType::f32), column({5, 30}, 3, SampleType::f32);
    for (int face = 0; face < 6; ++face) {
        put(row, faces[size_t(face)], face, 0);
        put(column, faces[size_t(face)], 0, face);
    }
    EXPECT_EQ(*cube_of_picture(row), faces);
    EXPECT_EQ(*cube_of_picture(column), faces);
}

TEST(CubemapFile, first_row_of_a_face_is_the_top_row_of_its_file) {
    CubeFaces pictures;
    for (size_t face = 0; face < 6; ++face)
        pictures[face] = flipped(compass(4)[face]); // as read_picture gives a file with the face upright
    EXPECT_EQ(*cube_of_faces(pictures, k_names), compass(4));
}

Vector panorama_direction(double u, double v) {
    const double a = 2.0 * std::numbers::pi * u, b = std::numbers::pi * (v - 0.5);
    return {-std::cos(b) * std::sin(a), std::sin(b), std::cos(b) * std::cos(a)};
}

Image compass_panorama(Extent size) {
    Image panorama(size, 3, SampleType::f32);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const Vector d = panorama_direction((x + 0.5) / size.width, (y + 0.5) / size.height);
            for (size_t i = 0; i < 3; ++i)
                panorama.f32()[size_t(3 * (y * size.width + x)) + i] = float(d[i]);
        }
    return panorama;
}

TEST(CubemapFile, a_panorama_matches_the_directions_of_samplerCube) {
    const Result<CubeFaces> cube = cube_of_picture(compass_panorama({512, 256}));
    ASSERT_TRUE(cube);
    const CubeFaces wanted = compass(128);
    for (size_t face = 0; face < 6; ++face)
        EXPECT_LT(largest_difference((*cube)[face], wanted[face]), 0.015) << face;
}

TEST(CubemapFile, the_panorama_of_a_cube_matches_its_directions_without_seams) {
    const Image panorama = equirectangular_of(compass(64), {256, 128});
    EXPECT_LT(largest_difference(panorama, compass_panorama({256, 128})), 0.005);
}

TEST(CubemapFile, the_middle_of_a_panorama_is_minus_z_and_right_of_it_is_plus_x) {
    // One colour a face: its number
    CubeFaces faces;
    for (int face = 0; face < 6; ++face) {
        faces[size_t(face)] = Image({8, 8}, 1, SampleType::u8);
        std::ranges::fill(faces[size_t(face)].u8(), uint8_t(10 * (face + 1)));
    }
    const Image panorama = equirectangular_of(faces, {64, 32});
    const auto at = [&](int x, int y) { return panorama.u8()[size_t(y * 64 + x)] / 10 - 1; };
    EXPECT_EQ(at(32, 16), 5); // -Z
    EXPECT_EQ(at(48, 16), 0); // +X
    EXPECT_EQ(at(0, 16), 4);  // +Z
    EXPECT_EQ(at(63, 16), 4);
    EXPECT_EQ(at(16, 16), 1); // -X
    EXPECT_EQ(at(20, 31), 2); // +Y at the top
    EXPECT_EQ(at(20, 0), 3);  // -Y
}

TEST(CubemapFile, conversion_to_faces_and_back_keeps_a_panorama) {
    Image picture({256, 128}, 3, SampleType::u8);
    const Image directions = compass_panorama(picture.extent);
    for (size_t i = 0; i < picture.samples(); ++i)
        picture.u8()[i] = uint8_t(std::lround(127.5 + 127.5 * directions.f32()[i]));
    const Image back = equirectangular_of(*cube_of_picture(picture), picture.extent);
    int largest = 0;
    for (size_t i = 0; i < picture.samples(); ++i)
        largest = std::max(largest, std::abs(picture.u8()[i] - back.u8()[i]));
    EXPECT_LE(largest, 2);
}

TEST(CubemapFile, vflip_mirrors_directions_vertically) {
    const CubeFaces flipped_faces = vflipped(compass(32));
    CubeFaces wanted = compass(32);
    for (Image& face : wanted)
        for (size_t i = 1; i < face.samples(); i += 3)
            face.f32()[i] = -face.f32()[i];
    for (size_t face = 0; face < 6; ++face)
        EXPECT_LT(largest_difference(flipped_faces[face], wanted[face]), 1e-6) << face;
    EXPECT_EQ(vflipped(flipped_faces), compass(32));
}

TEST(CubemapFile, infinities_of_a_panorama_stay_where_they_are) {
    CubeFaces faces = compass(4);
    faces[4].f32()[0] = std::numeric_limits<float>::infinity();
    const Image panorama = equirectangular_of(faces, {64, 32});
    for (const float sample : panorama.f32())
        EXPECT_FALSE(std::isnan(sample));
}

TEST(CubemapFile, faces_of_different_types_are_converted) {
    CubeFaces pictures;
    pictures.fill(patterned_u8({4, 4}, 3));
    pictures[2] = patterned_u8({4, 4}, 1);
    pictures[3] = patterned_u8({4, 4}, 2);
    Result<CubeFaces> cube = cube_of_faces(pictures, k_names);
    ASSERT_TRUE(cube);
    for (const Image& face : *cube)
        EXPECT_EQ(face.channels, 4);
    const Image grey = flipped(pictures[2]), both = flipped(pictures[3]);
    for (size_t i = 0; i < 16; ++i) {
        EXPECT_EQ((*cube)[2].u8()[4 * i + 1], grey.u8()[i]);
        EXPECT_EQ((*cube)[2].u8()[4 * i + 3], 255);
        EXPECT_EQ((*cube)[3].u8()[4 * i + 2], both.u8()[2 * i]);
        EXPECT_EQ((*cube)[3].u8()[4 * i + 3], both.u8()[2 * i + 1]);
    }
    pictures[5] = patterned_f32({4, 4}, 3);
    cube = cube_of_faces(pictures, k_names);
    ASSERT_TRUE(cube);
    EXPECT_EQ((*cube)[0].type, SampleType::f32);
    EXPECT_EQ((*cube)[0].f32()[0], float(flipped(pictures[0]).u8()[0]) / 255.0f);
    EXPECT_EQ((*cube)[5].f32()[1], flipped(pictures[5]).f32()[1]);
}

class CubemapFiles : public PictureTest {};

TEST_F(CubemapFiles, are_read_from_one_file_or_six) {
    std::vector<fs::path> files;
    for (int face = 0; face < 6; ++face) {
        files.push_back(in_folder("f" + std::to_string(face) + ".exr"));
        ASSERT_TRUE(write_picture(files.back(), flipped(compass(4)[size_t(face)]), {SampleDepth::half}));
    }
    const Result<CubeFaces> six = read_cubemap(files);
    ASSERT_TRUE(six) << six.error().message;
    for (size_t face = 0; face < 6; ++face)
        EXPECT_LT(largest_difference((*six)[face], compass(4)[face]), 0.001);
    ASSERT_TRUE(write_picture(in_folder("cross.exr"), cross(compass(4), false), {SampleDepth::half}));
    EXPECT_EQ(*read_cubemap({in_folder("cross.exr")}), *six);
}

TEST_F(CubemapFiles, errors_are_reported) {
    const auto message = [](const std::vector<fs::path>& files) {
        const Result<CubeFaces> cube = read_cubemap(files);
        return cube ? "no error" : cube.error().message;
    };
    const auto picture = [&](const std::string& name, Extent size) {
        EXPECT_TRUE(write_picture(in_folder(name), patterned_u8(size, 3)));
        return in_folder(name);
    };
    const fs::path square = picture("s.png", {8, 8}), wide = picture("w.png", {8, 7}),
                   large = picture("l.png", {9, 9});
    EXPECT_EQ(message({}), "a cubemap is made of six files or of one, not of 0");
    EXPECT_EQ(message({square, square}),
              "a cubemap is made of six files or of one, not of 2 ('" + square.string() + "', …)");
    EXPECT_EQ(message({square}),
              "cannot use '" + square.string() +
                  "' as a cubemap: it is 8x8 pixels; one file is a cross (4:3 or 3:4), a row "
                  "of faces (6:1 or 1:6) or a panorama (2:1)");
    EXPECT_EQ(message({square, square, wide, square, square, square}),
              "cannot use '" + wide.string() + "' as a cubemap: it is 8x7 pixels; a face is square");
    EXPECT_EQ(message({square, square, square, square, square, large}),
              "cannot use '" + large.string() + "' as a cubemap: it is 9x9 pixels and '" + square.string() +
                  "' is 8x8; faces are of one size");
    EXPECT_EQ(message({square, square, square, square, square, in_folder("none.png")}),
              "cannot read '" + in_folder("none.png").string() + "': no such file");
}

} // namespace tidemark::image::cubemap_file_test
