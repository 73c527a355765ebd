// A note is found after the video that it was written for, and after no other bytes.
#include "media/video_output.hpp"

#include <gtest/gtest.h>

namespace tidemark::image::video_note_test {

TEST(VideoNote, is_read_back) {
    for (const std::string note : {"", "frame=1", "a\nb\0c"})
        EXPECT_EQ(note_at_end("video" + note_box("video", note)), note);
}

TEST(VideoNote, a_change_of_any_byte_is_detected) {
    const std::string file = "video" + note_box("video", "note");
    for (size_t i = 0; i < file.size(); ++i) {
        std::string damaged = file;
        damaged[i] = char(damaged[i] ^ 1);
        EXPECT_FALSE(note_at_end(damaged)) << i;
        EXPECT_FALSE(note_at_end(file.substr(0, i))) << i;
    }
    EXPECT_FALSE(note_at_end(file + "x"));
}

} // namespace tidemark::image::video_note_test
