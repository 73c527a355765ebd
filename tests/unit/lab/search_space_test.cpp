// The points of a search: any first part of the list is spread over all that the scene reads.
#include "lab/probe_inputs.hpp"
#include "support/scene_of.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab::search_space_test {

constexpr const char* k_text =
    "#iUniform float level = 0.5 in { 0.0, 2.0 }\n"
    "#iUniform int count = 3 in { 1, 9 }\n"
    "void mainImage(out vec4 c, in vec2 p) { c = vec4(iTime - 431.5, level, count, 1.0); }\n";

TEST(SearchSpace, TheFirstMomentsAreSpread) {
    const scene::Scene scene = scene_of(k_text);
    const auto points = SearchSpace(scene, {}, {.time = true}).survey();
    std::vector<double> early;
    for (size_t i = 0; i < points.size() / 2; ++i)
        if (points[i].time < 128)
            early.push_back(points[i].time);
    std::ranges::sort(early);
    double gap = early.front();
    for (size_t i = 1; i < early.size(); ++i)
        gap = std::max(gap, early[i] - early[i - 1]);
    EXPECT_LT(gap, 8);
    EXPECT_TRUE(std::ranges::any_of(points, [](const SearchPoint& each) { return each.time == 431.5; }));
}

TEST(SearchSpace, KnobsStayWithinTheirRange) {
    const scene::Scene scene = scene_of(k_text);
    Promises promises;
    promises.ranges["level"] = {0.25, 0.75};
    const SearchSpace space(scene, promises, {.time = true, .mouse = true});
    double low = 1, high = 0;
    for (const SearchPoint& point : space.survey()) {
        low = std::min(low, point.knobs[0][0]);
        high = std::max(high, point.knobs[0][0]);
        for (const scene::KnobSetting& setting : space.state(point, {64, 36}).knobs)
            if (setting.name == "count") {
                const double count = setting.value.numbers[0];
                EXPECT_EQ(count, std::floor(count));
            }
    }
    EXPECT_GE(low, 0.25);
    EXPECT_LT(low, 0.32);
    EXPECT_LE(high, 0.75);
    EXPECT_GT(high, 0.68);
}

TEST(SearchSpace, InputsThatASceneDoesNotReadStayFixed) {
    const scene::Scene scene = scene_of("void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }");
    EXPECT_EQ(SearchSpace(scene, {}, {}).survey().size(), 1u);
}

} // namespace tidemark::lab::search_space_test
