// A frame that is drawn part by part, over as many calls as its caller likes, who is free between them. Until
// all of it is drawn its Renderer has the pictures of before; where that is dropped, nothing has happened.
#pragma once

#include "base/result.hpp"
#include "gl/fence.hpp"
#include "gl/render_target.hpp"
#include "render/frame_inputs.hpp"
#include "render/last_drawing.hpp"
#include "render/part_cursor.hpp"
#include "render/part_size.hpp"
#include "render/pass_target.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace tidemark::render {

class Renderer;

class FrameInParts {
public:
    /// Seconds of a clock that never goes back.
    using Clock = std::function<double()>;

    /// Draws nothing yet. Both must outlive it; `size` learns of each part.
    FrameInParts(Renderer& renderer, FrameInputs inputs, PartSize& size, Clock clock);

    /// Goes on for so long, and waits no longer for the driver; whether the frame is whole, which is the
    /// Renderer's last one from then on. Where the Renderer was drawn, resized or reset meanwhile, it begins
    /// anew. Fails (ErrorCode::load) where there is no memory for a second picture of a pass.
    Result<bool> draw_for(double seconds);

    /// Of its pixels, those that are drawn: 0 to 1.
    double share() const { return cursor_.share(); }
    /// What the passes took that had to be drawn, so far.
    struct PassSeconds {
        size_t pass;
        double seconds;
    };
    const std::vector<PassSeconds>& seconds() const { return seconds_; }

    /// What the driver is at.
    struct UnderWay {
        Part part;
        double begun = 0; ///< by the clock
        gl::Fence end{};
    };
    const std::optional<UnderWay>& under_way() const { return under_way_; }
    /// The frame is not wanted; what the driver is at cannot be stopped.
    static std::optional<UnderWay> give_up(FrameInParts frame) { return std::move(frame.under_way_); }

private:
    /// A pass, drawn apart.
    struct Apart {
        size_t pass;
        gl::RenderTarget surface; ///< of the target, what it stands for
        PassInputs reads;
        LastDrawing drawn{}; ///< of the pass, when all of it is
    };

    void begin();
    Result<bool> draw_until(double until);
    Result<void> begin_pass(size_t pass);
    void draw_part(const Part& ahead);
    void finish_part();
    void finish_pass();
    void exchange(Apart& apart, void (PassTarget::*surfaces)(gl::RenderTarget&));
    void keep_whole();

    Renderer* renderer_; ///< somebody else's
    FrameInputs inputs_;
    PartSize* size_; ///< likewise
    Clock clock_;
    size_t changes_ = 0; ///< of the Renderer, when it was begun
    PartCursor cursor_{{}};
    std::vector<Apart> whole_;       ///< in the order of drawing
    std::optional<Apart> drawing_{}; ///< the pass in front, once it was looked at
    std::optional<UnderWay> under_way_{};
    std::vector<PassSeconds> seconds_;
};

} // namespace tidemark::render
