#include "base/process.hpp"
#include "media/video_input.hpp"
#include "unit/media/picture_support.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <random>

namespace tidemark::image::video_frames_test {

using testing::HasSubstr;

TEST(VideoTimes, are_parsed_from_the_output_of_ffprobe) {
    const auto times = parse_video_times("packet|pts=0|dts=-512|duration=512|flags=K_\n"
                                         "packet|pts=1024|dts=0|duration=512|flags=__\n"
                                         "packet|pts=512|dts=512|duration=512|flags=__\n"
                                         "stream|width=64|height=48|time_base=1/15360\n");
    ASSERT_TRUE(times) << times.error();
    EXPECT_EQ(times->extent, (Extent{64, 48}));
    EXPECT_EQ(times->starts, (std::vector<int64_t>{0, 512, 1024}));
    EXPECT_EQ(times->end, 1536);
    EXPECT_DOUBLE_EQ(times->duration(), 0.1);
}

TEST(VideoTimes, hidden_packets_are_skipped_and_dts_replaces_missing_pts) {
    const auto times = parse_video_times("packet|pts=-1|dts=-1|duration=1|flags=KD\n"
                                         "packet|pts=N/A|dts=3|duration=N/A|flags=K_\n"
                                         "packet|pts=N/A|dts=5|duration=N/A|flags=__\n"
                                         "packet|pts=N/A|dts=N/A|duration=N/A|flags=__\n"
                                         "stream|width=64|height=48|time_base=1/25\n");
    ASSERT_TRUE(times) << times.error();
    EXPECT_EQ(times->starts, (std::vector<int64_t>{3, 5}));
    EXPECT_EQ(times->end, 7);
    EXPECT_TRUE(times->guessed);
}

TEST(VideoTimes, the_decoders_times_replace_guessed_times) {
    VideoTimes times{{64, 48}, 1.0 / 25.0, {0, 1, 2}, 3, true};
    set_starts(times, {2, 1, 3, 3});
    EXPECT_EQ(times.starts, (std::vector<int64_t>{1, 2, 3}));
    EXPECT_EQ(times.end, 4);
    EXPECT_EQ(showinfo_start("[Parsed_showinfo_3 @ 0x5] [info] n:   7 pts:   3584 pts_time:0.2 "), 3584);
    EXPECT_EQ(showinfo_start("[Parsed_showinfo_3 @ 0x5] [info] n:   7 pts:-4 pts_time:0.2 "), -4);
    EXPECT_EQ(showinfo_start("[Parsed_showinfo_3 @ 0x5] [info] config in time_base: 1/15360"), std::nullopt);
    EXPECT_EQ(showinfo_start("[Parsed_showinfo_3 @ 0x5] [info] n:   7 pts:"), std::nullopt);
    EXPECT_EQ(showinfo_start(" pts:7"), std::nullopt);
}

TEST(VideoTimes, a_rotated_video_is_turned_upright) {
    const auto times =
        parse_video_times("packet|pts=0|dts=0|duration=1|flags=K_\n"
                          "stream|width=64|height=48|time_base=1/25\nside_data|rotation=-90\n");
    ASSERT_TRUE(times) << times.error();
    EXPECT_EQ(times->extent, (Extent{48, 64}));
}

TEST(VideoTimes, malformed_output_is_refused) {
    const std::string packet = "packet|pts=0|dts=0|duration=1|flags=K_\n";
    const auto error = [](const std::string& text) {
        const auto times = parse_video_times(text);
        return times ? "no error" : times.error();
    };
    EXPECT_EQ(error(""), "there is no video in it");
    EXPECT_EQ(error(packet), "there is no video in it");
    EXPECT_EQ(error("stream|width=64|height=48|time_base=1/25"), "there is no video in it");
    EXPECT_EQ(error(packet + "stream|width=64|height=48|time_base=0/0"), "there is no video in it");
    EXPECT_EQ(error(packet + "stream|width=64|height=-1|time_base=1/25"), "there is no video in it");
    EXPECT_EQ(error(packet + "stream|width=99999|height=4|time_base=1/25"),
              "it is 99999x4 pixels; the limit is 16384 on a side and 64 million in all");
    EXPECT_EQ(error("packet|pts=9223372036854775807|flags=K_\nstream|width=64|height=48|time_base=1/25"),
              "there is no video in it");
}

TEST(VideoTimes, a_frame_lasts_until_the_next_and_the_last_to_the_end) {
    const VideoTimes times{{1, 1}, 0.001, {100, 133, 167, 200}, 233};
    EXPECT_EQ(times.frame_at(0.0), 0u);
    EXPECT_EQ(times.frame_at(0.032), 0u);
    EXPECT_EQ(times.frame_at(1.0 / 30.0), 1u);
    EXPECT_EQ(times.frame_at(2.0 / 30.0), 2u); // 66.67 ms, which the file rounds to 67
    EXPECT_EQ(times.frame_at(0.132), 3u);
    EXPECT_EQ(times.frame_at(0.133), 0u); // and again
    EXPECT_EQ(times.frame_at(0.133 + 0.040), 1u);
    EXPECT_EQ(times.frame_at(-0.001), 3u);
    EXPECT_EQ(times.frame_at(NAN), 0u);
    EXPECT_EQ(times.frame_at(INFINITY), 0u);
    const VideoTimes coarse{{1, 1}, 1.0 / 25.0, {0, 1, 2, 3}, 4};
    for (int frame = 0; frame < 400; ++frame) {
        EXPECT_EQ(coarse.frame_at(frame / 25.0), size_t(frame % 4)) << frame;
        EXPECT_EQ(coarse.frame_at((frame + 0.9) / 25.0), size_t(frame % 4)) << frame;
    }
}

bool has_ffmpeg() {
    return output_of({"ffmpeg", "-version"}, {1 << 20}, "") &&
           output_of({"ffprobe", "-version"}, {1 << 20}, "");
}

bool has_children() {
    return ::waitpid(-1, nullptr, WNOHANG) != -1 || errno != ECHILD;
}

class Video : public PictureTest {
protected:
    void SetUp() override {
        if (!has_ffmpeg())
            GTEST_SKIP() << "there is no ffmpeg";
    }
    void TearDown() override { EXPECT_FALSE(has_children()); }

    /// 64x48 pixels; red is 4 times the frame's number, green grows to the right, blue downwards.
    fs::path make(const std::string& name, const std::vector<std::string>& encoder, int frames = 60,
                  int fps = 30) const {
        std::vector<std::string> arguments = {"ffmpeg",
                                              "-v",
                                              "error",
                                              "-y",
                                              "-f",
                                              "lavfi",
                                              "-i",
                                              "nullsrc=size=64x48:rate=" + std::to_string(fps) +
                                                  ",format=gbrp,geq=r='mod(4*N,256)':g='4*X':b='5*Y'",
                                              "-frames:v",
                                              std::to_string(frames)};
        arguments.insert(arguments.end(), encoder.begin(), encoder.end());
        arguments.push_back("file:" + in_folder(name).string());
        const Result<std::string> made = output_of(arguments, {1 << 20}, "");
        EXPECT_TRUE(made) << made.error().message;
        return in_folder(name);
    }

    static VideoFrames opened(const fs::path& path) {
        Result<VideoFrames> video = VideoFrames::open(path);
        EXPECT_TRUE(video) << video.error().message;
        return std::move(*video);
    }

    static double red(const Image& image) {
        double sum = 0.0;
        for (size_t i = 0; i < image.samples(); i += 4)
            sum += image.u8()[i];
        return sum / double(image.extent.pixels());
    }

    /// The number of the frame that is shown, by its red.
    static int frame_at(VideoFrames& video, double seconds) {
        const Result<Image> image = video.at(seconds);
        EXPECT_TRUE(image) << image.error().message;
        return image ? int(std::lround(red(*image) / 4.0)) : -1;
    }
};

const std::vector<std::string> k_lossless = {"-c:v", "ffv1", "-pix_fmt", "bgr0", "-g", "10"};

TEST_F(Video, pixels_are_exact_and_the_bottom_row_is_first) {
    VideoFrames video = opened(make("a.mkv", k_lossless));
    EXPECT_EQ(video.extent(), (Extent{64, 48}));
    EXPECT_EQ(video.frame_count(), 60);
    EXPECT_NEAR(video.duration(), 2.0, 0.0011);
    const Result<Image> image = video.at(7.0 / 30.0);
    ASSERT_TRUE(image) << image.error().message;
    ASSERT_EQ(image->extent, (Extent{64, 48}));
    ASSERT_EQ(image->channels, 4);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) {
            const uint8_t* pixel = &image->u8()[size_t(4 * (y * 64 + x))];
            ASSERT_EQ(pixel[0], 28);
            ASSERT_EQ(pixel[1], 4 * x);
            ASSERT_EQ(pixel[2], 5 * (47 - y));
            ASSERT_EQ(pixel[3], 255);
        }
}

struct Codec {
    std::string file;
    std::vector<std::string> encoder;
};

TEST_F(Video, the_frame_matches_the_time_in_every_format_and_direction) {
    const std::vector<Codec> codecs = {
        {"a.mkv", k_lossless},
        {"b_frames.mp4", {"-c:v", "libx264", "-pix_fmt", "yuv420p", "-bf", "3", "-g", "12", "-qp", "4"}},
        {"a.webm",
         {"-c:v", "libvpx", "-b:v", "2M", "-g", "25", "-auto-alt-ref", "1", "-lag-in-frames", "16"}},
        {"a.ogv", {"-c:v", "libtheora", "-q:v", "10", "-g", "12"}},
        {"a.avi", {"-c:v", "mpeg4", "-bf", "2", "-q:v", "2", "-g", "12"}},
    };
    std::mt19937 random(2);
    for (const Codec& codec : codecs) {
        VideoFrames video = opened(make(codec.file, codec.encoder));
        ASSERT_NEAR(video.duration(), 2.0, 0.04) << codec.file;
        for (int frame = 0; frame < 60; ++frame)
            ASSERT_EQ(frame_at(video, frame / 30.0), frame) << codec.file;
        for (int frame = 59; frame >= 0; frame -= 40)
            ASSERT_EQ(frame_at(video, (frame + 0.5) / 30.0), frame) << codec.file;
        const int frame = int(random() % 60);
        ASSERT_EQ(frame_at(video, (frame + 0.9) / 30.0), frame) << codec.file;
        VideoFrames alone = opened(in_folder(codec.file));
        ASSERT_EQ(frame_at(alone, 37.0 / 30.0), 37) << codec.file;
    }
}

TEST_F(Video, loops_at_its_end) {
    VideoFrames video = opened(make("a.mp4", {"-c:v", "libx264", "-pix_fmt", "yuv420p", "-qp", "4"}));
    EXPECT_EQ(frame_at(video, 2.0 + 5.0 / 30.0), 5);
    EXPECT_EQ(frame_at(video, 200.0 + 59.5 / 30.0), 59);
    EXPECT_EQ(frame_at(video, -1.0 / 30.0), 59);
}

TEST_F(Video, frames_of_uneven_length_are_shown_as_long_as_the_file_says) {
    // Frame n appears at n² hundredths of a second
    VideoFrames video = opened(make("v.mkv",
                                    {"-vf", "settb=1/100,setpts=N*N", "-fps_mode", "passthrough",
                                     "-enc_time_base", "1:100", "-c:v", "ffv1", "-pix_fmt", "bgr0"},
                                    12));
    for (int hundredths = 0; hundredths <= 121; ++hundredths)
        ASSERT_EQ(frame_at(video, hundredths / 100.0), int(std::sqrt(hundredths))) << hundredths;
}

TEST_F(Video, a_long_jump_is_exact) {
    VideoFrames video = opened(
        make("l.mp4", {"-c:v", "libx264", "-pix_fmt", "yuv420p", "-bf", "2", "-g", "30", "-qp", "4"}, 400));
    for (const int frame : {300, 10, 399, 149})
        EXPECT_EQ(frame_at(video, frame / 30.0), frame % 64) << frame;
}

TEST_F(Video, a_name_may_look_like_an_option_or_an_address) {
    const fs::path path = make("-vf.mkv", k_lossless, 3);
    fs::copy_file(path, in_folder("http:x%d 'é.mkv"));
    const fs::path before = fs::current_path();
    fs::current_path(folder());
    for (const char* name : {"-vf.mkv", "http:x%d 'é.mkv"}) {
        VideoFrames video = opened(name);
        EXPECT_EQ(frame_at(video, 1.0 / 30.0), 1);
    }
    fs::current_path(before);
}

TEST_F(Video, a_play_list_cannot_open_other_files) {
    make("a.mkv", k_lossless, 3);
    for (const auto& [name, text] :
         {std::pair<std::string, std::string>{"list.ffconcat", "ffconcat version 1.0\nfile a.mkv\n"},
          {"list.m3u8", "#EXTM3U\n#EXT-X-TARGETDURATION:1\n#EXTINF:1,\na.mkv\n#EXT-X-ENDLIST\n"}}) {
        const Result<VideoFrames> video = VideoFrames::open(put(name, text));
        ASSERT_FALSE(video) << name;
        EXPECT_THAT(video.error().message, HasSubstr("ffmpeg cannot read it as a video"));
    }
}

TEST_F(Video, errors_are_reported) {
    const auto message = [](const fs::path& path) {
        const Result<VideoFrames> video = VideoFrames::open(path);
        return video ? "no error" : video.error().message;
    };
    const auto in = [&](const std::string& name) {
        return "cannot read '" + in_folder(name).string() + "': ";
    };
    EXPECT_EQ(message(in_folder("none.mp4")), in("none.mp4") + "no such file");
    EXPECT_EQ(message(folder()), "cannot read '" + folder().string() + "': it is a directory");
    EXPECT_EQ(message("/dev/null"), "cannot read '/dev/null': it is not a regular file");
    EXPECT_EQ(message(put("t.mp4", "only text\n")),
              in("t.mp4") + "ffmpeg cannot read it as a video (Invalid data found when processing input)");
    ASSERT_TRUE(output_of({"ffmpeg", "-v", "error", "-f", "lavfi", "-i", "sine=duration=0.1", "-c:a",
                           "libvorbis", "file:" + in_folder("s.ogg").string()},
                          {1000}, ""));
    EXPECT_EQ(message(in_folder("s.ogg")), in("s.ogg") + "there is no video in it");
}

TEST_F(Video, a_damaged_or_shortened_file_gives_frames_or_a_message) {
    const std::string whole = bytes_of(make("a.mkv", k_lossless, 20));
    std::mt19937 random(4);
    for (int i = 0; i < 6; ++i) {
        std::string damaged = whole;
        if (i < 3)
            damaged.resize(whole.size() * size_t(i) / 3);
        else
            for (int changes = 0; changes < 20; ++changes)
                damaged[random() % damaged.size()] = char(random());
        Result<VideoFrames> video = VideoFrames::open(put("d.mkv", damaged));
        if (!video) {
            EXPECT_THAT(video.error().message, HasSubstr("d.mkv"));
            continue;
        }
        for (const double time : {0.3, 0.1}) {
            const Result<Image> image = video->at(time);
            if (image) {
                EXPECT_EQ(image->extent, video->extent());
            } else {
                EXPECT_THAT(image.error().message, HasSubstr("d.mkv"));
            }
        }
    }
}

TEST_F(Video, truncated_files_are_refused) {
    const std::pair<std::string, std::vector<std::string>> kinds[] = {
        {"a.mkv", k_lossless},
        {"a.webm", {"-c:v", "libvpx", "-b:v", "1M"}},
        {"late.mp4", {"-c:v", "mpeg4"}},
        {"early.mp4", {"-c:v", "mpeg4", "-movflags", "+faststart"}},
        {"a.ogv", {"-c:v", "libtheora"}},
        {"a.gif", {}},
        {"a.avi", {"-c:v", "mpeg4"}},
    };
    size_t kind = 0;
    for (const auto& [name, encoder] : kinds) {
        const std::string whole = bytes_of(make(name, encoder, 20));
        EXPECT_TRUE(VideoFrames::open(put(name, whole))) << name;
        const size_t tenths = std::array<size_t, 3>{1, 5, 9}[kind++ % 3];
        for (const size_t length : {whole.size() * tenths / 10, whole.size() - 1}) {
            EXPECT_FALSE(VideoFrames::open(put(name, whole.substr(0, length))))
                << name << " cut to " << length;
        }
    }
}

TEST_F(Video, a_busy_decoder_ends_with_its_owner) {
    const fs::path path = make("a.mkv", k_lossless, 200);
    {
        VideoFrames video = opened(path);
        EXPECT_EQ(frame_at(video, 0.0), 0);
        EXPECT_TRUE(has_children());
        VideoFrames moved = std::move(video);
        EXPECT_EQ(frame_at(moved, 1.0 / 30.0), 1);
        moved = opened(path);
        EXPECT_FALSE(has_children()) << "the one that was assigned to has ended its own";
    }
    EXPECT_FALSE(has_children());
}

class NoVideo : public PictureTest {};

TEST_F(NoVideo, without_ffmpeg_the_package_is_named) {
    const fs::path path = put("a.mp4", "x");
    const char* const before = std::getenv("PATH");
    const std::string search = before ? before : "";
    ::setenv("PATH", folder().c_str(), 1);
    const Result<VideoFrames> video = VideoFrames::open(path);
    ::setenv("PATH", search.c_str(), 1);
    ASSERT_FALSE(video);
    EXPECT_EQ(video.error().code, ErrorCode::load);
    EXPECT_EQ(video.error().message, "cannot read '" + path.string() +
                                         "': there is no program 'ffprobe' in PATH, which videos need; "
                                         "install the package ffmpeg");
    EXPECT_FALSE(has_children());
}

} // namespace tidemark::image::video_frames_test
