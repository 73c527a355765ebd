// The step between the renderer and files: the layout of a cube, and bands of which a part is written.
#include "cli/capture_delivery.hpp"
#include "media/file_samples.hpp"
#include "unit/media/picture_support.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace tidemark::cli::capture_delivery_test {

using namespace host;

using image::CubeFaces;
using image::Image;
using image::SampleType;

CubeFaces cube(SampleType type) {
    CubeFaces faces;
    for (size_t face = 0; face < faces.size(); ++face) {
        faces[face] =
            type == SampleType::u8 ? image::patterned_u8({4, 4}, 4) : image::patterned_f32({4, 4}, 4);
        std::ranges::fill(std::span(faces[face].bytes).first(faces[face].row_bytes()), std::byte(face));
    }
    return faces;
}

TEST(CaptureDelivery, a_picture_is_delivered_unchanged) {
    const Image picture = image::patterned_u8({5, 3}, 4);
    for (const bool six_faces : {false, true})
        EXPECT_EQ(laid_out(picture, six_faces), std::vector{picture});
}

TEST(CaptureDelivery, six_faces_are_upright_and_in_order) {
    for (const SampleType type : {SampleType::u8, SampleType::f32}) {
        const CubeFaces faces = cube(type);
        const std::vector<Image> pictures = laid_out(faces, true);
        ASSERT_EQ(pictures.size(), 6U);
        for (size_t face = 0; face < 6; ++face)
            EXPECT_EQ(pictures[face], flipped(faces[face]));
    }
}

TEST(CaptureDelivery, a_cube_for_one_file_is_a_panorama) {
    const std::vector<Image> pictures = laid_out(cube(SampleType::u8), false);
    ASSERT_EQ(pictures.size(), 1U);
    EXPECT_EQ(pictures[0].extent, image::k_panorama);
    EXPECT_EQ(pictures[0], image::equirectangular_of(cube(SampleType::u8)));
}

class CroppedBands : public image::PictureTest {};

TEST_F(CroppedBands, equal_the_file_of_the_cropped_picture) {
    constexpr Extent k_whole{9, 12};
    for (const SampleType type : {SampleType::u8, SampleType::f32})
        for (const Rectangle& area :
             {Rectangle{2, 3, {4, 5}}, Rectangle{0, 0, {9, 1}}, Rectangle{8, 0, {1, 12}},
              Rectangle{1, 11, {1, 1}}, Rectangle{0, 0, k_whole}}) {
            const Image picture =
                type == SampleType::u8 ? image::patterned_u8(k_whole, 4) : image::patterned_f32(k_whole, 4);
            auto stream = image::PictureStream::create(in_folder("a.png"), area.extent, true, {});
            ASSERT_TRUE(stream);
            BandOutput bands(std::move(*stream), k_whole, area, true);
            for (int bottom = k_whole.height; bottom > 0;) {
                const int height = std::min(5, bottom);
                bottom -= height;
                ASSERT_TRUE(bands.take(image::cropped(picture, {0, bottom, {k_whole.width, height}})));
            }
            ASSERT_TRUE(bands.finish());
            Image part = image::cropped(picture, area);
            image::take_non_finite(part); // the pattern may hold the mark of a pixel that is not finite
            Sha256 hash;
            add_rows(hash, part);
            EXPECT_EQ(bands.sha256(), hash.digits());
            EXPECT_EQ(*image::read_picture(in_folder("a.png")), image::in_bytes(part)) << to_string(area);
        }
}

TEST_F(CroppedBands, count_only_the_pixels_of_the_crop) {
    Image picture({2, 4}, 4, SampleType::f32);
    for (const size_t row : {size_t{0}, size_t{2}})
        picture.f32()[8 * row] = std::numeric_limits<float>::infinity();
    auto stream =
        image::PictureStream::create(in_folder("a.png"), {2, 2}, true, {image::SampleDepth::u16, {}});
    ASSERT_TRUE(stream);
    BandOutput bands(std::move(*stream), picture.extent, Rectangle{0, 2, {2, 2}}, false);
    ASSERT_TRUE(bands.take(picture));
    ASSERT_TRUE(bands.finish());
    EXPECT_EQ(bands.not_finite(), 1U);
}

} // namespace tidemark::cli::capture_delivery_test
