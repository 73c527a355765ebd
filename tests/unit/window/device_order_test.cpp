#include "host/devices.hpp"

#include <gtest/gtest.h>

namespace tidemark::host::device_order_test {

using Names = std::vector<std::string>;

TEST(DeviceOrder, starts_with_surfaceless_without_a_graphics_card) {
    EXPECT_EQ(order_to_try({true}, true), (Names{"surfaceless", "device:0", "display"}));
    EXPECT_EQ(order_to_try({}, false), (Names{"surfaceless", "display"}));
}

TEST(DeviceOrder, starts_with_surfaceless_on_a_graphics_card) {
    EXPECT_EQ(order_to_try({true, false}, false), (Names{"surfaceless", "device:1", "device:0", "display"}));
}

TEST(DeviceOrder, a_graphics_card_precedes_software_surfaceless) {
    EXPECT_EQ(order_to_try({false, true, false}, true),
              (Names{"device:0", "device:2", "surfaceless", "device:1", "display"}));
}

TEST(DeviceName, has_one_prefix_for_opengl_es) {
    EXPECT_EQ(with_es("surfaceless"), "es:surfaceless");
    EXPECT_EQ(with_es("es:mesa:softpipe"), "es:mesa:softpipe");
    EXPECT_EQ(split_device_name("es:mesa:softpipe").name, "mesa:softpipe");
    EXPECT_TRUE(split_device_name("es:auto").es);
    EXPECT_EQ(split_device_name("device:0").name, "device:0");
    EXPECT_FALSE(split_device_name("device:0").es);
}

} // namespace tidemark::host::device_order_test
