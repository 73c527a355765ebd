#include "media/picture_check.hpp"
#include "picture_support.hpp"

namespace tidemark::image::file_check_test {

using namespace std::string_literals;

std::string refusal(FileFormat format, const std::string& file) {
    const auto checked = checked_file(format, file);
    return checked ? "" : checked.error();
}

TEST(FileCheck, formats_are_detected_by_their_first_bytes) {
    EXPECT_EQ(format_of(k_png_signature, "a"), FileFormat::png);
    EXPECT_EQ(format_of("\xff\xd8\xff\xe0"s, "a.png"), FileFormat::jpeg);
    EXPECT_EQ(format_of("II*\0"s, "a"), FileFormat::tiff);
    EXPECT_EQ(format_of("MM\0*"s, "a"), FileFormat::tiff);
    EXPECT_EQ(format_of("v/1\x01"s, "a"), FileFormat::exr);
    EXPECT_EQ(format_of("#?RADIANCE\n", "a"), FileFormat::hdr);
    EXPECT_EQ(format_of("#?RGBE\n", "a"), FileFormat::hdr);
    EXPECT_EQ(format_of("BM....", "a"), FileFormat::bmp);
    EXPECT_EQ(format_of("RIFF....WEBP", "a"), FileFormat::webp);
    EXPECT_EQ(format_of("P6\n", "a"), FileFormat::pnm);
    EXPECT_EQ(format_of("PF ", "a"), FileFormat::pnm);
    EXPECT_EQ(format_of("anything", "a.tga"), FileFormat::tga);
    EXPECT_EQ(format_of("anything", "a.Tga"), FileFormat::tga);
    for (const std::string& other : {""s, "P"s, "P6"s, "P7\n"s, "PNG"s, "\xff\xd8"s, "RIFF....WAVE"s, "II*"s})
        EXPECT_EQ(format_of(other, "a.png"), std::nullopt) << other;
}

TEST(FileCheck, a_png_keeps_the_chunks_that_define_samples) {
    const std::string sober = hand_made_png(1, 1, 8, 0, "\0x"s, png_chunk("tRNS", "\0\1"s));
    const std::string chatty =
        hand_made_png(1, 1, 8, 0, "\0x"s,
                      png_chunk("gAMA", "1234") + png_chunk("tRNS", "\0\1"s) + png_chunk("zTXt", "")) +
        "and more behind the end";
    EXPECT_EQ(checked_file(FileFormat::png, chatty), sober);
    EXPECT_EQ(checked_file(FileFormat::png, sober), sober);
}

TEST(FileCheck, a_png_with_an_unknown_critical_chunk_is_refused) {
    EXPECT_EQ(refusal(FileFormat::png, hand_made_png(1, 1, 8, 0, "\0x"s, png_chunk("QQQQ", "?"))),
              "it has an unknown kind of PNG chunk");
    const std::string palette = png_chunk("PLTE", "abc");
    EXPECT_EQ(refusal(FileFormat::png, hand_made_png(1, 1, 8, 3, "\0\0"s, palette + palette)),
              "it has more than one palette");
}

TEST(FileCheck, a_jpeg_is_checked_marker_by_marker) {
    const std::string start = "\xff\xd8"s, frame = "\xff\xc0\0\x0b\x08\0\x10\0\x20\1\1\x11\0"s,
                      scan = "\xff\xda\0\x08\1\1\0\0\x3f\0"s, data = "ab\xff\0cd\xff\xd0xy"s,
                      end = "\xff\xd9"s;
    EXPECT_EQ(refusal(FileFormat::jpeg, start + frame + scan + data + end), "");
    EXPECT_EQ(refusal(FileFormat::jpeg, start + frame + scan + data + "\xff" + end + "trailing"), "");
    EXPECT_EQ(refusal(FileFormat::jpeg, start + frame + scan + data), "the file is damaged or cut short");
    // The end of a preview inside a segment is not the end of the picture
    const std::string preview = "\xff\xe1\0\x06\xff\xd8\xff\xd9"s;
    EXPECT_EQ(refusal(FileFormat::jpeg, start + preview + frame + scan + data),
              "the file is damaged or cut short");
    EXPECT_EQ(refusal(FileFormat::jpeg, start + preview + frame + scan + data + end), "");
}

TEST(FileCheck, sizes_have_a_limit) {
    EXPECT_EQ(size_objection(1, 16384), std::nullopt);
    EXPECT_EQ(size_objection(0, 5), "it has no pixels");
    EXPECT_EQ(size_objection(5, -1), "it has no pixels");
    EXPECT_EQ(size_objection(16385, 2), "it is 16385x2 pixels; the limit is 16384 on a side");
}

} // namespace tidemark::image::file_check_test
