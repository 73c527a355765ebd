// The window's title: its state, or the reason why it waits.
#include "cli/view/viewer.hpp"

#include <fmt/format.h>

namespace tidemark::cli {
namespace {

/// Compiling is not mentioned before this time.
constexpr double k_short_wait_seconds = 0.3;
/// Returns the first error, on one line.
std::string headline(const Error& error) {
    for (const Diagnostic& diagnostic : error.diagnostics)
        if (diagnostic.severity == Severity::error)
            return to_string(diagnostic);
    return error.message;
}

} // namespace

bool Viewer::compiles_for_long(double now) const {
    const auto since = scene_.building_since();
    return since && now - *since > k_short_wait_seconds;
}

/// Sets the title: the compile time while compiling, else the error if there is one, else the state with the
/// frame rate, which changes twice a second at most.
void Viewer::show_title(double now) {
    std::string state = stepping_ ? fmt::format("stepping to frame {}, Esc gives up", stepping_->where().last)
                        : given_up_       ? "given up, space goes on"
                        : clock_.paused() ? fmt::format("paused at {:.3f} s", shown_.seconds())
                        : at_rest_        ? "still"
                                          : fmt::format("{:.0f} fps", clock_.frame_rate());
    if (const std::string words = drawing_words(now); !words.empty())
        state = words;
    if (scale_ != render::RenderScale())
        state += fmt::format(", scale {}", scale_.name());
    if (frozen_)
        state += ", frozen";
    if (finite_.found() > 0)
        state += fmt::format(", {} pixel{} not finite", finite_.found(), finite_.found() > 1 ? "s" : "");
    if (compiles_for_long(now))
        state = fmt::format("compiling… {:.0f} s{}", now - *scene_.building_since(),
                            stage_ ? ", Esc gives up" : "");
    else if (!stage_ && !scene_.failure())
        return;
    std::string title = scene_.failure() && !compiles_for_long(now)
                            ? (stage_ ? "" : "waiting: ") + headline(*scene_.failure())
                            : fmt::format("{} - tidemark - {}", scene_.name(), state);
    if (title == title_)
        return;
    title_ = std::move(title);
    screen_->set_title(title_);
}

} // namespace tidemark::cli
