// Draws a frame in parts over several calls, between which the caller can do other work. The Renderer keeps
// the previous pictures until the whole frame is drawn; dropping the object leaves it unchanged.
#pragma once

#include "base/error.hpp"
#include "render/frame_plan.hpp"
#include "render/frame_state.hpp"
#include "render/gl_sync.hpp"
#include "render/gl_textures.hpp"
#include "render/pass_state.hpp"
#include "render/picture_parts.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace tidemark::render {

class Renderer;

class FrameInParts {
public:
    /// Monotonic clock in seconds.
    using Clock = std::function<double()>;

    /// Draws nothing yet. `renderer` and `size` must outlive the object; `size` records the time of each
    /// part.
    FrameInParts(Renderer& renderer, FrameInputs inputs, PartSize& size, Clock clock);

    /// Draws for `seconds`, including waits for the driver. Returns whether the frame is complete; it is then
    /// the Renderer's last frame. Starts again when the Renderer was drawn, resized or reset in between.
    /// Fails (ErrorCode::load) when there is no memory for a second picture of a pass.
    Result<bool> draw_for(double seconds);

    /// Returns the drawn fraction of the frame's pixels, 0 to 1.
    double share() const { return cursor_.share(); }
    /// Time spent so far on a pass that had to be drawn.
    struct PassSeconds {
        size_t pass;
        double seconds;
    };
    const std::vector<PassSeconds>& seconds() const { return seconds_; }

    /// The part that the driver is drawing.
    struct UnderWay {
        Part part;
        double begun = 0; ///< time of `clock`
        gl::Fence end{};
    };
    const std::optional<UnderWay>& under_way() const { return under_way_; }
    /// Abandons the frame. Returns the part that the driver is still drawing, because that cannot be stopped.
    static std::optional<UnderWay> give_up(FrameInParts frame) { return std::move(frame.under_way_); }

private:
    /// A pass that is drawn into a surface of its own.
    struct Apart {
        size_t pass;
        gl::RenderTarget surface; ///< exchanged with the pass's surface once complete
        PassInputs reads;
        LastDrawing drawn{}; ///< exchanged with the pass's record once complete
    };

    void begin();
    Result<bool> draw_until(double until);
    Result<void> begin_pass(size_t pass);
    void draw_part(const Part& ahead);
    void finish_part();
    void finish_pass();
    void exchange(Apart& apart, void (PassTarget::*surfaces)(gl::RenderTarget&));
    void keep_whole();

    Renderer* renderer_; ///< not owned
    FrameInputs inputs_;
    PartSize* size_; ///< not owned
    Clock clock_;
    size_t changes_ = 0; ///< the Renderer's count at the start of the frame
    PartCursor cursor_{{}};
    std::vector<Apart> whole_;       ///< in drawing order
    std::optional<Apart> drawing_{}; ///< current pass, if it needs drawing
    std::optional<UnderWay> under_way_{};
    std::vector<PassSeconds> seconds_;
};

} // namespace tidemark::render
