#include "render/frame_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <ctime>

namespace tidemark::render {
namespace {

/// Consumes a decimal number of at least one digit and then `separator`, unless that is 0.
template <class T>
bool take_number(std::string_view& text, T& number, char separator) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || number < 0)
        return false;
    text.remove_prefix(size_t(end - text.data()));
    if (separator == 0)
        return true;
    if (!text.starts_with(separator))
        return false;
    text.remove_prefix(1);
    return true;
}

bool take_time_of_day(std::string_view& text, double& seconds) {
    int hour = 0;
    int minute = 0;
    double second = 0;
    if (!take_number(text, hour, ':') || !take_number(text, minute, ':') || !take_number(text, second, 0))
        return false;
    seconds = hour * 3600.0 + minute * 60.0 + second;
    return hour < 24 && minute < 60 && second < 61;
}

} // namespace

Result<Date> parse_date(std::string_view iso) {
    Date date{0, 0, 0, 0};
    std::string_view rest = iso;
    bool good = take_number(rest, date.year, '-') && take_number(rest, date.month, '-') &&
                take_number(rest, date.day, 0);
    if (good && (rest.starts_with('T') || rest.starts_with(' '))) {
        rest.remove_prefix(1);
        good = take_time_of_day(rest, date.seconds);
    }
    // std::chrono keeps a month in a byte: a month of 257 would look like January.
    good = good && date.year <= 9999 && date.month <= 12 && date.day <= 31;
    const std::chrono::year_month_day day{std::chrono::year(date.year),
                                          std::chrono::month(unsigned(date.month)),
                                          std::chrono::day(unsigned(date.day))};
    if (!good || !rest.empty() || !day.ok())
        return fail(ErrorCode::usage,
                    fmt::format("--date {}: give a date as in 2024-12-31 or 2024-12-31T23:59:58.5", iso));
    --date.month;
    return date;
}

Date local_date() {
    const auto now = std::chrono::system_clock::now();
    const std::time_t whole = std::chrono::system_clock::to_time_t(now);
    const auto since_epoch = std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch());
    std::tm local{};
    localtime_r(&whole, &local);
    return {local.tm_year + 1900, local.tm_mon, local.tm_mday,
            local.tm_hour * 3600 + local.tm_min * 60 + local.tm_sec +
                double(since_epoch.count() % 1000) / 1000};
}

Date later(const Date& date, double seconds) {
    using namespace std::chrono;
    constexpr double k_day = 86400;
    constexpr double k_most_days = 5e6; // years stay within the two bytes of std::chrono
    const double clock = date.seconds + seconds;
    const double days = std::clamp(std::floor(clock / k_day), -k_most_days, k_most_days);
    const year_month_day day{
        sys_days(year(date.year) / month(unsigned(date.month) + 1) / std::chrono::day(unsigned(date.day))) +
        std::chrono::days(long(days))};
    return {int(day.year()), int(unsigned(day.month())) - 1, int(unsigned(day.day())), clock - days * k_day};
}

int frame_at(double time, double fps) {
    return int(std::clamp(std::floor(time * fps), 0.0, double(k_last_frame)));
}

FrameInputs inputs_of_frame(int frame, double fps) {
    FrameInputs inputs;
    inputs.frame = frame;
    inputs.time = double(frame) / fps;
    inputs.time_delta = 1 / fps;
    inputs.frame_rate = fps;
    inputs.date = later(inputs.date, inputs.time);
    return inputs;
}

} // namespace tidemark::render
