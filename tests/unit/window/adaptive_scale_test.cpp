#include "window/picture_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace tidemark::window::adaptive_scale_test {

/// Milliseconds of a frame in a scale, `frame` frames after the start.
using Cost = std::function<double(RenderScale scale, int frame)>;

struct Outcome {
    RenderScale scale;
    int changes = 0;
};

Outcome run(AdaptiveScale& adaptive, RenderScale scale, int frames, const Cost& cost) {
    Outcome outcome{scale};
    for (int frame = 0; frame < frames; ++frame) {
        const RenderScale wanted = adaptive.after_frame(outcome.scale, cost(outcome.scale, frame));
        outcome.changes += wanted != outcome.scale;
        outcome.scale = wanted;
    }
    return outcome;
}

/// A frame at scale 1 takes so long, one of twice the side `growth` times that.
Cost cost_of(double milliseconds, double growth = 4) {
    return [=](RenderScale scale, int) {
        return milliseconds * std::pow(growth, scale.steps_from(RenderScale()));
    };
}

RenderScale scale_of(const char* name) {
    return *RenderScale::named(name);
}

constexpr double k_fps = 50; // 20 ms

TEST(AdaptiveScale, selects_a_fast_enough_scale_at_once) {
    AdaptiveScale adaptive(k_fps);
    const Outcome slow = run(adaptive, scale_of("2"), 5, cost_of(70)); // 280 ms at 2, 17.5 ms at 1/2
    EXPECT_EQ(slow.scale.name(), "1/2");
    EXPECT_EQ(slow.changes, 1);
}

TEST(AdaptiveScale, stops_at_the_smallest_and_largest_scale) {
    AdaptiveScale adaptive(k_fps);
    EXPECT_EQ(run(adaptive, scale_of("1"), 500, cost_of(1e6)).scale.name(), "1/8");
    EXPECT_EQ(run(adaptive, scale_of("1/8"), 500, cost_of(1e-3)).scale.name(), "2");
}

TEST(AdaptiveScale, rises_again_when_the_scene_is_fast) {
    AdaptiveScale adaptive(k_fps);
    EXPECT_EQ(run(adaptive, scale_of("1"), 100, cost_of(60)).scale.name(), "1/2");
    EXPECT_EQ(run(adaptive, scale_of("1/2"), 100, cost_of(12)).scale.name(), "1");
}

TEST(AdaptiveScale, does_not_react_to_single_slow_frames) {
    AdaptiveScale adaptive(k_fps);
    const Cost hitches = [](RenderScale, int frame) { return frame % 5 < 2 ? 400 : 15; };
    EXPECT_EQ(run(adaptive, scale_of("1"), 1000, hitches).changes, 0);
}

TEST(AdaptiveScale, does_not_react_to_single_quick_frames) {
    AdaptiveScale adaptive(k_fps);
    const Cost gaps = [](RenderScale, int frame) { return frame % 5 < 2 ? 0.1 : 19; };
    EXPECT_EQ(run(adaptive, scale_of("1"), 1000, gaps).changes, 0);
}

/// Whatever the scene costs, and however its cost grows with the pixels.
TEST(AdaptiveScale, does_not_flicker_between_two_scales) {
    for (double milliseconds = 1; milliseconds < 500; milliseconds *= 1.2)
        for (const double growth : {1.5, 2.0, 3.0, 4.0, 6.0, 9.0}) {
            AdaptiveScale adaptive(k_fps);
            std::mt19937 random(7);
            std::uniform_real_distribution<double> noise(0.93, 1.07);
            const Cost steady = cost_of(milliseconds, growth);
            const Cost noisy = [&](RenderScale scale, int frame) {
                return steady(scale, frame) * noise(random);
            };
            // Three steps down, one wrong step up for each scale at most.
            const Outcome settled = run(adaptive, scale_of("1"), 500, noisy);
            EXPECT_LE(settled.changes, 8) << milliseconds << " ms, growth " << growth;
            // Noise may tip the balance once, but not to and fro.
            EXPECT_LE(run(adaptive, settled.scale, 2000, noisy).changes, 1)
                << milliseconds << " ms, growth " << growth;
        }
}

TEST(AdaptiveScale, retries_a_larger_scale_after_a_while) {
    AdaptiveScale adaptive(k_fps);
    const Cost steep = cost_of(30, 12); // 2.5 ms at 1/2: 4 times that would do
    EXPECT_EQ(run(adaptive, scale_of("1"), 500, steep).scale.name(), "1/2");
    EXPECT_EQ(run(adaptive, scale_of("1/2"), 500, cost_of(11)).scale.name(), "1/2"); // once bitten
    adaptive.forget();
    EXPECT_EQ(run(adaptive, scale_of("1/2"), 500, cost_of(11)).scale.name(), "1");
}

} // namespace tidemark::window::adaptive_scale_test
