// Files that are not pictures, or damaged ones: each gives one line of error; nothing is printed, nothing
// crashes.
#include "media/picture_file.hpp"
#include "picture_support.hpp"

#include <array>
#include <functional>
#include <random>

namespace tidemark::image::picture_damage_test {

class PictureDamage : public PictureTest {
protected:
    /// The message of reading `bytes` under `name`, with the path taken off; "" for a picture.
    std::string outcome(const std::string& name, const std::string& bytes) const {
        return outcome_of(put(name, bytes));
    }

    static std::string outcome_of(const fs::path& path) {
        const Result<Image> read = read_picture(path);
        if (read)
            return {};
        EXPECT_EQ(read.error().code, ErrorCode::load);
        EXPECT_TRUE(read.error().diagnostics.empty());
        const std::string& message = read.error().message;
        const std::string start = "cannot read '" + path.string() + "': ";
        EXPECT_TRUE(message.starts_with(start)) << message;
        EXPECT_GT(message.size(), start.size());
        EXPECT_EQ(message.find('\n'), message.npos) << message;
        EXPECT_EQ(message.find("<picture>"), message.npos) << message;
        return message.substr(std::min(message.size(), start.size()));
    }

    std::string written(const std::string& name) const {
        const Result<void> result =
            write_picture(in_folder(name), patterned_u8({31, 17}, 3), {natural_depth(name), {}});
        EXPECT_TRUE(result) << result.error().message;
        return bytes_of(in_folder(name));
    }
};

/// Returns what the action prints on either stream.
std::string printed_by(const std::function<void()>& action) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    action();
    return testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
}

TEST_F(PictureDamage, missing_files_are_reported) {
    EXPECT_EQ(outcome_of(in_folder("none.png")), "no such file");
    EXPECT_EQ(outcome_of(folder()), "it is a directory");
    EXPECT_EQ(outcome("empty.png", ""), "the file is empty");
}

TEST_F(PictureDamage, files_of_other_types_are_reported) {
    const std::string what = "it is not a PNG, JPEG, TIFF, EXR, HDR, BMP, WebP, PNM or TGA picture";
    EXPECT_EQ(outcome("text.png", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }"), what);
    EXPECT_EQ(outcome("one.jpg", "x"), what);
    EXPECT_EQ(outcome("zero.exr", std::string(4096, '\0')), what);
    EXPECT_EQ(outcome("riff.webp", std::string("RIFF\4\0\0\0WAVE", 12)), what);
}

TEST_F(PictureDamage, a_truncated_file_is_refused) {
    for (const std::string name : {"a.png", "a.jpg", "a.tif", "a.exr", "a.hdr"}) {
        const std::string whole = written(name);
        ASSERT_EQ(outcome(name, whole), "");
        const size_t step = std::max<size_t>(1, whole.size() / 150);
        const std::string printed = printed_by([&] {
            for (size_t length = 0; length < whole.size(); length += step)
                EXPECT_NE(outcome(name, whole.substr(0, length)), "") << name << " cut to " << length;
            EXPECT_NE(outcome(name, whole.substr(0, whole.size() - 1)), "")
                << name << " without its last byte";
        });
        EXPECT_EQ(printed, "") << name;
    }
}

std::string little_endian(uint64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i)
        text += char(value >> (8 * i) & 0xff);
    return text;
}

/// Returns a TIFF of bytes in two strips. The directory comes first, so that cutting the file off removes
/// only pixels.
std::string hand_made_tiff(bool big) {
    constexpr uint64_t width = 16, height = 8;
    const int offset = big ? 8 : 4;
    const std::vector<std::array<uint64_t, 4>> entries = {
        {256, 3, 1, width}, {257, 3, 1, height}, {258, 3, 1, 8},          {259, 3, 1, 1}, {262, 3, 1, 1},
        {273, 4, 2, 0},     {277, 3, 1, 1},      {278, 3, 1, height / 2}, {279, 4, 2, 0}};
    const uint64_t directory = big ? 16 : 8;
    const uint64_t behind =
        directory + uint64_t(big ? 8 : 2) + entries.size() * uint64_t(big ? 20 : 12) + uint64_t(offset);
    const uint64_t sizes = behind + 8, pixels = sizes + 8;
    using namespace std::string_literals;
    std::string file = big ? "II+\0\x08\0\0\0"s : "II*\0"s;
    file += little_endian(directory, offset) + little_endian(entries.size(), big ? 8 : 2);
    for (auto [tag, type, count, value] : entries) {
        file += little_endian(tag, 2) + little_endian(type, 2) + little_endian(count, offset);
        if (big && count == 2) // which fit into the entry
            file += tag == 273 ? little_endian(pixels, 4) + little_endian(pixels + 64, 4)
                               : little_endian(64, 4) + little_endian(64, 4);
        else
            file += little_endian(tag == 273 ? behind : tag == 279 ? sizes : value, offset);
    }
    file += little_endian(0, offset) + little_endian(pixels, 4) + little_endian(pixels + 64, 4);
    file += little_endian(64, 4) + little_endian(64, 4);
    for (uint64_t i = 0; i < width * height; ++i)
        file += char(i * 2);
    return file;
}

TEST_F(PictureDamage, a_truncated_tiff_of_either_kind_is_refused) {
    for (const bool big : {false, true}) {
        const std::string whole = hand_made_tiff(big);
        const Result<Image> read = read_picture(put("a.tif", whole));
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read->extent, (Extent{16, 8}));
        EXPECT_EQ(read->u8()[0], 224) << "the bottom left";
        for (size_t length = 4; length < whole.size(); ++length)
            EXPECT_EQ(outcome("a.tif", whole.substr(0, length)), "the file is damaged or cut short")
                << length;
    }
}

/// One of each format that we read and do not write, uncompressed.
TEST_F(PictureDamage, a_truncated_file_of_a_simple_format_is_refused) {
    using namespace std::string_literals;
    const std::string pixels(4 * 3 * 3, 'x');
    const std::pair<std::string, std::string> files[] = {
        {"a.ppm", "P6 4 3 255\n" + pixels},
        {"a.pgm", "P5 4 9 255\n" + pixels},
        {"text.ppm", "P3 2 2 255\n1 2 3 4 5 6 7 8 9 10 11 7\n"},
        {"a.pfm", "PF\n3 1\n-1.0\n" + pixels},
        {"a.tga", "\0\0\2\0\0\0\0\0\0\0\0\0\4\0\3\0\x18\0"s + pixels},
        {"a.bmp", "BM" + little_endian(54 + 36, 4) + little_endian(0, 4) + little_endian(54, 4) +
                      little_endian(40, 4) + little_endian(4, 4) + little_endian(3, 4) + little_endian(1, 2) +
                      little_endian(24, 2) + std::string(24, '\0') + pixels},
    };
    for (const auto& [name, whole] : files) {
        EXPECT_EQ(outcome(name, whole), "") << name;
        for (size_t length = 0; length < whole.size() - 1; ++length)
            EXPECT_NE(outcome(name, whole.substr(0, length)), "") << name << " cut to " << length;
    }
}

TEST_F(PictureDamage, messages_for_truncated_files) {
    EXPECT_EQ(outcome("a.png", written("a.png").substr(0, 200)), "the file is damaged or cut short");
    EXPECT_EQ(outcome("a.jpg", written("a.jpg").substr(0, 400)), "the file is damaged or cut short");
    EXPECT_EQ(outcome("a.exr", written("a.exr").substr(0, 200)), "the file is damaged or cut short");
    const std::string exr = written("a.exr");
    EXPECT_EQ(outcome("a.exr", exr.substr(0, exr.size() - 8)), "Unexpected end of file");
}

TEST_F(PictureDamage, any_changed_byte_of_a_png_is_detected) {
    const std::string whole = written("a.png");
    const std::string printed = printed_by([&] {
        for (size_t at = 0; at < whole.size(); at += 3) {
            std::string damaged = whole;
            damaged[at] = char(damaged[at] ^ 0x10);
            // A bit of a chunk's name tells which program wrote it; all others count.
            EXPECT_NE(outcome("a.png", damaged), "") << at;
        }
    });
    EXPECT_EQ(printed, "");
    std::string damaged = whole;
    damaged[whole.size() / 2] = char(damaged[whole.size() / 2] ^ 1);
    EXPECT_EQ(outcome("a.png", damaged), "the file is damaged: a checksum in it is wrong");
}

TEST_F(PictureDamage, changed_bytes_neither_crash_nor_print) {
    std::mt19937 random(20240229);
    for (const std::string name : {"a.png", "a.jpg", "a.tif", "a.exr", "a.hdr"}) {
        const std::string whole = written(name);
        const std::string printed = printed_by([&] {
            for (int round = 0; round < 200; ++round) {
                std::string damaged = whole;
                const size_t reach = round % 2 == 0 ? std::min<size_t>(whole.size(), 300) : whole.size();
                for (int changes = 1 + round % 4; changes > 0; --changes)
                    damaged[random() % reach] = char(random());
                outcome(name, damaged);
            }
        });
        EXPECT_EQ(printed, "") << name;
    }
}

TEST_F(PictureDamage, junk_after_a_signature_neither_crashes_nor_prints) {
    std::mt19937 random(7);
    using namespace std::string_literals;
    for (const std::string& start : {k_png_signature, "\xff\xd8\xff"s, "II*\0"s, "MM\0*"s, "v/1\x01"s,
                                     "#?RADIANCE\n"s, "BM"s, "RIFF\x40\0\0\0WEBPVP8 "s, "P6 "s, "PF\n"s}) {
        const std::string printed = printed_by([&] {
            for (int round = 0; round < 40; ++round) {
                std::string junk = start;
                for (int i = 0; i < 200; ++i)
                    junk += char(random());
                outcome("junk.tga", junk);
            }
        });
        EXPECT_EQ(printed, "") << start;
    }
}

TEST_F(PictureDamage, a_picture_over_the_limit_is_refused_by_its_header) {
    EXPECT_EQ(outcome("wide.png", hand_made_png(16385, 1, 8, 0, "x")),
              "it is 16385x1 pixels; the limit is 16384 on a side");
    EXPECT_EQ(outcome("high.png", hand_made_png(1, 0x7fffffff, 8, 0, "x")),
              "it is 1x2147483647 pixels; the limit is 16384 on a side");
    EXPECT_EQ(outcome("none.png", hand_made_png(0, 5, 8, 0, "x")), "it has no pixels");
    std::string jpeg = written("a.jpg");
    const size_t frame = jpeg.find("\xff\xc0");
    ASSERT_NE(frame, jpeg.npos);
    jpeg.replace(frame + 5, 4, "\xff\xdc\xff\xdc");
    EXPECT_EQ(outcome("huge.jpg", jpeg), "it is 65500x65500 pixels; the limit is 16384 on a side");
    std::string exr = written("a.exr");
    const size_t window = exr.find("dataWindow");
    ASSERT_NE(window, exr.npos);
    exr.replace(window + 21 + 8, 8, "\xff\xff\xff\x7f\xff\xff\xff\x7f");
    EXPECT_EQ(outcome("huge.exr", exr), "it is 2147483648x2147483648 pixels; the limit is 16384 on a side");
    EXPECT_EQ(outcome("huge.ppm", "P6 20000 20000 255\nx"),
              "it is 20000x20000 pixels; the limit is 16384 on a side");
    EXPECT_EQ(outcome("large.pfm", "PF\n16384 16384\n-1.0\nx"), "it takes 3072 MiB; the limit is 1024");
    EXPECT_EQ(outcome("large.png", hand_made_png(16384, 16384, 16, 2, "x")),
              "it takes 3072 MiB; the limit is 1024");
}

TEST_F(PictureDamage, an_exr_attribute_larger_than_the_file_is_damage) {
    std::string exr = written("a.exr");
    const size_t size_of_window = exr.find("dataWindow") + 17;
    exr.replace(size_of_window, 4, std::string("\xff\xff\xff\x7f", 4));
    EXPECT_EQ(outcome("a.exr", exr), "the file is damaged or cut short");
}

TEST_F(PictureDamage, a_png_must_begin_with_a_sound_header_and_have_data) {
    const std::string end = png_chunk("IEND", {});
    EXPECT_EQ(outcome("a.png", k_png_signature + end), "its PNG header is not valid");
    EXPECT_EQ(outcome("a.png", k_png_signature + png_header(1, 1, 8, 0) + end), "it has no pixels");
    EXPECT_EQ(outcome("a.png", hand_made_png(1, 1, 4, 2, std::string(2, '\0'))),
              "its PNG header is not valid");
    EXPECT_EQ(outcome("a.png", hand_made_png(1, 1, 8, 5, std::string(2, '\0'))),
              "its PNG header is not valid");
    EXPECT_EQ(outcome("a.png", hand_made_png(1, 1, 8, 0, std::string(2, '\0'), png_header(1, 1, 8, 0))),
              "its PNG header is not valid");
}

} // namespace tidemark::image::picture_damage_test
