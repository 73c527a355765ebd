// The files that a window makes: recordings of the user's input, and pictures.
#include "support/temporary_folder.hpp"
#include "window/recorder.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace tidemark::window::recorder_test {

using namespace host;

namespace fs = std::filesystem;
using Mode = Recorder::Mode;

const render::OrbitCamera k_camera;

ControlEvent set(const char* name, double value) {
    return KnobTurned{{name, {1, {value}}}};
}

InputScript script_of(const char* text) {
    return parse_input_script(text, "script").value();
}

Controls turned_to(double value) {
    Controls controls(k_camera);
    controls.handle(set("height", value), 100);
    return controls;
}

double height_in(const render::FrameState& state) {
    return state.knobs.empty() ? -1 : state.knobs.front().value.numbers[0];
}

KeptPicture picture_of(int frame) {
    return {frame, image::Image({2, 2}, 4, image::SampleType::u8), {}};
}

TEST(Recorder, is_live_without_files) {
    Recorder recorder({}, std::nullopt, k_camera);
    EXPECT_EQ(recorder.mode(), Mode::live);
    recorder.note(3, set("height", 1)); // is not kept
    recorder.go_back(0);
    EXPECT_FALSE(recorder.turns_knobs());
    render::FrameState state;
    recorder.fill(state, turned_to(2));
    EXPECT_EQ(height_in(state), 2) << "from the user";
    EXPECT_TRUE(recorder.finish({}));
}

TEST(Recorder, records_the_users_input) {
    const TemporaryFolder folder;
    const fs::path file = folder / "input.txt";
    Recorder recorder(OutputPath::typed(file), std::nullopt, k_camera);
    EXPECT_EQ(recorder.mode(), Mode::recording);
    recorder.note(2, set("height", 5));
    EXPECT_TRUE(recorder.turns_knobs());
    render::FrameState state{.frame = 1};
    recorder.fill(state, turned_to(9));
    EXPECT_EQ(height_in(state), -1) << "the recording drives the scene: not set before frame 2";
    state = {.frame = 2};
    recorder.fill(state, turned_to(9));
    EXPECT_EQ(height_in(state), 5);
    ASSERT_TRUE(recorder.finish({}));
    EXPECT_EQ(load_input_script(file).value(), script_of("2 set height=5"));
}

TEST(Recorder, going_back_discards_later_input) {
    const TemporaryFolder folder;
    const fs::path file = folder / "input.txt";
    Recorder recorder(OutputPath::typed(file), std::nullopt, k_camera);
    recorder.note(2, set("height", 5));
    recorder.note(8, set("height", 6));
    recorder.go_back(4);
    recorder.note(4, set("height", 7));
    ASSERT_TRUE(recorder.finish({}));
    EXPECT_EQ(load_input_script(file).value(), script_of("2 set height=5\n4 set height=7"));
}

TEST(Recorder, does_not_replace_a_file_of_the_scene) {
    const TemporaryFolder folder;
    const fs::path file = folder / "scene.glsl";
    save_in_place(file);
    Recorder recorder(OutputPath::typed(file), std::nullopt, k_camera);
    const auto finished = recorder.finish({file});
    ASSERT_FALSE(finished);
    EXPECT_EQ(finished.error().code, ErrorCode::write);
}

TEST(Recorder, replays_a_recording_in_any_order) {
    Recorder recorder({}, script_of("2 set height=5\n4 set height=7"), k_camera);
    EXPECT_EQ(recorder.mode(), Mode::replaying);
    EXPECT_TRUE(recorder.turns_knobs());
    recorder.note(0, set("height", 100)); // the user does not take part
    const auto fill = recorder.filler();
    for (const auto& [frame, height] : {std::pair(4, 7.0), {3, 5.0}, {0, -1.0}}) {
        render::FrameState state{.frame = frame};
        fill(state);
        EXPECT_EQ(height_in(state), height) << frame;
    }
    EXPECT_TRUE(recorder.finish({})) << "it writes nothing";
}

TEST(Recorder, live_input_keeps_the_state) {
    render::FrameState state;
    turned_to(3).fill(state);
    Recorder({}, std::nullopt, k_camera).filler()(state);
    EXPECT_EQ(height_in(state), 3);
}

TEST(Recorder, saves_pictures_named_after_scene_and_frame) {
    const TemporaryFolder folder;
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    Recorder recorder({}, std::nullopt, k_camera);
    EXPECT_EQ(recorder.save(picture_of(42), "/somewhere/waves.glsl", {}).value(), "waves-00042.png");
    EXPECT_EQ(recorder.save(picture_of(43), "/somewhere/waves.glsl", {}).value(), "waves-00043.png");
    EXPECT_TRUE(recorder.finish({}));
    fs::current_path(before);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2);
    EXPECT_TRUE(fs::exists(folder / "waves-00042.png"));
    EXPECT_TRUE(fs::exists(folder / "waves-00043.png"));
}

TEST(Recorder, replaces_no_picture) {
    const TemporaryFolder folder;
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    const std::string text = "an earlier picture";
    std::ofstream("waves-00042.png") << text;
    Recorder recorder({}, std::nullopt, k_camera);
    const auto save = [&] { return recorder.save(picture_of(42), "waves.glsl", {}).value(); };
    EXPECT_EQ(save(), "waves-00042-2.png");
    EXPECT_EQ(save(), "waves-00042-3.png") << "the one before may not be written yet";
    EXPECT_TRUE(recorder.finish({}));
    std::string left;
    std::getline(std::ifstream("waves-00042.png"), left);
    EXPECT_EQ(left, text);
    EXPECT_TRUE(fs::exists("waves-00042-3.png"));
    fs::create_symlink("nowhere", "waves-00001.png");
    EXPECT_EQ(Recorder({}, std::nullopt, k_camera).save(picture_of(1), "waves.glsl", {}).value(),
              "waves-00001-2.png");
    fs::current_path(before);
}

TEST(Recorder, reports_a_picture_that_cannot_be_written) {
    const TemporaryFolder folder;
    const fs::path before = fs::current_path();
    fs::create_directory(folder / "gone");
    fs::current_path(folder / "gone");
    fs::remove(folder / "gone");
    Recorder recorder({}, std::nullopt, k_camera);
    EXPECT_TRUE(recorder.save(picture_of(1), "waves.glsl", {})) << "it is written later";
    const auto finished = recorder.finish({});
    fs::current_path(before);
    ASSERT_FALSE(finished);
    EXPECT_EQ(finished.error().code, ErrorCode::write);
}

TEST(Recorder, saves_the_next_frame_only) {
    Recorder recorder({}, std::nullopt, k_camera);
    EXPECT_FALSE(recorder.take_save());
    recorder.save_next();
    EXPECT_TRUE(recorder.take_save());
    EXPECT_FALSE(recorder.take_save());
}

} // namespace tidemark::window::recorder_test
