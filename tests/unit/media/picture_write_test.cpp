// How pictures are written: names and depths, whole or not at all, metadata, the same bytes every time.
#include "media/picture_file.hpp"
#include "picture_support.hpp"
#include "support/limited_child.hpp"

#include <chrono>
#include <cstring>
#include <map>
#include <thread>

namespace tidemark::image::picture_write_test {

using PictureWrite = PictureTest;

const char* const k_all_names[] = {"a.png", "a.jpg", "a.tif", "a.exr", "a.hdr"};

PictureFormat natural(const fs::path& path) {
    return {natural_depth(path), {}};
}

std::string message_of(const Result<void>& result) {
    return result ? "" : result.error().message;
}

/// The text chunks of a PNG, by keyword.
std::map<std::string, std::string> png_texts(const std::string& file) {
    std::map<std::string, std::string> texts;
    for (size_t at = 8; at + 12 <= file.size();) {
        size_t length = 0;
        for (size_t i = 0; i < 4; ++i)
            length = length << 8 | uint8_t(file[at + i]);
        const std::string data = file.substr(at + 8, length);
        if (file.substr(at + 4, 4) == "tEXt")
            texts[data.c_str()] = data.substr(std::strlen(data.c_str()) + 1);
        at += 12 + length;
    }
    return texts;
}

/// An EXR string attribute, from the bytes of the header; "?" when there is none.
std::string exr_text(const std::string& file, const std::string& name) {
    const std::string start = name + '\0' + "string" + '\0';
    const size_t at = file.find(start);
    if (at == file.npos)
        return "?";
    const size_t size = at + start.size();
    return file.substr(size + 4, uint8_t(file[size]) | size_t(uint8_t(file[size + 1])) << 8);
}

TEST_F(PictureWrite, the_extension_selects_the_format) {
    for (const char* name :
         {"a.png", "a.jpg", "a.jpeg", "a.tif", "a.tiff", "a.exr", "a.hdr", "a.b.PNG", "d/a.Exr"})
        EXPECT_TRUE(check_picture_name(name)) << name;
    for (const std::string name : {"a.gif", "a", "png", ".png", "", "a.png.txt", "a.png/"}) {
        const Result<void> checked = check_picture_name(name);
        ASSERT_FALSE(checked) << name;
        EXPECT_EQ(checked.error().code, ErrorCode::usage);
        EXPECT_EQ(checked.error().message,
                  "cannot tell the picture format of '" + name +
                      "': its name must end in .png, .jpg, .jpeg, .tif, .tiff, .exr or .hdr");
    }
    EXPECT_EQ(
        message_of(write_picture("a.gif", patterned_u8({2, 2}, 3))),
        "cannot tell the picture format of 'a.gif': its name must end in .png, .jpg, .jpeg, .tif, .tiff, "
        ".exr or .hdr");
}

TEST_F(PictureWrite, unsupported_depths_are_refused) {
    const Result<void> checked = check_picture_format("a.png", SampleDepth::half);
    ASSERT_FALSE(checked);
    EXPECT_EQ(checked.error().code, ErrorCode::usage);
    EXPECT_EQ(checked.error().message, "'a.png' cannot hold half samples: .png holds 8-bit, 16-bit");
    EXPECT_EQ(message_of(check_picture_format("a.JPG", SampleDepth::u16)),
              "'a.JPG' cannot hold 16-bit samples: .jpg holds 8-bit");
    EXPECT_EQ(message_of(check_picture_format("a.exr", SampleDepth::u8)),
              "'a.exr' cannot hold 8-bit samples: .exr holds half, float");
    EXPECT_EQ(message_of(check_picture_format("a.tif", SampleDepth::half)),
              "'a.tif' cannot hold half samples: .tif holds 8-bit, 16-bit, float");
    EXPECT_EQ(message_of(check_picture_format("a.hdr", SampleDepth::half)),
              "'a.hdr' cannot hold half samples: .hdr holds float");
    EXPECT_FALSE(check_picture_format("a.bmp", SampleDepth::u8));
    for (const char* name : k_all_names)
        EXPECT_TRUE(check_picture_format(name, natural_depth(name)));
    EXPECT_EQ(message_of(write_picture(in_folder("a.png"), patterned_u8({2, 2}, 3), {SampleDepth::f32, {}})),
              "'" + in_folder("a.png").string() + "' cannot hold float samples: .png holds 8-bit, 16-bit");
    EXPECT_EQ(files(), 0u);
}

TEST_F(PictureWrite, a_picture_without_pixels_or_over_the_limit_is_refused) {
    const Result<void> empty = write_picture(in_folder("a.png"), Image());
    ASSERT_FALSE(empty);
    EXPECT_EQ(empty.error().code, ErrorCode::write);
    EXPECT_EQ(empty.error().message,
              "cannot write '" + in_folder("a.png").string() + "': the picture has no pixels");
    EXPECT_EQ(message_of(write_picture(in_folder("a.png"), Image({16385, 1}, 1, SampleType::u8))),
              "cannot write '" + in_folder("a.png").string() +
                  "': it is 16385x1 pixels; the limit is 16384 on a side");
    EXPECT_EQ(files(), 0u);
}

TEST_F(PictureWrite, an_unwritable_place_gives_the_reason) {
    put("file", "x");
    for (const char* name : k_all_names) {
        const fs::path missing = in_folder("missing") / name, in_file = in_folder("file") / name;
        const Result<void> written = write_picture(missing, patterned_u8({4, 4}, 3), natural(name));
        ASSERT_FALSE(written);
        EXPECT_EQ(written.error().code, ErrorCode::write);
        EXPECT_EQ(written.error().message,
                  "cannot write '" + missing.string() + "': No such file or directory");
        EXPECT_EQ(message_of(write_picture(in_file, patterned_u8({4, 4}, 3), natural(name))),
                  "cannot write '" + in_file.string() + "': Not a directory");
    }
    fs::create_directory(in_folder("d.png"));
    EXPECT_EQ(message_of(write_picture(in_folder("d.png"), patterned_u8({4, 4}, 3))),
              "cannot write '" + in_folder("d.png").string() + "': Is a directory");
    EXPECT_EQ(files(), 2u);
}

TEST_F(PictureWrite, a_full_disk_leaves_no_new_file_and_keeps_the_old) {
    for (const char* name : k_all_names)
        ASSERT_TRUE(write_picture(in_folder(name), patterned_u8({4, 4}, 3), natural(name)));
    for (const std::string prefix : {"", "new-"})
        for (const char* name : k_all_names) {
            const fs::path path = in_folder(prefix + name);
            const std::string before = bytes_of(path);
            const std::string message = in_limited_child(1000, [&] {
                return message_of(write_picture(path, patterned_u8({200, 100}, 3), natural(name)));
            });
            EXPECT_EQ(message, "cannot write '" + path.string() + "': File too large");
            EXPECT_EQ(bytes_of(path), before);
        }
    EXPECT_EQ(files(), std::size(k_all_names));
}

TEST_F(PictureWrite, metadata_are_stored_as_text) {
    const std::string long_text(70000, 'x');
    const PictureFormat bytes{SampleDepth::u8,
                              {{"scene", "shaders/caf\xc3\xa9.glsl"}, {"time", "1.5"}, {"log", long_text}}};
    ASSERT_TRUE(write_picture(in_folder("a.png"), patterned_u8({4, 4}, 3), bytes));
    EXPECT_EQ(png_texts(bytes_of(in_folder("a.png"))),
              (std::map<std::string, std::string>{{"Software", "Tidemark"},
                                                  {"tidemark:log", long_text},
                                                  {"tidemark:scene", "shaders/caf\xc3\xa9.glsl"},
                                                  {"tidemark:time", "1.5"}}));
    // A name that formats have a meaning for is text all the same
    const PictureFormat floats{SampleDepth::f32,
                               {{"compression", "none"}, {"note", "two\nlines"}, {"Orientation", "6"}}};
    ASSERT_TRUE(write_picture(in_folder("a.exr"), patterned_u8({4, 4}, 3), floats));
    const std::string exr = bytes_of(in_folder("a.exr"));
    EXPECT_EQ(exr_text(exr, "tidemark:compression"), "none");
    EXPECT_EQ(exr_text(exr, "tidemark:note"), "two\nlines");
    EXPECT_EQ(exr_text(exr, "tidemark:Orientation"), "6");
    EXPECT_EQ(exr_text(exr, "tidemark:nothing"), "?");
    const PictureFormat short_texts{SampleDepth::u8, {{"scene", "a.glsl"}, {"time", "1.5"}}};
    for (const char* name : {"a.tif", "a.jpg"}) {
        ASSERT_TRUE(write_picture(in_folder(name), patterned_u8({4, 4}, 3), short_texts));
        EXPECT_NE(bytes_of(in_folder(name)).find("tidemark:scene=a.glsl\ntidemark:time=1.5\n"),
                  std::string::npos);
    }
    for (const char* name : {"a.tif", "a.jpg", "a.png", "a.exr"}) // and the pictures are still pictures
        EXPECT_TRUE(read_picture(in_folder(name))) << name;
}

TEST_F(PictureWrite, metadata_of_any_length_is_written) {
    for (const char* name : k_all_names)
        for (const size_t length : {0u, 65000u, 65520u, 65536u, 200000u}) {
            const PictureFormat format{natural_depth(name), {{"log", std::string(length, 'x')}}};
            EXPECT_EQ(message_of(write_picture(in_folder(name), patterned_u8({4, 4}, 3), format)), "");
            EXPECT_TRUE(read_picture(in_folder(name))) << name << ' ' << length;
        }
}

TEST_F(PictureWrite, bytes_contain_no_date_or_machine_and_are_repeatable) {
    std::map<std::string, std::string> first;
    const Image image = patterned_u8({40, 30}, 4);
    for (const char* name : k_all_names) {
        ASSERT_TRUE(write_picture(in_folder(name), image, natural(name)));
        first[name] = bytes_of(in_folder(name));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1100)); // dates in pictures count seconds
    for (const char* name : k_all_names) {
        ASSERT_TRUE(write_picture(in_folder(name), image, natural(name)));
        EXPECT_EQ(bytes_of(in_folder(name)), first[name]) << name;
        EXPECT_EQ(first[name].find("DateTime"), std::string::npos) << name;
        EXPECT_EQ(first[name].find("capDate"), std::string::npos) << name;
        EXPECT_EQ(first[name].find("OpenImageIO"), std::string::npos) << name;
    }
}

TEST_F(PictureWrite, a_png_has_no_chunk_that_changes_its_colours) {
    ASSERT_TRUE(write_picture(in_folder("a.png"), patterned_u8({4, 4}, 4)));
    const std::string file = bytes_of(in_folder("a.png"));
    for (const char* chunk : {"gAMA", "cHRM", "sRGB", "iCCP", "tIME"})
        EXPECT_EQ(file.find(chunk), file.npos) << chunk;
}

TEST_F(PictureWrite, writing_prints_nothing) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    for (const char* name : k_all_names)
        EXPECT_TRUE(write_picture(in_folder(name), patterned_f32({9, 9}, 4), natural(name)));
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(PictureWrite, many_threads_write_and_read_at_once) {
    constexpr int k_threads = 6, k_rounds = 8;
    std::vector<std::thread> threads;
    std::vector<int> wrong(k_threads, 0);
    for (int id = 0; id < k_threads; ++id)
        threads.emplace_back([&, id] {
            const auto index = size_t(id);
            const Image image = flipped(patterned_f32({60 + id, 40}, 1 + id % 4));
            for (int round = 0; round < k_rounds; ++round) {
                const char* extension = round % 2 == 0 ? ".exr" : ".tif";
                const fs::path path = in_folder(std::to_string(id) + "-" + std::to_string(round) + extension);
                const Result<void> written =
                    write_picture(path, image, {SampleDepth::f32, {{"id", path.string()}}});
                const Result<Image> read = read_picture(path);
                wrong[index] += !written || !read || *read != image;
            }
        });
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(wrong, std::vector<int>(k_threads, 0));
    EXPECT_EQ(files(), size_t{k_threads * k_rounds});
}

} // namespace tidemark::image::picture_write_test
