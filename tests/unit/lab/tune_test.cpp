// The knobs that `tune` changes, the points that it measures next, and the one that it chooses.
#include "lab/tune.hpp"
#include "support/scene_of.hpp"

#include <gmock/gmock.h>

namespace tidemark::lab::tune_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// ---- What is turned -------------------------------------------------------------------------------------

/// `lines` begin at line 1 of the file.
QualitySettings found_in(const std::string& lines, std::optional<int> march = {},
                         std::optional<int> step = {}, std::optional<double> far = {}) {
    const scene::Scene scene = scene_of(lines);
    const auto place = [&](int line) { return scene.image().text.lines().locate(line); };
    if (!march)
        return quality_settings(scene, std::nullopt);
    MarchPlaces places{place(*march), {}, far};
    if (step)
        places.steps.push_back(place(*step));
    return quality_settings(scene, places);
}

std::vector<std::string> names(const QualitySettings& settings) {
    std::vector<std::string> names;
    for (const QualitySetting& each : settings.found)
        names.push_back(each.axis.name);
    return names;
}

TEST(QualitySettings, of_a_march_are_found_by_their_use) {
    const auto settings = found_in("#define N 64\n#define NEAR 0.001\n#define BALLS 7\n"
                                   "float f() {\n"
                                   "    float t = 0.0;\n"
                                   "    for (int i = 0; i < N; i++) {\n"
                                   "        float d = g(t);\n"
                                   "        if (d < NEAR) break;\n"
                                   "        t += d;\n"
                                   "    }\n"
                                   "    for (int i = 0; i < BALLS; i++) t += 1.0;\n"
                                   "    return t;\n"
                                   "}\n",
                                   8);
    EXPECT_THAT(names(settings), ElementsAre("N", "NEAR"));
    EXPECT_THAT(settings.left, ElementsAre("BALLS"));
    EXPECT_THAT(settings.found[0].axis.values, ElementsAre("16", "24", "32", "48", "64", "96", "128"));
    EXPECT_EQ(settings.found[0].own, 4U);
    EXPECT_THAT(settings.found[0].why, HasSubstr("bounds the march at "));
    EXPECT_TRUE(settings.found[1].march);
    EXPECT_EQ(settings.found[1].axis.values.front(), "0.032");
    EXPECT_EQ(settings.found[1].axis.values[settings.found[1].own], "0.001");
}

TEST(QualitySettings, without_effect_on_the_compiled_text_are_left_out) {
    const std::string text = "#define SOLVER 1\n#define STEPS 64\n#define EPSILON 0.001\n"
                             "void mainImage(out vec4 c, in vec2 p) {\n"
                             "    float t = 0.0;\n"
                             "    for (int i = 0; i < STEPS; i++) {\n"
                             "#if SOLVER == 2\n"
                             "        if (t < EPSILON) break;\n"
                             "#endif\n"
                             "        t += p.x;\n"
                             "    }\n"
                             "    c = vec4(t);\n"
                             "}\n";
    EXPECT_THAT(names(found_in(text)), ElementsAre("STEPS"));
    EXPECT_THAT(names(found_in(text.substr(0, 15) + "2" + text.substr(16))), ElementsAre("STEPS", "EPSILON"));
}

/// A march of numbers without a name: `head` of its loop, `test` and `step` are its lines 3 to 5.
QualitySettings found_in_march(const std::string& head, const std::string& test, const std::string& step) {
    return found_in("float f() {\n"
                    "    for (int j = 0; j < 3; j++)\n"
                    "    for (" +
                        head +
                        ") {\n"
                        "        float d = g(t * 0.4); if (" +
                        test +
                        ") break;\n"
                        "        " +
                        step +
                        "\n"
                        "    }\n"
                        "    for (int i = 0; i < 12; i++) t += 0.25 * t;\n"
                        "}\n",
                    4, 5, 20.0);
}

TEST(QualitySettings, of_a_march_may_be_literals) {
    const auto settings = found_in_march("int i = 0; i < 64 && t < 20.0; i++", "d < 0.001", "t += d * 0.5;");
    EXPECT_THAT(names(settings), ElementsAre(HasSubstr(":3:25"), HasSubstr(":4:39"), HasSubstr(":5:18")));
    EXPECT_EQ(settings.found[0].axis.values[settings.found[0].own], "64");
    EXPECT_EQ(settings.found[1].axis.values[settings.found[1].own], "0.001");
    EXPECT_EQ(settings.found[2].axis.values[settings.found[2].own], "0.5");
    EXPECT_THAT(settings.found[0].why, HasSubstr("64, which bounds the march"));
    for (const QualitySetting& each : settings.found)
        EXPECT_TRUE(each.march);
}

TEST(QualitySettings, ambiguous_literals_are_left_out) {
    EXPECT_THAT(names(found_in_march("int i = 0; i < 64 && k < 32; i++", "d < 0.001 || h < 0.002",
                                     "t += 0.5 * d * 0.9;")),
                IsEmpty());
}

TEST(Setting, a_literal_is_named_by_its_place) {
    const scene::Scene scene = scene_of("float a = 1.5 + 2.5;\nfloat b = 2.5;\n");
    const std::string file = scene.image().text.lines().locate(1).file;
    EXPECT_EQ(value_of(scene, file + ":1:17"), "2.5");
    EXPECT_EQ(value_of(scene, file + ":1:18"), "");
    const auto changed =
        with(scene, {{file + ":1:11", "11.25"}, {file + ":1:17", "7.0"}, {file + ":2:11", "4"}});
    ASSERT_TRUE(changed) << changed.error().message;
    EXPECT_EQ(changed->image().text.text(), "float a = 11.25 + 7.0;\nfloat b = 4;\n");
    EXPECT_FALSE(with(scene, {{file + ":9:1", "1"}}));
}

TEST(QualitySettings, outside_a_march_are_found_by_name) {
    const auto settings =
        found_in("#define SAMPLES 5\nconst float EPSILON = 0.01;\n#define LINE 0.02\n#define STEP_SCALE 0.7\n"
                 "#define FOG 0.5\n"
                 "float f(float t) {\n"
                 "    for (int i = 0; i < SAMPLES; i++) t *= 2.0;\n"
                 "    if (t < EPSILON || t < LINE) return 0.0;\n"
                 "    return t * STEP_SCALE + FOG * t;\n"
                 "}\n");
    EXPECT_THAT(names(settings), ElementsAre("SAMPLES", "EPSILON", "STEP_SCALE"));
    EXPECT_THAT(settings.found[0].axis.values, ElementsAre("1", "2", "3", "4", "5", "8", "10"));
    EXPECT_FALSE(settings.found[0].march);
}

TEST(QualitySettings, exclude_counts_that_define_the_picture) {
    const auto settings = found_in("#define OCTAVES 5\n#define ITERATIONS 12\n"
                                   "float f(float t) {\n"
                                   "    for (int i = 0; i < OCTAVES; i++) t *= 2.0;\n"
                                   "    for (int i = 0; i < ITERATIONS; i++) t = abs(t) - 1.0;\n"
                                   "    return t;\n"
                                   "}\n");
    EXPECT_THAT(settings.found, IsEmpty());
    EXPECT_THAT(settings.left, ElementsAre("OCTAVES", "ITERATIONS"));
}

TEST(QualitySettings, of_march_like_loops_are_found_without_analysis) {
    const auto settings =
        found_in("#define LAYERS 70\n"
                 "float field(vec3 p) { return length(p) - 1.0; }\n"
                 "float noise(vec3 p) { return p.x; }\n"
                 "float march(vec3 o, vec3 r) {\n"
                 "    float t = 0.0;\n"
                 "    for (int i = 0; i < 96; i++) {\n"
                 "        float d = field(o + t * r);\n"
                 "        t += 0.7 * d;\n"
                 "    }\n"
                 "    for (int i = 0; i < LAYERS; i++) { vec3 p = o + t * r; t += field(p); }\n"
                 "    return t;\n"
                 "}\n"
                 "float sum(vec3 p) {\n"
                 "    float f = 0.0, a = 0.5;\n"
                 "    for (int i = 0; i < 60; i++) { f += a * noise(p); p *= 2.0; a *= 0.5; }\n"
                 "    return f;\n"
                 "}\n");
    EXPECT_THAT(names(settings), ElementsAre("LAYERS", HasSubstr(":6:25")));
    EXPECT_TRUE(settings.found[0].march);
}

TEST(QualitySettings, exclude_expressions_and_numbers_out_of_range) {
    EXPECT_THAT(
        names(found_in("#define STEPS (2 * 32)\n#define EPS 4.0\n#define MAX_STEPS 0\n"
                       "float f(float t) { for (int i = 0; i < STEPS && i < MAX_STEPS; i++) t *= 2.0;\n"
                       "if (t < EPS) return 1.0; return t; }\n")),
        IsEmpty());
}

TEST(QualitySettings, take_the_users_values) {
    const scene::Scene scene = scene_of("#define STEPS 64\n");
    const QualitySetting own = quality_setting(scene, {"STEPS", {"32", "64", "128"}});
    EXPECT_EQ(own.own, 1U);
    const QualitySetting other = quality_setting(scene, {"STEPS", {"32", "48"}});
    EXPECT_THAT(single_values({other}),
                ElementsAre(ElementsAre(Setting{"STEPS", "32"}), ElementsAre(Setting{"STEPS", "48"})));
}

// ---- What is wanted -------------------------------------------------------------------------------------

TEST(Goal, is_a_measure_and_a_number) {
    EXPECT_EQ(parse_goal("rmse=0.01")->most_error, 0.01);
    EXPECT_NEAR(*parse_goal("psnr=40dB")->most_error, 0.01, 1e-15);
    EXPECT_NEAR(*parse_goal("psnr=40")->most_error, 0.01, 1e-15);
    EXPECT_EQ(parse_goal("flip=0.02")->measure, Measure::flip);
    EXPECT_EQ(parse_goal("wrong=0.05%")->most_error, 0.05);
    EXPECT_EQ(to_string(*parse_goal("wrong=0.05%")), "wrong rays <= 0.05 %");
    EXPECT_EQ(to_string(Goal{Measure::rmse, {}, 8.0}), "8 ms a frame");
    for (const char* bad :
         {"", "rmse", "rmse=", "rmse=x", "rmse=0", "rmse=-1", "rmse=nan", "rmse=0.1dB", "ssim=1"})
        EXPECT_EQ(parse_goal(bad).error().code, ErrorCode::usage) << bad;
}

// ---- What is measured next, and chosen ------------------------------------------------------------------

/// A study whose first point is the scene as it is.
struct Explored {
    WorkPrecisionSet set;

    Explored() { add({}, 10, 0.01); }
    WorkPrecision& add(std::vector<Setting> settings, double milliseconds, double rmse) {
        WorkPrecision& point = set.points.emplace_back();
        point.point = {0, to_string(settings), "", std::move(settings)};
        point.wall = {std::vector<double>(30, milliseconds)};
        point.all.picture.samples.rmse = rmse;
        point.all.wall = summary_of(point.wall.front());
        point.views = {point.all};
        return point;
    }
};

QualitySetting setting(const std::string& name, std::vector<std::string> values, size_t own) {
    return {.axis = {name, std::move(values)}, .own = own};
}

TEST(Candidates, combine_faster_settings_within_the_error) {
    Explored explored;
    explored.set.study = {};
    explored.add({{"A", "1"}}, 5, 0.02);
    explored.add({{"A", "4"}}, 20, 0.001);
    explored.add({{"B", "1"}}, 8, 0.0101);
    const std::vector<QualitySetting> settings{setting("A", {"1", "2", "4"}, 1), setting("B", {"1", "2"}, 1)};
    const auto found = candidates(explored.set, settings, {Measure::rmse, 0.021, {}}, 10);
    ASSERT_FALSE(found.empty());
    EXPECT_THAT(found.front(), testing::UnorderedElementsAre(Setting{"A", "1"}, Setting{"B", "1"}));
    for (const auto& each : found)
        EXPECT_NE(each, (std::vector<Setting>{{"A", "4"}, {"B", "1"}, {"A", "1"}}));
}

TEST(Candidates, for_a_time_limit_are_near_the_limit) {
    Explored explored;
    explored.add({{"A", "4"}}, 20, 0.001);
    explored.add({{"A", "8"}}, 40, 0.0001);
    const auto found =
        candidates(explored.set, {setting("A", {"2", "4", "8"}, 0)}, {Measure::rmse, {}, 25.0}, 10);
    EXPECT_THAT(found, testing::Contains(ElementsAre(Setting{"A", "4"})));
}

TEST(BestBy, adds_the_references_error_to_the_point) {
    Explored explored;
    explored.set.picture_standard.uncertainty = 0.001;
    explored.add({{"A", "1"}}, 4, 0.0195);
    explored.add({{"A", "2"}}, 5, 0.0185);
    explored.add({{"A", "3"}}, 6, 0.0150);
    EXPECT_EQ(best_by(explored.set, {Measure::rmse, 0.02, {}}), &explored.set.points[2]);
    EXPECT_EQ(best_by(explored.set, {Measure::rmse, 0.001, {}}), nullptr);
    EXPECT_EQ(best_by(explored.set, {}), &explored.set.points.front());
    explored.set.points[3].all.picture.samples.rmse = 0.009;
    EXPECT_EQ(best_by(explored.set, {}), &explored.set.points[3]);
}

TEST(BestBy, decides_within_the_references_error) {
    Explored explored;
    explored.set.picture_standard.uncertainty = 0.008; // most of the allowed error
    explored.set.points.front().all.picture.samples.rmse = 0.0005;
    explored.set.points.front().views.front() = explored.set.points.front().all;
    explored.add({{"A", "1"}}, 4, 0.0021);
    explored.add({{"A", "2"}}, 5, 0.0019);
    EXPECT_EQ(best_by(explored.set, {Measure::rmse, 0.01, {}}), &explored.set.points[2]);
    EXPECT_GT(largest_error(explored.set, explored.set.points[1], Measure::rmse), 0.01);
    EXPECT_LT(least_error(explored.set, explored.set.points[1], Measure::rmse), 0.01);
}

TEST(BestBy, keeps_the_error_in_every_view_with_a_margin) {
    Explored explored;
    explored.set.picture_standard.uncertainty = 0;
    WorkPrecision& uneven = explored.add({{"A", "1"}}, 4, 0.008);
    uneven.views.push_back(uneven.all);
    uneven.views[0].picture.samples.rmse = 0.002;
    uneven.views[1].picture.samples.rmse = 0.0095;
    EXPECT_GT(largest_error(explored.set, explored.set.points[1], Measure::rmse), 0.01);
    EXPECT_EQ(best_by(explored.set, {Measure::rmse, 0.01, {}}), &explored.set.points.front());
}

TEST(BestBy, is_never_the_unchanged_scene) {
    Explored explored;
    explored.set.picture_standard.uncertainty = 0;
    explored.add({{"A", "2"}}, 4, 0.01).own = true;
    EXPECT_EQ(best_by(explored.set, {Measure::rmse, 0.02, {}}), &explored.set.points.front());
    EXPECT_EQ(cheapest_as_exact(explored.set), &explored.set.points.front());
}

TEST(Rank, is_by_wrong_rays_first) {
    Explored explored;
    WorkPrecisionSet& set = explored.set;
    set.hit_standard.method = "known";
    WorkPrecision& few = explored.add({{"STEPS", "4"}}, 4, 0.3);
    HitErrors hits;
    hits.rms = 0.2;
    set.points.front().all.hits = hits;
    hits.rms = 0.01; // of the rays that still hit
    hits.wrong_tenth = hits.least_wrong_tenth = hits.most_wrong_tenth = 21;
    few.all.hits = hits;
    EXPECT_FALSE(no_more_wrong(set, set.points[1].all, set.points[0].all));
    EXPECT_TRUE(no_more_wrong(set, set.points[0].all, set.points[1].all));
    EXPECT_EQ(cheapest_as_exact(set), &set.points.front());
    set.points[1].all.hits->least_wrong_tenth = 0; // the shares are equal within their intervals
    EXPECT_TRUE(no_more_wrong(set, set.points[1].all, set.points[0].all));
}

TEST(BestBy, for_a_time_limit_is_the_most_exact_point) {
    Explored explored;
    explored.add({{"A", "1"}}, 4, 0.02);
    explored.add({{"A", "4"}}, 15, 0.001);
    EXPECT_EQ(best_by(explored.set, {Measure::rmse, {}, 12.0}), &explored.set.points.front());
    EXPECT_EQ(best_by(explored.set, {Measure::rmse, {}, 16.0}), &explored.set.points[2]);
    EXPECT_EQ(best_by(explored.set, {Measure::rmse, {}, 1.0}), nullptr);
}

TEST(BestBy, skips_points_without_an_error) {
    Explored explored;
    explored.set.picture_standard.uncertainty = 0;
    explored.add({{"A", "1"}}, 4, std::nan(""));
    explored.add({{"A", "2"}}, 4, 0.001).idle = true;
    explored.add({{"A", "3"}}, 4, 0.001).failure = "does not compile";
    EXPECT_EQ(best_by(explored.set, {Measure::rmse, 0.02, {}}), &explored.set.points.front());
}

TEST(Blur, names_a_too_uncertain_reference) {
    Explored explored;
    EXPECT_THAT(blur_of(explored.set, Measure::rmse, 0.01), HasSubstr("unknown"));
    explored.set.picture_standard.uncertainty = 0.012;
    EXPECT_THAT(blur_of(explored.set, Measure::rmse, 0.01), HasSubstr("not below the requested error"));
    EXPECT_EQ(blur_of(explored.set, Measure::rmse, 0.02), "");
    EXPECT_THAT(blur_of(explored.set, Measure::flip, 0.02), HasSubstr("which FLIP 0.02 needs"));
    EXPECT_THAT(blur_of(explored.set, Measure::wrong, 0.05), HasSubstr("no reference for its hits"));
}

} // namespace tidemark::lab::tune_test
