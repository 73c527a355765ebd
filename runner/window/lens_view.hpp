// Lenses in a window, and the numbers beside them: the status line, the front of a knob, the hot lines. Keeps
// what is chosen and known, and decides what is drawn next.
#pragma once

#include "host/overlay_fields.hpp"
#include "render/gl_textures.hpp"
#include "window/lens_worker.hpp"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace tidemark::window {

/// The state of the lenses: the choice, the numbers that are known, the next thing to draw.
class LensView {
public:
    // Choices of the user

    /// Chooses a lens in the form of `--lens`; empty: none. A wrong text is a refusal.
    void choose(const std::string& text);
    /// Chooses the next lens (1) or the one before (-1) that the scene allows.
    void step(int direction);
    void toggle_status() { status_ = !status_; }
    void watch_lines(bool open) { lines_.numbers.open = open; }
    /// Begins the front of a knob, or goes on with it.
    void turn_knob(const std::string& knob);
    void forget_front() { front_.reset(); }

    bool on() const { return !chosen_.empty(); }
    /// Returns whether `follow` has anything to do.
    bool active() const { return on() || status_ || front_ || lines_.numbers.open || busy(); }
    /// Returns the chosen lens in the form of `--lens`; empty: none.
    const std::string& chosen() const { return chosen_; }
    bool shows_status() const { return status_; }
    /// Returns a message about the last change, once; empty: none.
    std::string take_message() { return std::exchange(message_, {}); }

    // The scene

    /// Shows another scene, or none. `refusal`: why it can have no lens; empty: it can.
    void set_scene(std::shared_ptr<const scene::Scene> scene, std::string refusal = {});
    const std::shared_ptr<const scene::Scene>& scene() const { return scene_; }
    /// Returns whether the next frame's buffers are needed.
    bool wants_buffers() const;
    /// Keeps what a frame reads of the one before.
    void keep_buffers(const render::FrameState& state, render::BufferState buffers);
    /// Returns the buffers that were kept for that frame.
    std::optional<render::BufferState> buffers_for(const render::FrameState& state) const;

    // Work

    /// Returns what to draw next; nothing: all is up to date. `plays`: the moment changes by itself.
    std::optional<LensOrder> next(const LensMoment& moment, bool plays, double now) const;
    /// Returns whether an order in progress is of no use any more.
    bool is_stale(const LensOrder& order, const LensMoment& moment) const;
    void take(LensAnswer answer, double now);
    /// Does all that with a thread. Returns whether there is something new to show.
    bool follow(const LensMoment& moment, bool plays, double now,
                const std::function<Result<host::SharedContext>()>& make_context,
                const std::function<void()>& wake);
    bool busy() const { return worker_ && worker_->busy(); }
    /// Abandons everything, and waits a moment for it.
    void stop();

    // Fields of the panels

    /// Returns the picture of the lens in the current context; null: that of the scene is shown.
    const gl::RenderTarget* target();
    void leave_context() { target_.reset(); }
    /// Returns whether another picture is to be shown than at the last call.
    bool take_fresh() { return std::exchange(fresh_, false); }
    /// Returns the size of the numbers; empty: there are none.
    Extent extent() const { return picture_ ? picture_->numbers.extent : Extent{0, 0}; }
    /// `pixel`: the one under the pointer, of the numbers.
    std::optional<overlay::LensField> field(const std::optional<std::array<int, 2>>& pixel) const;
    overlay::LensChooser chooser() const;
    const overlay::HotLinesField& hot_lines() const { return lines_.numbers; }
    const std::optional<overlay::FrontField>& front() const { return front_; }
    /// Returns the status line. `milliseconds`: of a frame of the window; none: not known.
    std::string status(std::optional<double> milliseconds) const;

private:
    void choose_lens(const lab::Lens& lens);
    /// Returns whether a lens is chosen that is not refused.
    bool wants_numbers() const;
    /// Returns whether the picture is that of the chosen lens.
    bool shows_chosen() const;
    void take(LensPicture picture);
    void take(const FrameFacts& facts, const LensOrder& order, double now);
    void refuse(const LensOrder& order, const Error& error);
    /// Returns the value of the front's knob in that moment; empty without a front.
    std::string front_value(const render::FrameState& state) const;
    bool facts_wanted(const LensMoment& moment, bool plays, double now) const;

    std::shared_ptr<const scene::Scene> scene_;
    std::string no_lens_; ///< why the scene can have no lens

    std::string chosen_;            ///< as in `--lens`
    std::optional<lab::Lens> lens_; ///< none: off, or the text is wrong
    std::string place_, variable_;  ///< of the fields in the controls
    int direction_ = 0;             ///< of `step`, until a lens is drawn; 0: chosen from the list
    std::string refusal_;
    std::map<std::string, std::string> refused_; ///< reasons by lens, for this scene
    std::string message_;

    std::optional<LensPicture> picture_;
    std::optional<render::FrameState> drawn_; ///< the moment of picture_, once its numbers are complete
    std::optional<gl::RenderTarget> target_;  ///< shows picture_; none: not made yet
    std::optional<std::pair<render::FrameState, render::BufferState>> buffers_;

    /// Numbers of the last moment for which they are known, and when they came.
    template <class T>
    struct Known {
        T numbers{};
        std::optional<render::FrameState> of{}; ///< none: nothing is known
        double at = 0;
    };
    bool status_ = false;
    Known<std::optional<FrameFacts>> facts_;
    std::optional<overlay::FrontField> front_;
    Known<overlay::HotLinesField> lines_;
    bool fresh_ = false;
    bool waits_ = false;                                ///< for the next frame, whose buffers can be kept
    LensOrder::Kind last_ = LensOrder::Kind::hot_lines; ///< kind of the last answer

    std::unique_ptr<LensWorker> worker_; ///< null: nothing was drawn yet
    std::optional<LensOrder> running_{}; ///< the last order of worker_
};

} // namespace tidemark::window
