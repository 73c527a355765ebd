// Diagrams of pages: axes, places of labels, and what is written as SVG.
#include "lab/report_page.hpp"
#include "lab/study_explorer.hpp"

#include <gmock/gmock.h>

#include <set>

namespace tidemark::report::scatter_test {

using testing::DoubleEq;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(LogAxis, is_linear_in_the_logarithm_with_margins) {
    const LogAxis axis{1, 100, 10, 110};
    EXPECT_DOUBLE_EQ(axis.pixel(10), 60);
    const LogAxis upwards = log_axis(0.01, 1, 400, 0);
    EXPECT_LT(upwards.pixel(0.01), 400);
    EXPECT_GT(upwards.pixel(1), 0);
    EXPECT_NEAR(400 - upwards.pixel(0.01), upwards.pixel(1), 1e-9);
    const LogAxis of_extremes = log_axis(5e-324, 1e308, 0, 100);
    EXPECT_GT(of_extremes.low, 0);
    EXPECT_LE(ticks(of_extremes).size(), 10u);
    const LogAxis of_one = log_axis(5, 5, 0, 100);
    EXPECT_NEAR(of_one.pixel(5), 50, 1e-9);
}

TEST(LogAxis, ticks_are_powers_of_ten_or_round_numbers_in_range) {
    EXPECT_THAT(ticks({0.005, 20, 0, 1}),
                ElementsAre(DoubleEq(0.01), DoubleEq(0.1), DoubleEq(1), DoubleEq(10)));
    EXPECT_THAT(ticks({4, 60, 0, 1}), ElementsAre(DoubleEq(5), DoubleEq(10), DoubleEq(20), DoubleEq(50)));
    EXPECT_THAT(ticks({6.1, 6.9, 0, 1}),
                ElementsAre(DoubleEq(6.2), DoubleEq(6.4), DoubleEq(6.6), DoubleEq(6.8)));
    EXPECT_LE(ticks({1e-20, 1e20, 0, 1}).size(), 9u);
}

TEST(LogAxis, tick_texts_are_short) {
    EXPECT_EQ(tick_text(0.05), "0.05");
    EXPECT_EQ(tick_text(200), "200");
    EXPECT_EQ(tick_text(1e-5), "10⁻⁵");
    EXPECT_EQ(tick_text(2e6), "2·10⁶");
}

TEST(LabelPlacement, no_label_covers_another_a_mark_or_the_edge) {
    std::vector<Label> labels;
    std::vector<Box> marks;
    for (int i = 0; i < 60; ++i) {
        const double x = 20 + i * 37 % 260, y = 20 + i * 53 % 160;
        labels.push_back({x, y, 24});
        marks.push_back({x - 6, y - 6, x + 6, y + 6});
    }
    const Box bounds{0, 0, 300, 200};
    std::vector<Box> placed;
    for (const auto& place : place_labels(labels, marks, bounds))
        if (place)
            placed.push_back(*place);
    EXPECT_GT(placed.size(), 20u);
    for (size_t i = 0; i < placed.size(); ++i) {
        EXPECT_TRUE(bounds.holds(placed[i]));
        for (const Box& mark : marks)
            EXPECT_FALSE(placed[i].overlaps(mark));
        for (size_t k = 0; k < i; ++k)
            EXPECT_FALSE(placed[i].overlaps(placed[k]));
    }
}

TEST(LabelPlacement, a_label_without_room_has_no_place) {
    const std::vector<Label> labels{{50, 50, 20}, {50, 50, 400}};
    const auto placed = place_labels(labels, {}, {0, 0, 100, 100});
    EXPECT_TRUE(placed[0]);
    EXPECT_FALSE(placed[1]);
}

TEST(Scatter, series_differ_by_shape_and_colour_and_texts_are_escaped) {
    std::set<std::string> marks;
    for (size_t series = 0; series < 57; ++series)
        marks.insert(mark_of(series, false));
    EXPECT_EQ(marks.size(), 57u);
    EXPECT_NE(mark_of(1, true), mark_of(1, false));
    const ScatterPlot plot{
        "<name>", "x & y", "\"error\"", {{7, 1, 2, 1, 3, 0.1, false, true, "<8>", "a\"b"}}};
    const std::string svg = to_svg(plot, {400, 300}, "wide");
    EXPECT_THAT(svg, HasSubstr("href=\"#point-7\""));
    EXPECT_THAT(svg, HasSubstr("&lt;8&gt;</text>"));
    EXPECT_THAT(svg, HasSubstr("aria-label=\"a&quot;b\""));
    EXPECT_THAT(svg, Not(HasSubstr("<8>")));
    EXPECT_EQ(to_svg({}, {400, 300}, "wide"), "");
}

TEST(Page, inserts_each_part_once_and_escapes_script_ends) {
    const std::string page =
        make_page({"{{body}} <t>", "h", "a", "<p>{{scripts}}</p>", R"({"a":"</script>"})"});
    EXPECT_THAT(page, HasSubstr("<title>{{body}} &lt;t&gt;</title>"));
    EXPECT_THAT(page, HasSubstr("<p>{{scripts}}</p>"));
    EXPECT_THAT(page, HasSubstr(R"({"a":"\u003c/script>"})"));
    EXPECT_THAT(make_page({"t", "h", "a", "b"}), Not(HasSubstr("id=\"data\"")));
    EXPECT_EQ(escaped("a\nb"), "a b");
    EXPECT_EQ(escaped_lines("a\nb\t<"), "a\nb &lt;");
}

} // namespace tidemark::report::scatter_test
