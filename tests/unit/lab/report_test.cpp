// The report of a study that is made by hand, so that the right answers are known.
#include "lab/study_data.hpp"
#include "lab/study_report.hpp"
#include "lab/work_precision.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace tidemark::lab::report_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A point of a picture-only study with that error and about that time in each of 30 rounds.
WorkPrecision point(size_t series, const std::string& label, double rmse, double milliseconds) {
    WorkPrecision made;
    made.point = {series, label, label, {{"N", label}}};
    Outcome outcome;
    outcome.picture.samples.rmse = rmse;
    outcome.picture.samples.psnr = -20 * std::log10(rmse);
    std::vector<double> rounds;
    for (int i = 0; i < 30; ++i)
        rounds.push_back(milliseconds * (1 + 0.01 * (i * 7 % 5)));
    outcome.wall = summary_of(rounds);
    made.wall = made.cpu = {rounds};
    made.views = {outcome};
    made.all = outcome;
    return made;
}

WorkPrecisionSet set_of(std::vector<WorkPrecision> points) {
    WorkPrecisionSet set;
    set.study.views = {{"first", render::at_time(1)}};
    set.study.series = {{"N <of it>", Trust::heuristic, {}, {{"N", {}}}}};
    set.picture_standard = {"itself", 1e-5, "compared"};
    set.circumstances.renderer = "some GPU";
    set.points = std::move(points);
    judge(set);
    return set;
}

WorkPrecisionSet usual() {
    return set_of({point(1, "defaults", 0.01, 20), point(0, "8", 0.1, 5), point(0, "16", 0.009, 10),
                   point(0, "32", 0.001, 40), point(0, "64", 0.002, 80), point(0, "128", 5e-5, 90)});
}

TEST(Judge, finds_the_front_and_hollow_points) {
    std::vector<bool> front, hollow;
    for (const WorkPrecision& p : usual().points) {
        front.push_back(p.on_front);
        hollow.push_back(p.hollow);
    }
    EXPECT_THAT(front, ElementsAre(false, true, true, true, false, true));
    EXPECT_THAT(hollow, ElementsAre(false, false, false, false, false, true));
}

TEST(Verdict, names_the_cheapest_good_point_and_the_gain_at_equal_error) {
    const WorkPrecisionSet set = usual();
    EXPECT_EQ(cheapest_good(set)->point.label, "32"); // 60 dB; "16" has 41
    EXPECT_EQ(cheapest_as_exact(set)->point.label, "16");
    const auto gain = speedup(set.points[0], set.points[2]);
    ASSERT_TRUE(gain);
    EXPECT_NEAR(gain->ratio, 2.0, 1e-9);
    EXPECT_TRUE(gain->certain());
    EXPECT_THAT(sentences(set), testing::Contains(HasSubstr("at equal error 2.00 x [2.00, 2.00] faster")));
    EXPECT_THAT(sentences(set)[0], HasSubstr("cheapest setting with PSNR >= 50 dB: 32 (40.8 ms"));
}

TEST(Verdict, is_withheld_within_the_noise) {
    WorkPrecisionSet set = set_of({point(1, "defaults", 0.01, 10), point(0, "8", 0.01, 9.99)});
    for (size_t i = 0; i < 30; ++i)
        set.points[1].wall[0][i] *= i % 2 ? 0.8 : 1.25;
    EXPECT_THAT(sentences(set),
                testing::Contains(HasSubstr("no setting is measurably faster than the scene's defaults")));
    set.points[1].wall[0].resize(3);
    EXPECT_EQ(speedup(set.points[0], set.points[1]), std::nullopt);
    EXPECT_THAT(sentences(set), testing::Contains(HasSubstr("no verdict at equal error")));
}

TEST(Verdict, reports_no_good_point_and_an_interrupted_study) {
    WorkPrecisionSet set = set_of({point(1, "defaults", 0.1, 10)});
    set.circumstances.complete = false;
    EXPECT_THAT(
        sentences(set),
        ElementsAre(
            HasSubstr("no setting of this study certainly has PSNR >= 50 dB: the nearest is defaults ("),
            "no tested setting is cheaper than the scene's defaults without being less exact",
            "incomplete: the study was interrupted"));
}

TEST(Verdict, skips_hollow_points_and_adds_the_references_error) {
    WorkPrecisionSet set = usual();
    set.picture_standard.uncertainty = 0.0015; // only the defaults' and "8" are ten times as much
    judge(set);
    EXPECT_EQ(set.points[0].hollow, true);
    EXPECT_EQ(cheapest_good(set)->point.label, "32"); // 60 dB, 52 with the truth's error against it
    EXPECT_THAT(sentences(set), testing::Contains(HasSubstr("hollow: at least 52.0 dB")));
    EXPECT_THAT(sentences(set),
                testing::Contains("no verdict at equal error: the scene's defaults are too close to "
                                  "the reference's own error to rank (hollow)"));
    set.picture_standard.uncertainty = 0.01;
    judge(set);
    EXPECT_EQ(cheapest_good(set), nullptr);
    set.picture_standard.uncertainty.reset();
    judge(set);
    EXPECT_EQ(sentences(set)[0], "no verdict on PSNR >= 50 dB: the reference's own error is unknown");
    set.picture_standard.none = "it does not converge";
    EXPECT_THAT(
        sentences(set),
        ElementsAre("no reference for the pictures: it does not converge; give one with --reference"));
}

TEST(Verdict, never_names_an_idle_point) {
    WorkPrecisionSet set = usual();
    set.points[2].idle = set.points[3].idle = true;
    judge(set);
    EXPECT_EQ(cheapest_good(set)->point.label, "64");
    EXPECT_EQ(cheapest_as_exact(set)->point.label, "defaults");
    EXPECT_FALSE(set.points[2].on_front);
}

TEST(Data, json_has_all_fields_and_null_for_non_finite_numbers) {
    WorkPrecisionSet set = usual();
    set.points[1].all.picture.samples.psnr = INFINITY;
    set.points[2].failure = "it broke";
    const auto json = nlohmann::json::parse(to_json(set));
    EXPECT_EQ(json["schema"], "tidemark study 1");
    EXPECT_EQ(json["points"].size(), 6u);
    EXPECT_TRUE(json["points"][1]["all"]["picture"]["psnr_db"].is_null());
    EXPECT_EQ(json["points"][0]["views"]["first"]["wall_ms"]["runs"], 30);
    EXPECT_EQ(json["points"][2]["failure"], "it broke");
    EXPECT_FALSE(json["points"][0]["all"].contains("hits"));
    EXPECT_EQ(json["references"]["picture"]["uncertainty"], 1e-5);
}

TEST(Data, csv_has_a_row_for_each_view_and_quotes_fields) {
    WorkPrecisionSet set = usual();
    set.points[0].point.label = "a \"b\", c";
    const std::string csv = to_csv(set);
    EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 2 * 6);
    EXPECT_THAT(csv, HasSubstr("\"a \"\"b\"\", c\""));
    const std::string head = csv.substr(0, csv.find('\n'));
    const std::string last = csv.substr(csv.rfind('\n', csv.size() - 2) + 1);
    EXPECT_EQ(std::ranges::count(head, ','), std::ranges::count(last, ','));
}

TEST(Html, escapes_and_needs_no_network) {
    WorkPrecisionSet set = usual();
    set.points[2].failure = "a <b> & c";
    set.study.omissions = {"left <out>"};
    PageMedia media{
        "first", PagePicture{"reference", "maps/reference.png", "data:image/png;base64,AA=="}, {}};
    media.points.resize(set.points.size());
    media.points[1] = {{"<8>", "maps/01-picture.png", "data:image/png;base64,BB=="},
                       {"large", "maps/01-flip.png", ""}};
    const std::string html = to_html(set, media);
    EXPECT_THAT(html, HasSubstr("a &lt;b&gt; &amp; c"));
    EXPECT_THAT(html, HasSubstr("left &lt;out&gt;"));
    EXPECT_THAT(html, HasSubstr("&lt;8&gt;"));
    EXPECT_THAT(html, HasSubstr("<a href=\"maps/01-flip.png\">large</a>"));
    EXPECT_THAT(html, Not(HasSubstr("http:")));
    EXPECT_THAT(html, Not(HasSubstr("https:")));
    EXPECT_THAT(html, Not(HasSubstr("<of it>")));
}

TEST(Html, numbers_have_three_digits_and_nan_is_a_dash) {
    for (const auto& [value, text] : std::vector<std::pair<double, std::string>>{{0, "0"},
                                                                                 {0.0121, "0.0121"},
                                                                                 {0.58, "0.580"},
                                                                                 {-7, "-7.00"},
                                                                                 {134.4, "134"},
                                                                                 {20000, "20000"},
                                                                                 {1.5e-7, "1.50e-07"},
                                                                                 {INFINITY, "&infin;"},
                                                                                 {NAN, "&ndash;"}})
        EXPECT_EQ(number(value), text);
}

TEST(Baseline, reports_only_slower_and_less_exact_points) {
    const std::string old = to_json(usual());
    const auto same = compare_with(old, "old.json", usual());
    ASSERT_TRUE(same) << to_string(same.error());
    EXPECT_THAT(same->worse, ElementsAre());
    EXPECT_EQ(same->compared, 6u);
    const auto changed = compare_with(
        old, "old.json",
        set_of({point(1, "defaults", 0.02, 20), point(0, "8", 0.1, 7), point(0, "16", 0.0085, 10.2)}));
    ASSERT_TRUE(changed);
    EXPECT_THAT(changed->worse,
                ElementsAre(HasSubstr("defaults: less exact: RMSE of the picture 0.01 -> 0.02"),
                            HasSubstr("8: slower: 5.1 ms -> 7.14 ms")));
}

TEST(Baseline, a_new_nan_is_worse_and_an_old_nan_is_a_note) {
    const std::string good = to_json(set_of({point(0, "8", 0.1, 5)}));
    const WorkPrecisionSet broken = set_of({point(0, "8", NAN, 5)});
    EXPECT_THAT(compare_with(good, "old.json", broken)->worse, ElementsAre(HasSubstr("8: less exact: ")));
    const auto found = compare_with(to_json(broken), "old.json", set_of({point(0, "8", 0.1, 5)}));
    EXPECT_THAT(found->worse, ElementsAre());
    EXPECT_THAT(found->notes, ElementsAre("8: its error is not compared: the baseline has no number for it"));
}

TEST(Baseline, a_different_camera_is_a_different_view) {
    WorkPrecisionSet seen = usual();
    const std::string plain = to_json(seen);
    seen.study.views[0].state.camera.elevation = 5;
    const std::string through = to_json(seen);
    EXPECT_TRUE(compare_with(through, "old.json", seen));
    EXPECT_FALSE(compare_with(plain, "old.json", seen));
    EXPECT_FALSE(compare_with(through, "old.json", usual()));
    seen.study.views[0].state.camera.elevation = 21;
    EXPECT_FALSE(compare_with(through, "old.json", seen));
}

TEST(Baseline, a_different_machine_or_study_is_noted) {
    const std::string old = to_json(usual());
    WorkPrecisionSet elsewhere = set_of({point(1, "defaults", 0.01, 200)});
    elsewhere.circumstances.renderer = "another GPU";
    const auto found = compare_with(old, "old.json", elsewhere);
    EXPECT_THAT(found->worse, ElementsAre());
    EXPECT_THAT(found->notes, ElementsAre("times are not compared: the baseline is from another machine"));
    WorkPrecisionSet other = usual();
    other.study.views[0].state = render::at_time(2);
    EXPECT_EQ(compare_with(old, "old.json", other).error().message,
              "--baseline 'old.json': that study has other views or another size");
    for (const char* bad : {"{}", "[]", "3", R"({"schema": "tidemark study 1"})"})
        EXPECT_FALSE(compare_with(bad, "old.json", usual())) << bad;
}

TEST(Timing, rounds_are_spread_evenly_and_end_together) {
    for (const size_t affordable : {1, 3, 17, 39, 40, 100}) {
        size_t rounds = 0;
        for (size_t round = 0; round < 40; ++round)
            rounds += takes_part(round, affordable, 40);
        EXPECT_EQ(rounds, std::min<size_t>(affordable, 40));
        EXPECT_TRUE(takes_part(39, affordable, 40));
    }
}

TEST(Data, missing_measures_are_left_out) {
    WorkPrecisionSet set = usual();
    set.picture_standard = {};
    set.hit_standard = {"closed forms", 1e-15, "exact"};
    set.words = {"RMS error of the path length", "local solutions a node", "the bake's own setting"};
    for (WorkPrecision& p : set.points)
        p.all.hits = p.views[0].hits = HitErrors{.pixels = 4, .both = 4, .rms = p.all.picture.samples.rmse};
    judge(set);
    const auto json = nlohmann::json::parse(to_json(set));
    EXPECT_FALSE(json["references"].contains("picture"));
    EXPECT_FALSE(json["points"][0]["all"].contains("picture"));
    EXPECT_EQ(json["error"], "RMS error of the path length");
    const std::string page = to_html(set, {});
    EXPECT_THAT(page, Not(HasSubstr("PSNR")));
    EXPECT_THAT(page, Not(HasSubstr("float target")));
    EXPECT_THAT(sentences(set), ElementsAre(HasSubstr("faster than the bake's own setting: 16")));
}

/// Two points of one view that have no times yet.
WorkPrecisionSet untimed() {
    WorkPrecisionSet set = set_of({point(1, "defaults", 0.01, 20), point(0, "8", 0.1, 5)});
    for (WorkPrecision& p : set.points)
        p.wall.clear(), p.cpu.clear(), p.views[0].wall = p.all.wall = {};
    return set;
}

const Watch k_unwatched{[](const std::string&, size_t) {}, [] {}, [] { return true; }};

TEST(Timing, a_slow_first_drawing_does_not_take_the_rounds_of_a_fast_scene) {
    WorkPrecisionSet set = untimed();
    std::array<size_t, 2> runs{};
    const auto run = [&](size_t index, size_t, bool) {
        const double wall = runs[index]++ == 0 ? 9000 : 20; // the driver compiles for nine seconds
        return Cost{{wall, wall}, {}};
    };
    EXPECT_TRUE(time_points({2, 7, 1}, k_unwatched, run, set)); // half a second for each point: 25 drawings
    EXPECT_THAT(runs, ElementsAre(9, 9));
    EXPECT_EQ(set.points[1].all.time().median, 20);
}

TEST(Timing, slow_scenes_are_not_drawn_beyond_the_budget) {
    WorkPrecisionSet set = untimed();
    size_t runs = 0;
    const auto run = [&](size_t, size_t, bool) { return ++runs, Cost{{9000, 9000}, {}}; };
    EXPECT_TRUE(time_points({2, 7, 1}, k_unwatched, run, set));
    EXPECT_EQ(runs, 2 + 1 + 2u); // the trial, one warm drawing, and the last round
}

// ---- Clocks ---------------------------------------------------------------------------------------------

/// A set of two points on one view, timed by a machine whose runs take 10 and 20 ms and whose driver says
/// `ratio` of that; 0: it has no timer.
WorkPrecisionSet timed_with(double ratio, size_t& asked) {
    WorkPrecisionSet set = untimed();
    asked = 0;
    const Run run = [&](size_t index, size_t, bool ask_gpu) {
        const double wall = index == 0 ? 20 : 10;
        asked += ask_gpu;
        Cost cost{{wall, 2 * wall}, {}};
        if (ask_gpu && ratio > 0)
            cost.gpu = ratio * wall;
        return cost;
    };
    EXPECT_TRUE(time_points({4, 6, 1000}, k_unwatched, run, set));
    return set;
}

TEST(Clock, the_drivers_timer_is_used_if_it_agrees_with_wall_time) {
    size_t asked = 0;
    const WorkPrecisionSet set = timed_with(0.95, asked);
    EXPECT_EQ(asked, 2u * 10);
    EXPECT_EQ(set.circumstances.clock,
              "GPU timer, which shows 0.95 to 0.95 of the wall clock around glFinish");
    EXPECT_EQ(set.points[0].all.time().median, 19);
    EXPECT_EQ(set.points[0].all.wall.median, 20);
    EXPECT_EQ(set.points[0].all.cpu.median, 40);
    const auto json = nlohmann::json::parse(to_json(set));
    EXPECT_EQ(json["points"][1]["all"]["gpu_ms"]["median"], 9.5);
    EXPECT_EQ(json["points"][1]["all"]["wall_ms"]["median"], 10);
}

TEST(Clock, a_wrong_timer_is_detected_and_no_longer_used) {
    size_t asked = 0;
    const WorkPrecisionSet set = timed_with(0.07, asked);
    EXPECT_EQ(asked, 2u * 4); // the warm-up
    EXPECT_THAT(set.circumstances.clock, HasSubstr("GPU timer shows 0.07 to 0.07 of it and is not used"));
    EXPECT_EQ(set.points[0].all.time().median, 20);
    EXPECT_FALSE(nlohmann::json::parse(to_json(set))["points"][1]["all"].contains("gpu_ms"));
}

TEST(Clock, without_a_timer_wall_time_is_used) {
    size_t asked = 0;
    EXPECT_EQ(timed_with(0, asked).circumstances.clock, "wall clock around glFinish");
}

} // namespace tidemark::lab::report_test
