#include "render/frame_state.hpp"
#include "render/pass_state.hpp"

#include <gmock/gmock.h>

#include <ctime>
#include <span>
#include <vector>

namespace tidemark::render::frame_inputs_test {

using testing::ElementsAre;

TEST(ParseDate, a_day_begins_at_midnight) {
    EXPECT_EQ(parse_date("2024-12-31"), (Date{2024, 11, 31, 0}));
    EXPECT_EQ(parse_date("1-1-1"), (Date{1, 0, 1, 0}));
}

TEST(ParseDate, months_count_from_zero_afterwards) {
    EXPECT_EQ(parse_date("2024-01-05")->month, 0);
    EXPECT_EQ(parse_date("2024-1-5")->month, 0);
}

TEST(ParseDate, with_a_time_of_day) {
    EXPECT_EQ(parse_date("2024-12-31T23:59:58.5"), (Date{2024, 11, 31, 86398.5}));
    EXPECT_EQ(parse_date("2024-12-31 00:00:00"), (Date{2024, 11, 31, 0}));
    EXPECT_EQ(parse_date("2024-12-31T01:02:03.125")->seconds, 3723.125);
    EXPECT_EQ(parse_date("2016-12-31T23:59:60")->seconds, 86400); // a leap second
}

TEST(ParseDate, leap_years) {
    EXPECT_TRUE(parse_date("2024-02-29"));
    EXPECT_TRUE(parse_date("2000-02-29"));
    EXPECT_FALSE(parse_date("2023-02-29"));
    EXPECT_FALSE(parse_date("1900-02-29"));
}

TEST(ParseDate, invalid_dates) {
    for (const std::string text :
         {"", "2024", "2024-12", "2024-12-", "2024-13-01", "2024-00-01", "2024-12-00", "2024-12-32",
          "2024-04-31", "-5-01-01", "2024-12-31T", "2024-12-31T24:00:00", "2024-12-31T23:60:00",
          "2024-12-31T23:59:61", "2024-12-31T23:59", "2024-12-31T23:59:nan", "2024-12-31T23:59:-1",
          "2024-12-31T1:55212523:58.5", "2024-12-31T2147483647:0:0", // of more seconds than an int counts
          "2024-12-31Tx", "2024-12-31Z", "2024-12-31T23:59:58Z", "2024/12/31", " 2024-12-31", "2024-12-31 ",
          // where a month or a day is kept in a byte, and a year in two, these wrap into good ones
          "2024-257-01", "2024-01-257", "67560-01-01", "10000-01-01", "99999999999-01-01"}) {
        const auto date = parse_date(text);
        ASSERT_FALSE(date) << text;
        EXPECT_EQ(date.error().code, ErrorCode::usage);
        EXPECT_EQ(date.error().message,
                  "--date " + text + ": give a date as in 2024-12-31 or 2024-12-31T23:59:58.5");
    }
}

TEST(LocalDate, is_the_local_time) {
    const std::time_t before = std::time(nullptr);
    const Date date = local_date();
    const std::time_t after = std::time(nullptr);
    std::tm day{};
    day.tm_year = date.year - 1900;
    day.tm_mon = date.month;
    day.tm_mday = date.day;
    day.tm_sec = int(date.seconds);
    day.tm_isdst = -1;
    const std::time_t said = std::mktime(&day);
    EXPECT_GE(said, before - 3600); // a night on which the clocks change
    EXPECT_LE(said, after + 3600);
    EXPECT_GE(date.seconds, 0);
    EXPECT_LT(date.seconds, 86401);
}

TEST(Later, adds_seconds_to_the_time_of_day) {
    EXPECT_EQ(later({2024, 0, 1, 43200}, 0), (Date{2024, 0, 1, 43200}));
    EXPECT_EQ(later({2024, 0, 1, 43200}, 0.125), (Date{2024, 0, 1, 43200.125}));
    EXPECT_EQ(later({2024, 0, 1, 43200}, 43199.75), (Date{2024, 0, 1, 86399.75}));
    EXPECT_EQ(later({2024, 0, 1, 100}, -0.5), (Date{2024, 0, 1, 99.5}));
}

TEST(Later, midnight_ends_days_months_and_years) {
    EXPECT_EQ(later({2024, 0, 1, 86399.5}, 0.5), (Date{2024, 0, 2, 0}));
    EXPECT_EQ(later({2024, 1, 28, 86399}, 2), (Date{2024, 1, 29, 1}));
    EXPECT_EQ(later({2024, 1, 29, 86399}, 2), (Date{2024, 2, 1, 1}));
    EXPECT_EQ(later({2023, 1, 28, 86399}, 2), (Date{2023, 2, 1, 1}));
    EXPECT_EQ(later({2000, 1, 28, 86399}, 2), (Date{2000, 1, 29, 1}));
    EXPECT_EQ(later({1900, 1, 28, 86399}, 2), (Date{1900, 2, 1, 1}));
    EXPECT_EQ(later({2024, 3, 30, 86399}, 2), (Date{2024, 4, 1, 1}));
    EXPECT_EQ(later({2024, 11, 31, 86398.5}, 2), (Date{2025, 0, 1, 0.5}));
    EXPECT_EQ(later({2025, 0, 1, 0.5}, -2), (Date{2024, 11, 31, 86398.5}));
    EXPECT_EQ(later({2024, 0, 1, 0}, 366 * 86400.0 + 1), (Date{2025, 0, 1, 1}));
    EXPECT_EQ(later({2024, 0, 1, 0}, 86400e6).day >= 1, true) << "however late it is";
    EXPECT_EQ(later({1, 0, 1, 0}, -1e300).month >= 0, true);
}

TEST(InputsOfFrame, the_date_advances_with_the_time) {
    EXPECT_EQ(inputs_of_frame(90, 30).date, (Date{2024, 0, 1, 43203}));
    EXPECT_EQ(inputs_of_frame(60 * 43200, 60).date, (Date{2024, 0, 2, 0}));
}

TEST(InputsOfFrame, time_is_the_frame_over_the_rate) {
    const FrameInputs inputs = inputs_of_frame(90, 30);
    EXPECT_EQ(inputs.frame, 90);
    EXPECT_EQ(inputs.time, 3);
    EXPECT_EQ(inputs.time_delta, 1 / 30.0);
    EXPECT_EQ(inputs.frame_rate, 30);
    EXPECT_EQ(inputs_of_frame(0, 60).time, 0);
}

TEST(InputsOfFrame, time_is_computed_in_double) {
    EXPECT_EQ(inputs_of_frame(1'000'000, 60).time, 1'000'000 / 60.0);
    EXPECT_NE(inputs_of_frame(1'000'000, 60).time, double(1'000'000 / 60.0f));
    EXPECT_EQ(inputs_of_frame(100'000'000, 59.94).time, 100'000'000 / 59.94);
    // Adding up steps of 1/60 would be off by then.
    double sum = 0;
    for (int i = 0; i < 1'000'000; ++i)
        sum += 1 / 60.0;
    EXPECT_NE(sum, inputs_of_frame(1'000'000, 60).time);
}

TEST(FrameInputs, deterministic_by_default) {
    const FrameInputs inputs;
    EXPECT_EQ(inputs.date, (Date{2024, 0, 1, 43200}));
    EXPECT_EQ(inputs.mouse, glm::vec4(0));
    EXPECT_EQ(inputs.camera, glm::mat4(1));
    EXPECT_EQ(k_sample_rate, 44100);
}

std::vector<double> value(scene::HostValue host, const FrameInputs& inputs,
                          const ChannelFacts& channels = {}) {
    const UniformNumbers numbers = value_of(host, inputs, {8, 4}, channels);
    const std::span<const double> all = numbers;
    return {all.begin(), all.end()};
}

TEST(ValueOf, has_the_components_of_its_type) {
    for (const scene::HostUniform& row : scene::k_host_uniforms) {
        const size_t elements = row.length > 0 ? size_t(scene::k_channel_count) : 1;
        EXPECT_EQ(value(row.value, {}).size(), elements * component_count(row)) << row.name;
    }
}

TEST(ValueOf, depends_on_frame_pass_and_channels) {
    FrameInputs inputs;
    inputs.time = 0.1;
    inputs.mouse = {2, 3, -1, 0};
    ChannelFacts channels;
    channels[1].time = 7;
    EXPECT_THAT(value(scene::HostValue::resolution, inputs), ElementsAre(8, 4, 1));
    EXPECT_THAT(value(scene::HostValue::time, inputs), ElementsAre(0.1));
    EXPECT_THAT(value(scene::HostValue::time_low, inputs), ElementsAre(0.1 - double(0.1f)));
    EXPECT_THAT(value(scene::HostValue::relative_mouse, inputs), ElementsAre(0.25, 0.75));
    EXPECT_EQ(value(scene::HostValue::channel_time, inputs, channels)[1], 7);
}

TEST(ValueOf, a_beat_is_the_time_in_parts_of_a_minute) {
    const auto beat = [](const FrameState& state) { return value(scene::HostValue::beat, inputs_of(state)); };
    EXPECT_THAT(beat({.time = 1.25}), ElementsAre(2.5));
    EXPECT_THAT(beat({.time = 1.25, .bpm = 90}), ElementsAre(1.875));
    EXPECT_THAT(beat({.frame = 60, .fps = 30, .bpm = 60}), ElementsAre(2));
    EXPECT_THAT(value(scene::HostValue::beat, inputs_of_frame(90, 60)), ElementsAre(3));
}

} // namespace tidemark::render::frame_inputs_test
