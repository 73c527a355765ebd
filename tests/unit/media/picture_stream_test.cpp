// Pictures that are written band by band: the same file as of the whole, or none.
#include "media/picture_file.hpp"
#include "picture_support.hpp"

#include <algorithm>

namespace tidemark::image::picture_stream_test {

constexpr Extent k_extent{23, 37};

class PictureStreamTest : public PictureTest {
protected:
    /// In bands of those heights from the top.
    Result<void> stream(const std::string& name, const Image& picture, bool alpha,
                        const PictureFormat& format, const std::vector<int>& heights) const {
        auto stream = PictureStream::create(in_folder(name), picture.extent, alpha, format);
        if (!stream)
            return fail(std::move(stream.error()));
        auto end = picture.bytes.end();
        for (const int height : heights) {
            Image band({picture.extent.width, height}, 4, picture.type);
            end -= std::ptrdiff_t(band.bytes.size());
            std::copy_n(end, band.bytes.size(), band.bytes.begin());
            if (auto added = stream->add(band); !added)
                return added;
        }
        EXPECT_EQ(end - picture.bytes.begin(), 0);
        EXPECT_FALSE(fs::exists(in_folder(name)));
        return stream->finish();
    }
    std::string bytes_of(const std::string& name) const {
        return *read_file(in_folder(name), size_t{1} << 20);
    }
};

TEST_F(PictureStreamTest, bands_make_the_file_of_the_whole_picture) {
    for (const char* name : {"a.png", "a.jpg", "a.tif", "a.exr", "a.hdr"})
        for (const SampleType type : {SampleType::u8, SampleType::f32})
            for (const bool alpha : {false, true}) {
                Image picture =
                    type == SampleType::u8 ? patterned_u8(k_extent, 4) : patterned_f32(k_extent, 4);
                if (!alpha)
                    picture = opaque(std::move(picture));
                const PictureFormat format{natural_depth(name), {{"Scene", "waves.glsl"}}};
                ASSERT_TRUE(write_picture(in_folder(name), picture, format));
                const std::string whole = bytes_of(name);
                for (const auto& heights : {std::vector{37}, {5, 16, 16}, {1, 32, 2, 2}}) {
                    fs::remove(in_folder(name));
                    const auto written = stream(name, picture, alpha, format, heights);
                    ASSERT_TRUE(written) << to_string(written.error());
                    EXPECT_EQ(bytes_of(name), whole) << name << ' ' << heights.size() << ' ' << alpha;
                    EXPECT_EQ(files(), 1u);
                }
                fs::remove(in_folder(name));
            }
}

TEST_F(PictureStreamTest, bands_of_sixteen_bits_make_the_same_file) {
    const Image picture = patterned_f32(k_extent, 4);
    const PictureFormat format{SampleDepth::u16, {}};
    ASSERT_TRUE(write_picture(in_folder("a.png"), picture, format));
    ASSERT_TRUE(stream("b.png", picture, true, format, {20, 17}));
    EXPECT_EQ(bytes_of("b.png"), bytes_of("a.png"));
}

TEST_F(PictureStreamTest, a_cancelled_stream_leaves_no_file) {
    for (const char* name : {"a.png", "a.jpg", "a.tif", "a.exr", "a.hdr"}) {
        {
            auto stream = PictureStream::create(in_folder(name), k_extent, false, {natural_depth(name), {}});
            ASSERT_TRUE(stream) << name;
            EXPECT_EQ(files(), 1u) << name; // under construction
            ASSERT_TRUE(stream->add(patterned_u8({23, 16}, 4)));
        }
        EXPECT_EQ(files(), 0u) << name;
    }
}

TEST_F(PictureStreamTest, a_missing_folder_is_an_error) {
    const auto stream = PictureStream::create(in_folder("no/a.png"), k_extent, false, {});
    ASSERT_FALSE(stream);
    EXPECT_EQ(stream.error().code, ErrorCode::write);
    EXPECT_EQ(stream.error().message,
              "cannot write '" + in_folder("no/a.png").string() + "': No such file or directory");
}

TEST_F(PictureStreamTest, sizes_beyond_the_format_are_refused) {
    EXPECT_TRUE(PictureStream::check_extent("a.jpg", {65500, 1}));
    EXPECT_TRUE(PictureStream::check_extent("a.png", {1, 1'000'000}));
    const auto refused = PictureStream::check_extent("a.JPG", {1, 65501});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::usage);
    EXPECT_EQ(refused.error().message, "--size 1x65501: a .jpg has at most 65500 pixels on a side");
}

} // namespace tidemark::image::picture_stream_test
