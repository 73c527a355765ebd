// Presets: their file, which is not replaced where it is not ours, and the way from one view to another.
#include "base/file.hpp"
#include "host/presets.hpp"
#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace tidemark::host::presets_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

scene::Knob knob(const char* name, double value, scene::KnobType type = scene::KnobType::float1) {
    scene::Knob knob;
    knob.name = name;
    knob.type = type;
    knob.value = {value};
    return knob;
}

Preset preset(const char* name, double height) {
    return {.name = name, .knobs = {{"height", {1, {height}}}}, .seconds = 1.5};
}

TEST(Presets, file_is_beside_the_scene) {
    EXPECT_EQ(presets_file("x/waves.glsl"), "x/waves.presets.json");
    EXPECT_EQ(presets_file("x/waves.json"), "x/waves.presets.json");
    EXPECT_EQ(presets_file("x/scene.json"), "x/presets.json");
    const TemporaryFolder folder;
    EXPECT_EQ(presets_file(folder.path()), folder / "presets.json");
    EXPECT_EQ(presets_file("-"), "");
}

TEST(Presets, are_read_back_from_their_file) {
    const TemporaryFolder folder;
    const fs::path scene = folder / "a.glsl";
    Preset kept = preset("dawn", 2);
    kept.defines = {"STEPS=8"};
    kept.camera = {70, 10, 4, {1, 2, 3}};
    kept.mouse = render::Mouse::dragged({1, 2}, {30, 40}, false);
    kept.extent = {320, 180};
    kept.picture = image::Image({2, 1}, 3, image::SampleType::u8);
    kept.picture.u8()[3] = 200;
    ASSERT_TRUE(PresetFile::read(scene)->write({kept}));
    const auto file = PresetFile::read(scene);
    ASSERT_TRUE(file);
    ASSERT_EQ(file->presets().size(), 1U);
    const Preset& read = file->presets().front();
    EXPECT_EQ(read.name, "dawn");
    EXPECT_EQ(read.knobs.at(0).value.numbers[0], 2);
    EXPECT_EQ(read.defines, kept.defines);
    EXPECT_EQ(read.camera, kept.camera);
    EXPECT_EQ(read.mouse, kept.mouse);
    EXPECT_EQ(read.extent, kept.extent);
    EXPECT_EQ(read.seconds, 1.5);
    EXPECT_EQ(read.picture, kept.picture);
}

TEST(Presets, keep_unknown_fields) {
    const TemporaryFolder folder;
    const fs::path scene = folder / "a.glsl", path = folder / "a.presets.json";
    ASSERT_TRUE(write_file(OutputPath(path), R"({"tidemark_presets": 1, "by": "me",
        "presets": [{"name": "a", "tags": [1]}, {"name": "b"}]})"));
    auto file = PresetFile::read(scene);
    ASSERT_TRUE(file);
    ASSERT_TRUE(write_file(OutputPath(path), R"({"tidemark_presets": 1, "by": "me",
        "presets": [{"name": "a", "tags": [1]}, {"name": "b"}, {"name": "c"}]})"));
    ASSERT_TRUE(file->write({file->presets()[0]})); // b is forgotten, c is another's
    const auto text = read_file(path).value();
    const Json json = parse_json(text);
    EXPECT_EQ(json["by"], "me");
    ASSERT_EQ(json["presets"].size(), 2U);
    EXPECT_EQ(json["presets"][0]["tags"], Json::array({1}));
    EXPECT_EQ(json["presets"][1]["name"], "c");
}

TEST(Presets, never_replace_a_foreign_file) {
    const TemporaryFolder folder;
    const fs::path scene = folder / "a.glsl", path = folder / "a.presets.json";
    auto file = PresetFile::read(scene);
    ASSERT_TRUE(file);
    for (const char* text : {"{}", "other", R"({"tidemark_presets": 1, "presets": [{"name": "a", "time": 1,
                              "camera": "far"}]})"}) {
        ASSERT_TRUE(write_file(OutputPath(path), text));
        EXPECT_FALSE(PresetFile::read(scene)) << text;
        EXPECT_FALSE(file->write({preset("a", 1)})) << text;
        EXPECT_EQ(read_file(path), text);
    }
}

TEST(Presets, a_thumbnail_that_is_too_large_is_not_read) {
    Json json{{"name", "a"}, {"thumbnail", "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAgAAAAIAACAIAAAD"}};
    EXPECT_EQ(preset_of(json)->picture.extent.pixels(), 0U);
}

TEST(Presets, a_thumbnail_is_an_average) {
    image::Image picture({4, 2}, 4, image::SampleType::u8);
    for (size_t i = 0; i < 2; ++i)
        picture.u8()[4 * i] = 100; // two of the eight red
    const image::Image small = thumbnail_of(picture, {2, 2});
    EXPECT_EQ(small.extent, (Extent{2, 1}));
    EXPECT_EQ(small.u8()[0], 50);
    EXPECT_EQ(small.u8()[3], 0);
}

TEST(Morph, interpolates_numbers) {
    Preset to{.name = "to", .knobs = {{"height", {1, {4}}}, {"count", {1, {3}}}}};
    to.camera = {10, 0, 40, {2, 0, 0}};
    render::OrbitCamera from;
    from.azimuth = 350;
    from.elevation = 20;
    from.distance = 10;
    const std::vector knobs{knob("height", 2), knob("count", 0, scene::KnobType::int1), knob("same", 0)};
    const Morph morph(knobs, from, to, 5, 2);
    EXPECT_FALSE(morph.done(6.9));
    EXPECT_TRUE(morph.done(7));
    const auto middle = morph.knobs(6);
    ASSERT_EQ(middle.size(), 2U) << "the one that stays is left out";
    EXPECT_EQ(middle[0].value.numbers[0], 3);
    EXPECT_EQ(middle[1].value.numbers[0], 2) << "whole";
    EXPECT_NEAR(std::remainder(morph.camera(6).azimuth, 360), 0, 1e-9) << "the short way";
    EXPECT_NEAR(morph.camera(6).distance, 20, 1e-9);
    EXPECT_EQ(morph.camera(6).target.x, 1);
    EXPECT_EQ(morph.camera(7), to.camera);
    EXPECT_EQ(morph.camera(5), from);
    EXPECT_EQ(morph.knobs(8)[0].value.numbers[0], 4);
}

} // namespace tidemark::host::presets_test
