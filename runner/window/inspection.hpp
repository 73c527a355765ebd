// Measurements and checks of the frame on show: pass times, NaN and infinities, the origin of a NaN.
//
// The times of each pass in a window's frames, by the driver's timer. Used only while they are shown or
// needed.
#pragma once

#include "base/error.hpp"
#include "render/renderer.hpp"

#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tidemark::window {

class PassCosts {
public:
    /// Returns the timers for the next frame, after it has read those of the frame before, which is complete
    /// by now.
    std::vector<render::PassTimer>* next_frame();
    /// Records the time of a pass of the last frame that was drawn in parts, without timers.
    void took(size_t pass, double milliseconds);
    void forget();
    /// Returns the milliseconds of the pass when it was last drawn.
    std::optional<double> of(size_t pass) const;
    /// Returns the milliseconds of the frame before the one that `next_frame` was called for; none: nothing
    /// was drawn.
    std::optional<double> frame_before() const { return frame_before_; }

private:
    std::vector<render::PassTimer> timers_;
    std::map<size_t, double> milliseconds_;
    std::optional<double> frame_before_;
    std::optional<double> in_parts_; ///< of a frame drawn in parts, for the next call of next_frame
};

// Checks at intervals whether all pixels on show are finite. After it has found one that is not, it stops
// until the scene's text changes.

/// The caller passes the time, in seconds.
class FiniteWatch {
public:
    /// Starts again, for a changed text.
    void begin_anew();
    void frame_drawn() { unseen_ = true; }

    /// Returns the time of the next `look`; infinity: none is due.
    double due() const;
    /// Checks the last drawn frame, waiting for it. Returns the number of its pixels that are not finite.
    size_t look(const render::Renderer& renderer, double now);

    /// Returns the number in the first picture that had any; 0: none yet.
    size_t found() const { return found_; }

private:
    double next_ = 0;
    bool unseen_ = false; ///< a frame was drawn since the last look
    size_t found_ = 0;
};

// Traces the origin of a NaN: runs `check --trace` in a separate process while the window goes on.

/// Returns the output of `check --trace --json` as an error at the line to fix.
Error origin_of(const std::string& json);

class OriginSearch {
public:
    /// Starts this program with those arguments. `wake` is called on another thread when `take` has a result.
    /// Fails where the process cannot be started.
    static Result<std::unique_ptr<OriginSearch>> start(const std::vector<std::string>& words,
                                                       std::function<void()> wake);
    /// Kills the process.
    ~OriginSearch();
    OriginSearch(const OriginSearch&) = delete;
    OriginSearch& operator=(const OriginSearch&) = delete;

    /// Returns the output of the process once it has ended.
    std::optional<std::string> take();

private:
    OriginSearch(int process, int pipe, std::function<void()> wake);

    int process_;
    std::string printed_;
    std::atomic<bool> done_ = false;
    std::thread reader_;
};

} // namespace tidemark::window
