// resolve: the frame options as they were typed, checked.
#include "host/requests.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace tidemark::host::options_test {

using testing::ElementsAre;

std::string refusal(const FrameOptions& options) {
    const auto request = resolve(options);
    if (request)
        return "it was taken";
    EXPECT_EQ(request.error().code, ErrorCode::usage);
    return request.error().message;
}

TEST(Resolve, defaults) {
    const auto request = resolve(FrameOptions());
    ASSERT_TRUE(request);
    EXPECT_EQ(request->state.extent, (Extent{640, 360}));
    EXPECT_EQ(request->state.fps, 60);
    EXPECT_THAT(request->frames, ElementsAre(0));
    EXPECT_FALSE(request->state.time);
    EXPECT_EQ(request->state.mouse.uniform(), glm::vec4(0));
    EXPECT_EQ(request->state.date, render::Date{});
}

TEST(Resolve, all_options_set_the_state) {
    FrameOptions options;
    options.size = "8x4";
    options.numbers["--fps"] = 29.97;
    options.numbers["--bpm"] = 90;
    options.frames = "1-2";
    options.mouse = "3,4";
    options.date = "2020-02-03";
    options.camera = "10,20,30";
    const auto request = resolve(options);
    ASSERT_TRUE(request);
    EXPECT_EQ(request->state.extent, (Extent{8, 4}));
    EXPECT_EQ(request->state.fps, 29.97);
    EXPECT_EQ(request->state.bpm, 90);
    EXPECT_THAT(request->frames, ElementsAre(1, 2));
    EXPECT_EQ(request->state.mouse.uniform(), glm::vec4(3, 4, -3, -4));
    EXPECT_EQ(request->state.date, (render::Date{2020, 1, 3, 0}));
    EXPECT_EQ(request->state.camera.distance, 30);
}

TEST(Resolve, resolves_one_frame_or_one_time) {
    FrameOptions options;
    options.frame = 7;
    EXPECT_THAT(resolve(options)->frames, ElementsAre(7));
    options.frame.reset();
    options.time = -1.5;
    EXPECT_EQ(resolve(options)->state.time, -1.5);
    EXPECT_THAT(resolve(options)->frames, ElementsAre(0));
    options.time = 2;
    EXPECT_THAT(resolve(options)->frames, ElementsAre(120));
}

TEST(Resolve, invalid_rates_are_refused) {
    FrameOptions options;
    for (const auto& [fps, text] : {std::pair(0.0, "0"),
                                    {-30.0, "-30"},
                                    {std::numeric_limits<double>::infinity(), "inf"},
                                    {std::numeric_limits<double>::quiet_NaN(), "nan"}}) {
        options.numbers["--fps"] = fps;
        EXPECT_EQ(refusal(options), std::string("--fps ") + text + ": give a number above 0");
    }
    options.numbers = {{"--bpm", 0}};
    EXPECT_EQ(refusal(options), "--bpm 0: give a number above 0");
}

TEST(Resolve, invalid_frames_and_times_are_refused) {
    FrameOptions options;
    options.frame = -1;
    EXPECT_EQ(refusal(options), "--frame -1: frames count from 0 to 100000000");
    options.frame.reset();
    options.time = std::numeric_limits<double>::infinity();
    EXPECT_EQ(refusal(options), "--time: give a finite number of seconds");
}

TEST(Resolve, the_option_at_fault_is_named) {
    FrameOptions options;
    options.size = "0x5";
    EXPECT_EQ(refusal(options), "--size 0x5: give WIDTHxHEIGHT in pixels, both at least 1, as in 640x360");
    options = {};
    options.frames = "1-";
    EXPECT_EQ(refusal(options),
              "--frames 1-: give frames from 0 to 100000000 as in 7, 0-29, 0-120x10 or 0-9,20-29");
    options = {};
    options.mouse = "1";
    EXPECT_EQ(refusal(options), "--mouse 1: give x,y for a click or x,y,from_x,from_y for a drag, in pixels "
                                "from the bottom left, and ,down while the button is pressed");
    options = {};
    options.date = "today";
    EXPECT_EQ(refusal(options), "--date today: give a date as in 2024-12-31 or 2024-12-31T23:59:58.5");
    options = {};
    options.camera = "1,2";
    EXPECT_EQ(refusal(options), "--camera 1,2: give azimuth,elevation,distance as in 30,20,10 (degrees, "
                                "degrees, a distance above 0), and after them x,y,z if the view was panned");
}

} // namespace tidemark::host::options_test
