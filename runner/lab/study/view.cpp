#include "lab/study/view.hpp"

#include "base/try.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tidemark::lab {
namespace {

constexpr double k_last_time = 1e9; ///< about 30 years, far beyond a float's precision

bool take(std::string_view& text, double& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    text.remove_prefix(size_t(end - text.data()));
    return error == std::errc{};
}

bool take(std::string_view& text, char wanted) {
    if (!text.starts_with(wanted))
        return false;
    text.remove_prefix(1);
    return true;
}

} // namespace

render::FrameState state_of(const View& view, Extent extent) {
    render::FrameState state = view.state;
    state.extent = extent;
    if (view.mouse != glm::dvec2(0)) // a click that has ended
        state.mouse = render::Mouse::clicked(view.mouse * glm::dvec2(extent.width, extent.height), false);
    return state;
}

Result<void> check(const View& view) {
    const double time = view.state.seconds();
    if (!(time >= 0 && time <= k_last_time))
        return fail(ErrorCode::usage,
                    fmt::format("view '{}': the time {} is out of range; give 0 to {:g} seconds", view.name,
                                time, k_last_time));
    for (const double part : {view.mouse.x, view.mouse.y})
        if (!(part >= 0 && part <= 1))
            return fail(
                ErrorCode::usage,
                fmt::format("view '{}': the mouse at {}, {} is outside the picture; give parts of its "
                            "width and height, 0 to 1",
                            view.name, view.mouse.x, view.mouse.y));
    return {};
}

Result<std::vector<View>> parse_views(std::string_view text) {
    std::vector<View> views;
    std::string_view rest = text;
    do {
        const std::string_view begin = rest;
        View view;
        double time = 0;
        bool good = take(rest, time);
        view.state = render::at_time(time);
        if (good && take(rest, '@'))
            good = take(rest, view.mouse.x) && take(rest, ',') && take(rest, view.mouse.y);
        view.name = fmt::format("t={}", begin.substr(0, begin.size() - rest.size()));
        if (!good || (!rest.empty() && rest.front() != ';'))
            return fail(
                ErrorCode::usage,
                fmt::format("--views {}: give times and places of the mouse, as in 0;10@0.75,0.4, or a "
                            ".json file",
                            text));
        TRY(check(view));
        if (std::ranges::find(views, view.name, &View::name) != views.end())
            return fail(ErrorCode::usage,
                        fmt::format("--views {}: '{}' stands there twice", text, view.name));
        views.push_back(std::move(view));
    } while (take(rest, ';'));
    return views;
}

View unseen(const View& view, double seconds_later) {
    View later = view;
    const double fps = view.state.fps;
    const double seconds = view.state.seconds() + std::round(seconds_later * fps) / fps;
    later.state = render::at_time(seconds, view.state);
    later.name = fmt::format("t={:g}, not searched", seconds);
    return later;
}

Extent small_of(Extent extent, int longest) {
    const int longer = std::max(extent.width, extent.height);
    const auto side = [&](int length) { return std::max(1, length * longest / longer); };
    return longer <= longest ? extent : Extent{side(extent.width), side(extent.height)};
}

std::vector<View> default_views() {
    return {{"t=1", render::at_time(1)}, {"t=10", render::at_time(10)}};
}

} // namespace tidemark::lab
