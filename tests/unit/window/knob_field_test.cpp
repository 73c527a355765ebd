// Which widget a knob gets, and the values that it gives.
#include "host/overlay_fields.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tidemark::overlay::knob_field_test {

using scene::Knob;
using scene::KnobRange;
using scene::KnobType;
using scene::KnobValue;

TEST(KnobField, has_the_widget_of_its_type) {
    EXPECT_EQ(widget_of({.name = "k", .type = KnobType::float1}), Widget::drag);
    EXPECT_EQ(widget_of({.name = "k", .type = KnobType::float1, .range = KnobRange{{0}, {1}}}),
              Widget::slider);
    EXPECT_EQ(widget_of({.name = "k", .type = KnobType::color3, .range = KnobRange{{0}, {1}}}),
              Widget::colour);
    EXPECT_EQ(
        widget_of({.name = "k", .type = KnobType::int1, .range = KnobRange{{0}, {1}}, .step = KnobValue{1}}),
        Widget::check_box);
    EXPECT_EQ(widget_of({.name = "k",
                         .type = KnobType::ivec2,
                         .range = KnobRange{{0, 0}, {1, 1}},
                         .step = KnobValue{1, 1}}),
              Widget::slider);
}

TEST(KnobField, steps_start_at_the_low_end) {
    const Knob knob{.name = "k", .range = KnobRange{{0.05}, {2}}, .step = KnobValue{0.1}};
    EXPECT_EQ(in_steps(knob, 0, 0.349), 0.35);
    EXPECT_EQ(in_steps(knob, 0, 1.96), 1.95);
    EXPECT_EQ(in_steps({.name = "k", .step = KnobValue{1}}, 0, 2.6), 3);
    EXPECT_EQ(in_steps({.name = "k"}, 0, 0.12345), 0.12345);
    EXPECT_EQ(in_steps({.name = "k", .step = KnobValue{0}}, 0, 0.12345), 0.12345);
}

TEST(KnobField, has_no_slider_for_a_huge_range) {
    EXPECT_EQ(widget_of({.name = "k", .range = KnobRange{{-1.7e308}, {1.7e308}}}), Widget::drag);
}

TEST(KnobField, accepts_values_within_its_type) {
    const Knob whole{.name = "k", .type = KnobType::int1};
    EXPECT_TRUE(takes(whole, -2147483648.0));
    EXPECT_FALSE(takes(whole, 1e12));
    EXPECT_TRUE(takes({.name = "k"}, 1e12));
    EXPECT_FALSE(takes({.name = "k"}, HUGE_VAL));
    EXPECT_FALSE(takes({.name = "k"}, std::nan("")));
}

TEST(KnobField, is_marked_if_it_differs_from_the_default) {
    const KnobField field{{.name = "k", .initial = {1}, .value = {2}}, {1}};
    EXPECT_FALSE(field.is_turned());
}

} // namespace tidemark::overlay::knob_field_test
