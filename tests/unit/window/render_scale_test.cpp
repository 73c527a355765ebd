#include "window/picture_view.hpp"

#include <gtest/gtest.h>

namespace tidemark::window::render_scale_test {

TEST(RenderScale, has_a_name) {
    std::vector<std::string> names;
    for (const RenderScale scale : RenderScale::all())
        names.push_back(scale.name());
    EXPECT_EQ(names, (std::vector<std::string>{"1/8", "1/4", "1/2", "1", "2"}));
    for (const RenderScale scale : RenderScale::all())
        EXPECT_EQ(RenderScale::named(scale.name()), scale);
    EXPECT_EQ(RenderScale::named("1"), RenderScale());
    for (const char* other : {"", "0.5", "1/3", "4", "1/16", " 1"})
        EXPECT_EQ(RenderScale::named(other), std::nullopt) << other;
}

TEST(RenderScale, draws_at_least_one_whole_pixel) {
    EXPECT_EQ(RenderScale().drawn({641, 359}), (Extent{641, 359}));
    EXPECT_EQ(RenderScale().stepped(-1).drawn({640, 359}), (Extent{320, 180}));
    EXPECT_EQ(RenderScale().stepped(1).drawn({641, 359}), (Extent{1282, 718}));
    EXPECT_EQ(RenderScale().stepped(-3).drawn({3, 100}), (Extent{1, 13}));
}

TEST(RenderScale, steps_end_at_the_limits) {
    EXPECT_EQ(RenderScale().stepped(-9).name(), "1/8");
    EXPECT_EQ(RenderScale().stepped(9).name(), "2");
    EXPECT_EQ(RenderScale().stepped(1).steps_from(RenderScale().stepped(-3)), 4);
}

} // namespace tidemark::window::render_scale_test
