#include "host/devices.hpp"

#include <gtest/gtest.h>

namespace tidemark::platform::device_order_test {

using Names = std::vector<std::string>;

TEST(DeviceOrder, starts_with_surfaceless_where_there_is_no_graphics_card) {
    EXPECT_EQ(order_to_try({true}, true), (Names{"surfaceless", "device:0", "display"}));
    EXPECT_EQ(order_to_try({}, false), (Names{"surfaceless", "display"}));
}

TEST(DeviceOrder, starts_with_surfaceless_where_it_is_the_graphics_card) {
    EXPECT_EQ(order_to_try({true, false}, false), (Names{"surfaceless", "device:1", "device:0", "display"}));
}

TEST(DeviceOrder, a_graphics_card_goes_before_a_surfaceless_that_draws_on_the_cpu) {
    EXPECT_EQ(order_to_try({false, true, false}, true),
              (Names{"device:0", "device:2", "surfaceless", "device:1", "display"}));
}

} // namespace tidemark::platform::device_order_test
