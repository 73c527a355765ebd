#include "cli/view/window_options.hpp"

#include "base/try.hpp"
#include "cli/command_line.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>

namespace tidemark::cli {
namespace {

/// Bound of plausible screen coordinates, in pixels.
constexpr int k_farthest_place = 1 << 15;

Result<platform::ScreenPoint> parse_position(const std::string& text) {
    platform::ScreenPoint point;
    const char* const end = text.data() + text.size();
    const auto x = std::from_chars(text.data(), end, point.x);
    const bool has_two = x.ec == std::errc{} && x.ptr != end && *x.ptr == ',';
    const auto y = has_two ? std::from_chars(x.ptr + 1, end, point.y) : x;
    const bool far = std::abs(point.x) > k_farthest_place || std::abs(point.y) > k_farthest_place;
    if (!has_two || y.ec != std::errc{} || y.ptr != end || far)
        return fail(
            ErrorCode::usage,
            fmt::format("--position {}: give X,Y, the window's left upper corner, as in 100,50", text));
    return point;
}

} // namespace

void add_window_options(Command command, WindowOptions& options) {
    command.add_flag("--on-top", options.on_top, "The window stays above the others");
    command
        .add_option("--monitor", options.monitor,
                    "Opens the window on that monitor, in its middle; 1 is the first")
        .type_name("N")
        .check(number<int>("a monitor's number from 1", 1));
    command
        .add_option("--position", options.position,
                    "Left upper corner of the window, on the screen or on the monitor of --monitor")
        .type_name("X,Y");
    command.add_flag("--output-window", options.output,
                     "A second window that shows the picture and nothing else");
    command
        .add_option("--output-monitor", options.output_monitor,
                    "The same, full screen on that monitor; 1 is the first")
        .type_name("N")
        .check(number<int>("a monitor's number from 1", 1));
}

Result<platform::WindowWishes> resolve(const WindowOptions& options) {
    platform::WindowWishes wishes;
    wishes.monitor = options.monitor;
    wishes.on_top = options.on_top;
    if (options.position)
        wishes.position = TRY(parse_position(*options.position));
    return wishes;
}

} // namespace tidemark::cli
