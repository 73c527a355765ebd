// The table of the host's uniforms.
#include "scene/host_uniforms.hpp"

#include <gmock/gmock.h>

#include <set>

namespace tidemark::scene::host_uniforms_test {

static_assert(host_uniform(HostValue::relative_mouse).name.empty());
static_assert(find_host_uniform("iTime")->value == HostValue::time);

TEST(HostUniforms, have_distinct_names) {
    std::set<std::string_view> names;
    for (const HostUniform& row : k_host_uniforms) {
        if (!row.name.empty()) {
            EXPECT_TRUE(names.insert(row.name).second) << row.name;
            EXPECT_EQ(find_host_uniform(row.name), &row);
            EXPECT_TRUE(is_host_uniform(row.name));
        }
        for (const std::string_view other : row.other_names)
            if (!other.empty()) {
                EXPECT_TRUE(names.insert(other).second) << other;
                EXPECT_EQ(find_host_uniform(other, true), &row);
                EXPECT_EQ(find_host_uniform(other), nullptr) << "only with the names of other hosts";
                EXPECT_FALSE(is_host_uniform(other)) << "a knob may have the name";
            }
    }
    EXPECT_EQ(find_host_uniform(""), nullptr);
    EXPECT_EQ(find_host_uniform("", true), nullptr);
    EXPECT_EQ(find_host_uniform("iTimes", true), nullptr);
}

TEST(HostUniforms, have_a_script_unless_for_the_sound_pass_only) {
    for (const HostUniform& row : k_host_uniforms)
        EXPECT_EQ(row.script.empty(), !row.image) << row.name;
}

TEST(HostUniforms, following_the_clock_have_a_range_over_time) {
    for (const HostUniform& row : k_host_uniforms) {
        const bool ranges = row.over_time.kind != RangeOverTime::Kind::constant;
        EXPECT_EQ(ranges, row.follows == Follows::clock) << row.name;
        for (size_t i = 0; i < row.over_time.low.size(); ++i)
            EXPECT_LE(row.over_time.low[i], row.over_time.high[i]) << row.name;
    }
}

TEST(HostUniforms, arrays_have_a_component_count_per_element) {
    EXPECT_EQ(component_count(host_uniform(HostValue::channel_time)), 1);
    EXPECT_EQ(component_count(host_uniform(HostValue::channel_resolution)), 3);
    EXPECT_EQ(component_count(host_uniform(HostValue::camera)), 16);
    EXPECT_EQ(component_count(host_uniform(HostValue::frame)), 1);
}

} // namespace tidemark::scene::host_uniforms_test
