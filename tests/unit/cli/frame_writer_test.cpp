#include "host/frame_files.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace tidemark::host::frame_writer_test {

namespace fs = std::filesystem;

/// Every frame of a grey of its own.
FrameFile frame_file(const fs::path& path, int frame, Extent extent = {8, 8}) {
    image::Image image(extent, 3, image::SampleType::u8);
    for (uint8_t& sample : image.u8())
        sample = uint8_t(frame);
    return {frame, path, std::move(image), {}};
}

/// Takes an encoder a while: noise that no filter foretells.
FrameFile slow_file(const fs::path& path, int frame) {
    FrameFile file = frame_file(path, frame, {1500, 1500});
    uint32_t state = 1;
    for (uint8_t& sample : file.image.u8())
        sample = uint8_t((state = state * 1664525u + 1013904223u) >> 24);
    return file;
}

std::string name_of(int frame) {
    return std::to_string(frame) + ".png";
}

size_t files_in(const TemporaryFolder& folder) {
    size_t files = 0;
    for (const auto& entry : fs::directory_iterator(folder.path()))
        files += entry.path().filename().string().front() != '.'; // not those under construction
    return files;
}

TEST(FrameWriter, writes_every_frame_under_its_name) {
    const TemporaryFolder folder;
    FrameWriter writer(2);
    for (int frame = 0; frame < 20; ++frame)
        EXPECT_TRUE(writer.push(frame_file(folder / name_of(frame), frame)));
    EXPECT_TRUE(writer.finish());
    EXPECT_EQ(files_in(folder), 20u);
    for (int frame = 0; frame < 20; ++frame) {
        const auto picture = image::read_picture(folder / name_of(frame));
        ASSERT_TRUE(picture);
        EXPECT_EQ(picture->u8()[0], frame);
    }
}

TEST(FrameWriter, finish_without_frames_succeeds) {
    FrameWriter writer(2);
    EXPECT_TRUE(writer.finish());
    EXPECT_TRUE(writer.finish()) << "and again";
}

TEST(FrameWriter, destruction_waits_for_all_frames) {
    const TemporaryFolder folder;
    {
        FrameWriter writer(1);
        EXPECT_TRUE(writer.push(slow_file(folder / "a.png", 0)));
        EXPECT_TRUE(writer.push(frame_file(folder / "b.png", 1)));
    }
    EXPECT_EQ(files_in(folder), 2u);
}

TEST(FrameWriter, the_queue_is_bounded) {
    const TemporaryFolder folder;
    FrameWriter writer(1);
    constexpr int k_in_hand = 1, k_waiting = 2;
    for (int frame = 0; frame < 8; ++frame) {
        EXPECT_TRUE(writer.push(slow_file(folder / name_of(frame), frame)));
        EXPECT_GE(int(files_in(folder)), frame + 1 - k_in_hand - k_waiting);
    }
    EXPECT_TRUE(writer.finish());
}

TEST(FrameWriter, a_failure_stops_push_and_is_reported_once) {
    const TemporaryFolder folder;
    FrameWriter writer(2);
    const fs::path missing = folder / "no/a.png";
    int pushed = 0;
    while (pushed < 1000 && writer.push(frame_file(missing, pushed)))
        ++pushed;
    EXPECT_LT(pushed, 1000);
    EXPECT_FALSE(writer.push(frame_file(folder / "late.png", 2000)));
    const auto finished = writer.finish();
    ASSERT_FALSE(finished);
    EXPECT_EQ(finished.error().code, ErrorCode::write);
    EXPECT_EQ(finished.error().message, "cannot write '" + missing.string() + "': No such file or directory");
    EXPECT_EQ(files_in(folder), 0u);
}

TEST(FrameWriter, the_error_is_that_of_the_earliest_frame) {
    const TemporaryFolder folder;
    FrameWriter writer(1);
    // While the worker is busy with the first, the others wait in the queue.
    EXPECT_TRUE(writer.push(slow_file(folder / "a.png", 9)));
    EXPECT_TRUE(writer.push(frame_file(folder / "no/7.png", 7)));
    EXPECT_TRUE(writer.push(frame_file(folder / "no/3.png", 3)));
    const auto finished = writer.finish();
    ASSERT_FALSE(finished);
    EXPECT_EQ(finished.error().message,
              "cannot write '" + (folder / "no/3.png").string() + "': No such file or directory");
}

} // namespace tidemark::host::frame_writer_test
