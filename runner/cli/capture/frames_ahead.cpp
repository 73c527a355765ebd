#include "cli/capture/frames_ahead.hpp"

#include "base/software_renderer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace tidemark::cli {
namespace {

/// One frame is drawn while the previous one is copied and the one before that is encoded.
constexpr size_t k_depth = 2;

} // namespace

/// A driver that draws on the CPU copies pixels itself and waits for the drawing before: nothing more
/// overlaps, and there is one copy more (README.md in this folder has figures).
bool FramesAhead::pays(std::string_view renderer) {
    const char* const variable = std::getenv("TIDEMARK_READ_BACK");
    const std::string_view wish = variable ? variable : "";
    return wish == "ahead" || (wish != "at-once" && !is_software_renderer(renderer));
}

FramesAhead::FramesAhead(const render::Renderer& renderer, Watchdog& dog, std::optional<double> limit)
    : renderer_(renderer), dog_(dog), limit_(limit), ring_(k_depth) {}

bool FramesAhead::add(const FrameRecord& record, Watchdog::Clock::time_point begun) {
    if (!renderer_.read_ahead(ring_))
        return false;
    waiting_.push_back({record, begun});
    return true;
}

DrawnFrame FramesAhead::take() {
    Waiting oldest = std::move(waiting_.front());
    waiting_.pop_front();
    std::optional<Watchdog::Watch> watch;
    if (!ring_.ready())
        watch.emplace(dog_,
                      Watchdog::frame_task(oldest.record.frame, limit_, std::max(oldest.begun, last_taken_)));
    DrawnFrame frame{std::move(oldest.record), renderer_.take(ring_)};
    last_taken_ = Watchdog::Clock::now();
    return frame;
}

} // namespace tidemark::cli
