// The parts of a study: settings, axes, views, files, and the values beyond the strictest one.
#include "base/file.hpp"
#include "lab/scene_numbers.hpp"
#include "lab/study.hpp"
#include "scene/load_scene.hpp"
#include "support/scene_of.hpp"

#include <gmock/gmock.h>

#include <filesystem>

namespace tidemark::lab::study_test {

using testing::ElementsAre;
using testing::HasSubstr;

const scene::Scene k_scene =
    scene_of("#define MAX_STEPS 64\n#iUniform float height = 0.5\nconst float EPS = 1e-3;\n");

// ---- Settings -------------------------------------------------------------------------------------------

TEST(Setting, is_a_knob_a_define_or_a_const) {
    const auto set = with(k_scene, {{"MAX_STEPS", "8"}, {"height", "2"}, {"EPS", "1e-5"}});
    ASSERT_TRUE(set);
    EXPECT_EQ(value_of(*set, "MAX_STEPS"), "8");
    EXPECT_EQ(value_of(*set, "height"), "2");
    EXPECT_EQ(value_of(*set, "EPS"), "1e-5");
    EXPECT_EQ(value_of(k_scene, "MAX_STEPS"), "64");
}

TEST(Setting, unknown_setting_suggests_the_nearest) {
    const auto set = with(k_scene, {{"MAX_STEP", "8"}});
    ASSERT_FALSE(set);
    EXPECT_EQ(set.error().code, ErrorCode::usage);
    EXPECT_EQ(set.error().message,
              "the scene has no #iUniform, #define or const 'MAX_STEP': did you mean 'MAX_STEPS'?");
    EXPECT_THAT(with(k_scene, {{"zzz", "8"}}).error().message, HasSubstr("it has MAX_STEPS, EPS, height"));
}

TEST(Setting, axes_split_at_commas_outside_parentheses) {
    const auto axis = parse_axis("c = vec3(1,2,3), vec3(4) ,5", "--vary");
    ASSERT_TRUE(axis);
    EXPECT_EQ(axis->name, "c");
    EXPECT_THAT(axis->values, ElementsAre("vec3(1,2,3)", "vec3(4)", "5"));
    for (const char* bad : {"", "A", "A=", "=1", "A=1,,2", "A=1,"})
        EXPECT_FALSE(parse_axis(bad, "--vary")) << bad;
    EXPECT_EQ(parse_axis("A=1,,2", "--vary").error().message,
              "--vary A=1,,2: give NAME=a,b,c, none of them empty");
}

TEST(Setting, the_last_value_of_a_name_counts) {
    EXPECT_THAT(merged({{"A", "1"}, {"B", "2"}, {"A", "3"}}),
                ElementsAre(Setting{"A", "3"}, Setting{"B", "2"}));
}

// ---- Points ---------------------------------------------------------------------------------------------

TEST(Points, are_the_unchanged_scene_and_all_combinations) {
    Study study;
    study.series = series_of({{"A", {"1", "2"}}, {"B", {"x", "y"}}});
    const std::vector<Point> points = points_of(study);
    std::vector<std::string> labels;
    for (const Point& point : points)
        labels.push_back(point.label);
    EXPECT_THAT(labels,
                ElementsAre("defaults", "A = 1, B = x", "A = 1, B = y", "A = 2, B = x", "A = 2, B = y"));
    EXPECT_EQ(points[3].series, 1u);
    EXPECT_EQ(points[3].knob, "x");
    EXPECT_EQ(study.series[1].name, "A = 2");
}

// ---- Views ----------------------------------------------------------------------------------------------

TEST(Views, are_times_and_places_of_the_mouse) {
    const auto views = parse_views("0;2.5@0.75,.4");
    ASSERT_TRUE(views);
    ASSERT_EQ(views->size(), 2u);
    EXPECT_EQ((*views)[1].state.seconds(), 2.5);
    EXPECT_EQ((*views)[1].name, "t=2.5@0.75,.4");
    const render::FrameInputs inputs = inputs_of(state_of((*views)[1], {320, 180}));
    EXPECT_EQ(inputs.mouse.x, 240);
    EXPECT_EQ(inputs.mouse.y, 72);
    EXPECT_EQ(inputs.frame, 150);
    EXPECT_EQ(state_of((*views)[0], {320, 180}).mouse, render::Mouse());
    for (const char* bad : {"", "x", "1;", "1@", "1@2", "1@0.5,0.5,", "1 2"})
        EXPECT_FALSE(parse_views(bad)) << bad;
}

TEST(Views, outside_the_picture_or_before_the_start_are_errors) {
    EXPECT_EQ(parse_views("1@2,0").error().message,
              "view 't=1@2,0': the mouse at 2, 0 is outside the "
              "picture; give fractions of its width and height, 0 to 1");
    EXPECT_EQ(parse_views("1;2;1").error().message, "--views 1;2;1: 't=1' is given twice");
    EXPECT_EQ(parse_views("-1").error().message,
              "view 't=-1': the time -1 is out of range; give 0 to 1e+09 seconds");
}

// ---- Files ----------------------------------------------------------------------------------------------

std::string error_of(std::string_view text) {
    const auto study = parse_study(text, "s.json");
    return study ? "" : to_string(study.error());
}

TEST(StudyFile, is_read) {
    const auto study = parse_study(R"({
        "about": "a sentence", "size": [64, 36],
        "views": [{"name": "v", "time": 1.5, "mouse": [0.5, 0.25]}],
        "series": [{"name": "s", "trust": "bound assumed", "set": {"A": 1, "B": "x"}, "vary": {"C": [1, 2.5, "1e-4"]}}],
        "reference": {"C": 9}, "sources": [{"name": "budget", "set": {"A": 7}}],
        "omissions": ["none"], "promise": {"wrong_percent": 1, "psnr": 40}})",
                                   "s.json");
    ASSERT_TRUE(study) << to_string(study.error());
    EXPECT_EQ(study->extent, (Extent{64, 36}));
    EXPECT_EQ(study->views[0].mouse, glm::dvec2(0.5, 0.25));
    EXPECT_EQ(study->series[0].trust, Trust::bound_assumed);
    EXPECT_THAT(study->series[0].settings, ElementsAre(Setting{"A", "1"}, Setting{"B", "x"}));
    EXPECT_THAT(study->series[0].axes[0].values, ElementsAre("1", "2.5", "1e-4"));
    EXPECT_EQ(study->sources[0].settings[0].value, "7");
    EXPECT_EQ(study->promise.least_psnr, 40);
}

TEST(StudyFile, errors_have_line_and_pointer) {
    EXPECT_THAT(error_of("{\n  \"series\": [{\n    \"name\": \"s\",\n    \"varry\": {}\n  }]\n}"),
                HasSubstr("s.json:4: error: /series/0/varry: did you mean \"vary\"?"));
    EXPECT_THAT(error_of("{\"views\": [{\"time\": 1}]}"),
                HasSubstr("s.json:1: error: /views/0: needs a \"name\""));
    EXPECT_THAT(error_of("{\"views\": [{\"name\": \"v\", \"mouse\": [2, 0]}]}"),
                HasSubstr("is outside the picture"));
    EXPECT_THAT(error_of("{\"views\": [{\"name\": \"v\"}, {\"name\": \"v\", \"time\": 2}]}"),
                HasSubstr("/views/1/name: another view is named 'v' already"));
    EXPECT_THAT(error_of("{\"size\": [0, 9]}"), HasSubstr("/size: must be [width, height] in pixels"));
    EXPECT_THAT(error_of("{\"size\": [1e99, 9]}"), HasSubstr("/size: must be [width, height] in pixels"));
    EXPECT_THAT(error_of("{\"series\": [{\"name\": \"s\", \"trust\": \"sure\"}]}"),
                HasSubstr("/series/0/trust: must be one of certified, bound assumed, heuristic, unknown"));
    EXPECT_THAT(error_of("{\"series\": [{\"name\": \"s\", \"vary\": {\"A\": []}}]}"),
                HasSubstr("/series/0/vary/A: must be an array of values"));
    EXPECT_THAT(error_of("{\"series\": {}}"), HasSubstr("/series: must be an array"));
    EXPECT_THAT(error_of("[]"), HasSubstr("must be an object"));
    EXPECT_THAT(error_of("{"), HasSubstr("s.json"));
}

TEST(StudyFile, shipped_studies_name_existing_knobs) {
    namespace fs = std::filesystem;
    size_t studies = 0;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(TIDEMARK_SOURCE_DIR) / "shaders")) {
        const std::string name = entry.path().string();
        if (!name.ends_with(".study.json"))
            continue;
        SCOPED_TRACE(name);
        ++studies;
        const auto study = parse_study(*read_text_file(entry.path()), name);
        ASSERT_TRUE(study) << to_string(study.error());
        const auto scene =
            scene::load_scene(name.substr(0, name.size() - std::string_view(".study.json").size()) + ".glsl");
        ASSERT_TRUE(scene) << to_string(scene.error());
        std::vector<std::vector<Setting>> all{study->reference, study->model};
        for (const Point& point : points_of(*study))
            all.push_back(point.settings);
        for (const ErrorSource& source : study->sources)
            all.push_back(source.settings);
        for (const auto& settings : all) {
            const auto set = with(*scene, settings);
            EXPECT_TRUE(set) << to_string(set.error());
        }
    }
    EXPECT_GE(studies, 8u);
}

// ---- Beyond the strictest -------------------------------------------------------------------------------

TEST(Stricter, extrapolates_increasing_values) {
    EXPECT_EQ(beyond({"N", {"16", "32", "64"}}, 1), "128");
    EXPECT_EQ(beyond({"N", {"16", "32", "64"}}, 3), "512");
    EXPECT_EQ(beyond({"N", {"10", "11"}}, 1), "22");    // at least doubled
    EXPECT_EQ(beyond({"N", {"8", "1024"}}, 1), "4096"); // at most four times as many
    EXPECT_EQ(beyond({"e", {"1e-3", "1e-4"}}, 1), "1e-05");
    EXPECT_EQ(beyond({"e", {"1.0", "0.9"}}, 1), "0.45");
    EXPECT_EQ(beyond({"N", {"8.0", "16.0"}}, 1), "32.0"); // a float stays one
    EXPECT_EQ(beyond({"STRIDE", {"4", "2"}}, 1), "1");
    EXPECT_EQ(beyond({"STRIDE", {"4", "2"}}, 2), std::nullopt);
    EXPECT_EQ(beyond({"SOLVER", {"A", "B"}}, 1), std::nullopt);
    EXPECT_EQ(beyond({"SOLVER", {"A", "B"}}, 0), "B");
    EXPECT_EQ(beyond({"N", {"64"}}, 1), std::nullopt);
    EXPECT_EQ(beyond({"N", {"0", "1"}}, 1), std::nullopt);
    EXPECT_EQ(beyond({"N", {"1000000000", "2000000000"}}, 1), std::nullopt); // no int
}

TEST(Stricter, extrapolates_decreasing_values) {
    EXPECT_EQ(beyond({"N", {"16", "32", "64"}}, -1), "32");
    EXPECT_EQ(beyond({"N", {"16", "32", "64"}}, -2), "16");
    EXPECT_EQ(beyond({"N", {"16", "32", "64"}}, -3), std::nullopt);
    Study study;
    study.series = series_of({{"N", {"16", "32"}}});
    EXPECT_EQ(strictest(study, -1)[0].value, "16");
    EXPECT_EQ(strictest(study, -5)[0].value, "16");
    study.reference = {{"N", "256"}};
    EXPECT_EQ(strictest(study, -2)[0].value, "64");
}

TEST(Stricter, other_settings_switch_between_odd_and_even) {
    Study study;
    study.series = series_of({{"S", {"A", "B"}}, {"E", {"0.2", "0.1"}}, {"N", {"8", "16"}}});
    EXPECT_THAT(beside(study, 1, false),
                ElementsAre(Setting{"S", "B"}, Setting{"E", "0.0364963504"}, Setting{"N", "45"}));
    EXPECT_THAT(beside(study, 1, true),
                ElementsAre(Setting{"S", "B"}, Setting{"E", "0.0292397661"}, Setting{"N", "46"}));
    study.series = series_of({{"STRIDE", {"8", "4"}}});
    EXPECT_EQ(beside(study, 0, false)[0].value, "3");
    EXPECT_EQ(beside(study, 0, true)[0].value, "2");
    EXPECT_EQ(beside(study, 2, false)[0].value, "1"); // nothing is stricter
}

TEST(Stricter, all_axes_of_a_command_line_are_extrapolated) {
    Study study;
    study.series = series_of({{"A", {"1", "2"}}, {"B", {"0.1", "0.01"}}});
    EXPECT_THAT(strictest(study, 0), ElementsAre(Setting{"A", "2"}, Setting{"B", "0.01"}));
    EXPECT_THAT(strictest(study, 1), ElementsAre(Setting{"A", "4"}, Setting{"B", "0.001"}));
}

TEST(Stricter, named_references_are_extrapolated_along_their_axis) {
    Study study;
    study.series = series_of({{"N", {"16", "32"}}});
    study.reference = {{"N", "256"}, {"SOLVER", "BEST"}};
    EXPECT_THAT(strictest(study, 0), ElementsAre(Setting{"N", "256"}, Setting{"SOLVER", "BEST"}));
    EXPECT_EQ(strictest(study, 1)[0].value, "512");
    study.reference = {{"SOLVER", "BEST"}};
    EXPECT_EQ(strictest(study, 1), strictest(study, 0));
}

} // namespace tidemark::lab::study_test
