// What each pass of a window's frames takes, by the driver's timer: only while somebody looks.
#pragma once

#include "render/renderer.hpp"

#include <map>
#include <optional>
#include <vector>

namespace tidemark::cli {

class PassCosts {
public:
    /// For the next frame. Takes what the timers of the frame before say, which is drawn by now.
    std::vector<render::PassTimer>* next_frame();
    /// A pass of the frame before was drawn in parts: no timer knows them.
    void took(size_t pass, double milliseconds);
    void forget();
    /// Milliseconds, when it was drawn last.
    std::optional<double> of(size_t pass) const;
    /// All passes of the frame before the one that `next_frame` was called for; none: nothing was drawn.
    std::optional<double> frame_before() const { return frame_before_; }

private:
    std::vector<render::PassTimer> timers_;
    std::map<size_t, double> milliseconds_;
    std::optional<double> frame_before_;
    std::optional<double> in_parts_; ///< of the frame that is the one before next
};

} // namespace tidemark::cli
