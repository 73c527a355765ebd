#include "host/frame_files.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace tidemark::host::output_name_test {

std::string name_of(std::string_view pattern, int frame, size_t frame_count = 1) {
    const auto name = OutputName::parse(pattern, frame_count);
    return name ? name->of_frame(frame).string() : name.error().message;
}

TEST(OutputName, name_of_a_single_picture) {
    EXPECT_EQ(name_of("out/a.png", 7), "out/a.png");
    EXPECT_EQ(OutputName::parse("out/a.png", 1)->pattern(), "out/a.png");
    EXPECT_FALSE(OutputName::parse("out/a.png", 1)->standard_output());
}

TEST(OutputName, printf_patterns_insert_the_number) {
    EXPECT_EQ(name_of("a.%04d.png", 7, 2), "a.0007.png");
    EXPECT_EQ(name_of("a.%4d.png", 7), "a.0007.png"); // zeros instead of blanks
    EXPECT_EQ(name_of("a.%d.png", 7), "a.7.png");
    EXPECT_EQ(name_of("a.%d.png", 0), "a.0.png");
    EXPECT_EQ(name_of("a.%02d.png", 123456), "a.123456.png");
    EXPECT_EQ(name_of("%020d.png", 100'000'000), "00000000000100000000.png");
}

TEST(OutputName, a_video_has_one_name_for_all_frames) {
    for (const char* name : {"out/a.mp4", "a.webm", "50%.gif"}) {
        EXPECT_EQ(name_of(name, 7, 300), name);
        EXPECT_TRUE(OutputName::parse(name, 300)->video());
    }
    EXPECT_FALSE(OutputName::parse("a.png", 1)->video());
    EXPECT_EQ(name_of("", 0), "-o : give the name of a file, or - for standard output");
}

TEST(OutputName, six_faces_of_a_cube) {
    EXPECT_EQ(OutputName::parse("sky_{}.%02d.png", 1)->of_face(7, 0).path(), "sky_px.07.png");
    EXPECT_EQ(OutputName::parse("{}.exr", 1)->of_face(0, 5).path(), "nz.exr");
    EXPECT_TRUE(OutputName::parse("sky_{}.png", 1)->six_faces());
    EXPECT_FALSE(OutputName::parse("sky_px.png", 1)->six_faces());
    EXPECT_FALSE(OutputName::parse("sky_{}.mp4", 1)->six_faces());
}

std::string of_scene(const std::filesystem::path& scene, size_t frame_count = 1) {
    const OutputName name = OutputName::of_scene(scene, frame_count);
    EXPECT_FALSE(name.six_faces() || name.video() || name.standard_output());
    return name.of_frame(7).string();
}

TEST(OutputName, default_name_of_a_scene) {
    EXPECT_EQ(of_scene("shaders/wave.glsl"), "wave.png");
    EXPECT_EQ(of_scene("wave.glsl", 2), "wave.0007.png");
    EXPECT_EQ(of_scene("folder/"), "folder.png");
    const std::string here = std::filesystem::current_path().stem().string();
    EXPECT_EQ(of_scene("."), here + ".png");
    EXPECT_EQ(of_scene("./"), here + ".png");
}

TEST(OutputName, default_names_contain_no_patterns) {
    for (const std::string name : {"shot#1", "####", "50%", "%04d", "%s%n", "{}", "a{}#%d", "x.mp4", "-"}) {
        EXPECT_EQ(of_scene(name + ".glsl"), name + ".png");
        EXPECT_EQ(of_scene(name + ".glsl", 3), name + ".0007.png");
    }
}

TEST(OutputName, default_names_are_shortened_to_the_limit) {
    const std::string name(245, 'n'), wide(250, 'n');
    EXPECT_EQ(of_scene(name + ".glsl"), name + ".png");
    EXPECT_EQ(of_scene(name + ".glsl", 2), name + ".0007.png");
    EXPECT_EQ(of_scene(wide + ".glsl", 2), wide.substr(0, 246) + ".0007.png");
    EXPECT_EQ(of_scene(wide.substr(0, 245) + "é.glsl", 2), wide.substr(0, 245) + ".0007.png");
}

TEST(OutputName, links_are_followed_only_if_named_by_the_user) {
    const TemporaryFolder folder, elsewhere;
    const std::string root = folder.path().string();
    std::filesystem::create_directory_symlink(elsewhere.path(), folder / "out");
    for (const char* link : {"a.png", "a.0007.png", "sky_px.png"})
        std::filesystem::create_symlink("behind.png", elsewhere / link);
    const auto goes = [&](const std::string& pattern) {
        return OutputName::parse(root + pattern, 1)->of_frame(7).place().has_value();
    };
    EXPECT_TRUE(goes("/out/a.png"));
    EXPECT_TRUE(goes("/out/b.%04d.png"));
    EXPECT_FALSE(goes("/out/a.%04d.png"));
    EXPECT_FALSE(OutputName::parse(root + "/out/sky_{}.png", 1)->of_face(0, 0).place());
    EXPECT_TRUE(OutputName::parse(root + "/out/sky_{}.png", 1)->of_face(0, 1).place());
    std::filesystem::create_directory_symlink(elsewhere.path(), folder / "out7");
    EXPECT_FALSE(goes("/out%d/b.png"));
}

TEST(OutputName, hash_patterns_insert_the_number) {
    EXPECT_EQ(name_of("a.####.png", 7, 2), "a.0007.png");
    EXPECT_EQ(name_of("a##.exr", 7), "a07.exr");
    EXPECT_EQ(name_of("##/a.png", 12), "12/a.png");
}

TEST(OutputName, a_single_hash_is_a_character) {
    EXPECT_EQ(name_of("take#2.png", 7), "take#2.png");
    EXPECT_EQ(name_of("take#2_###.png", 7, 2), "take#2_007.png");
    EXPECT_EQ(name_of("#.png", 7, 2),
              "-o #.png: 2 frames need a frame number in the name, as in wave.%04d.png");
}

TEST(OutputName, percent_signs) {
    EXPECT_EQ(name_of("50%%.png", 7), "50%.png");
    EXPECT_EQ(name_of("%%%d%%.png", 7), "%7%.png");
    EXPECT_EQ(name_of("%%d.png", 7), "%d.png");
}

TEST(OutputName, standard_output) {
    const auto name = OutputName::parse("-", 100);
    ASSERT_TRUE(name);
    EXPECT_TRUE(name->standard_output());
}

TEST(OutputName, two_patterns_are_refused) {
    for (const std::string pattern : {"%d/%d.png", "##.##.png", "%d##.png", "##%04d.png"})
        EXPECT_EQ(name_of(pattern, 1), "-o " + pattern + ": it has two frame numbers; one is enough");
}

TEST(OutputName, unsupported_formats) {
    for (const std::string pattern : {"100%.png", "%x.png", "%.4d.png", "%-4d.png", "%04.png", "%021d.png",
                                      "%99999999999999999999d.png", "% d.png"})
        EXPECT_EQ(name_of(pattern, 1), "-o " + pattern + ": write the frame number as %04d or ####");
}

TEST(OutputName, several_frames_need_a_pattern) {
    EXPECT_EQ(name_of("a.png", 1, 30),
              "-o a.png: 30 frames need a frame number in the name, as in wave.%04d.png");
    EXPECT_EQ(name_of("50%%.png", 1, 2),
              "-o 50%%.png: 2 frames need a frame number in the name, as in wave.%04d.png");
}

TEST(OutputName, unknown_formats) {
    for (const std::string pattern : {"a.bmp", "a", "a.%04d", "a.png.####"}) {
        const auto name = OutputName::parse(pattern, 1);
        ASSERT_FALSE(name) << pattern;
        EXPECT_EQ(name.error().code, ErrorCode::usage);
        EXPECT_EQ(name.error().message,
                  "cannot tell the format of '" + pattern +
                      "': its name must end in .png, .jpg, .jpeg, .tif, .tiff, .exr or .hdr for pictures, in "
                      ".mp4, .mkv, .webm, .mov, .gif or .webp for a video, or in .wav for the sound alone");
    }
}

} // namespace tidemark::host::output_name_test
