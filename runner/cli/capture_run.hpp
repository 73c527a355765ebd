// Runs `tidemark capture`: draws the frames of a plan and passes them to their delivery.
#pragma once

#include "cli/capture_delivery.hpp"
#include "cli/capture_plan.hpp"
#include "cli/capture_resume.hpp"
#include "host/supervision.hpp"
#include "render/frame_stepper.hpp"
#include "render/gl_context.hpp"
#include "render/gl_sync.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <deque>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::cli {

// Reads frames back asynchronously: the pixels of earlier frames are copied while the driver draws the next
// one and the encoders work.

class FramesAhead {
public:
    /// Returns true if reading ahead is faster with this renderer. The environment variable
    /// TIDEMARK_READ_BACK overrides it with `ahead` or `at-once`.
    static bool pays(std::string_view renderer);

    /// `renderer` and `dog` must outlive it. `limit`: seconds for a frame.
    FramesAhead(const render::Renderer& renderer, host::Watchdog& dog, std::optional<double> limit);

    bool empty() const { return ring_.empty(); }
    bool full() const { return ring_.full(); }

    /// Adds the frame that was just drawn, whose work began at `begun`. Returns false if the driver has no
    /// memory for it.
    bool add(const FrameRecord& record, host::Watchdog::Clock::time_point begun);
    /// Returns the oldest frame; waits for it.
    DrawnFrame take();

private:
    struct Waiting {
        FrameRecord record;
        host::Watchdog::Clock::time_point begun;
    };

    const render::Renderer& renderer_;
    host::Watchdog& dog_;
    std::optional<double> limit_;
    gl::PixelRing ring_;
    std::deque<Waiting> waiting_;
    /// The time of a later frame counts from here at the earliest, so that waiting for an earlier one is not
    /// included.
    host::Watchdog::Clock::time_point last_taken_;
};

// Checks whether a sequence is a seamless loop: the frame after the last must equal the first, or at least be
// much nearer to it than two successive frames inside of the loop are to each other.

class LoopCheck {
public:
    /// Adds a frame, one picture or six; call it for each one in order, and for the frame after the last. A
    /// frame after `close` only serves the message.
    void see(std::span<const image::Image> pictures);
    /// Ends the sequence with the frame that was added last, the one after its end.
    void close();

    /// Returns whether it has seen a frame. Frames that are written count later.
    bool begun() const { return seen_ > 0; }
    bool closed() const { return closed_; }

    // After `close`:

    bool seamless() const { return is_near(closing_); }
    /// Returns true if the frame after the last is still about one step away from the first, so that the
    /// sequence may lack a frame.
    bool may_lack_a_frame() const;
    /// PSNR in dB of the frame after the last against the first.
    double closing() const { return closing_; }
    /// PSNR in dB of a step inside of the loop: from the first frame to the second, or from the last to the
    /// one after it, whichever is larger.
    double step() const { return step_; }
    /// Returns the verdict, for a sequence of these frames.
    std::string words(const std::vector<int>& frames) const;

private:
    void see(const image::Image& picture);
    bool is_near(double psnr) const;

    image::Image first_, before_, last_;
    size_t seen_ = 0;
    bool closed_ = false;
    double step_ = 0, closing_ = 0;
    double end_ = 0;                 ///< PSNR of the sequence's last frame against the first
    std::optional<double> beyond_{}; ///< the same of the frame after the closing one
};

// Compiles the programs that draw a plan, with tiles for large frames, and the faster of two programs if a
// trial is planned.

/// A context must be current. --timeout applies.
Result<host::Trial> compile(const CapturePlan& plan, host::Interrupt& interrupt);

/// Draws the numbers of a lens instead of a frame's picture.
class LensDrawing {
public:
    /// `plan` and `plain`, the scene's own renderer, must outlive it.
    static Result<LensDrawing> create(const CapturePlan& plan, render::Renderer& plain);

    /// Returns the picture with its legend, or the raw numbers, of the frame that `plain` has drawn.
    Result<image::Image> draw(int frame, const host::Interrupt& interrupt);
    /// Returns the statistics of the frame drawn last; with `all` also its numbers.
    nlohmann::ordered_json report(bool all) const;

private:
    LensDrawing(const CapturePlan& plan, lab::LensPlan lens, render::Renderer& plain)
        : plan_(&plan), lens_(std::move(lens)), plain_(&plain) {}

    const CapturePlan* plan_;
    lab::LensPlan lens_; ///< with the weights of the device
    render::Renderer* plain_;
    std::unique_ptr<render::Renderer> drawn_;
    std::optional<render::FrameStepper> stepper_; ///< of `drawn_`
    lab::LensNumbers numbers_;
};

class Capture {
public:
    /// `plan` and `compiled` must outlive it. `sound` is a WAV file for a video; empty: silent.
    Capture(const CapturePlan& plan, host::Trial& compiled, std::filesystem::path sound = {});

    /// Starts from a saved state instead of the beginning. Call it before `run`.
    void start_from(const SavedState& state) { start_ = &state; }

    /// Draws and delivers every frame; returns false if it was interrupted.
    Result<bool> run(host::Interrupt& interrupt);

    /// Returns the number of complete frames on disk, including those kept from before: `--resume` continues
    /// from them.
    size_t whole_frames();

    const FrameRecords& records() const { return delivery_.records(); }
    /// Returns a warning if the driver cuts loops in the last frame; empty if not. It draws nothing unless
    /// the text's loops may have more iterations than any driver is known to allow.
    std::string cut_loops_warning();
    /// Valid for a complete sequence.
    const LoopCheck& loop() const { return loop_; }
    /// Returns the report of `--json`.
    nlohmann::ordered_json report() const;

private:
    using Clock = host::Watchdog::Clock;
    enum class Outcome { made, interrupted, unwanted };
    /// The work on one frame.
    struct Work {
        Clock::time_point begun = Clock::now(); ///< includes the frames that lead to it
        Clock::time_point start = begun;
        std::optional<host::Watchdog::Watch> watch;
    };

    Result<void> prepare(host::Interrupt& interrupt);
    void restore();
    bool draws_ahead() const;
    Result<Outcome> make(int frame, const host::Interrupt& interrupt);
    Result<Outcome> make_ahead(int frame, const host::Interrupt& interrupt);
    Result<Outcome> hand_over_ahead(DrawnFrame drawn);
    Result<Outcome> hand_over_all_ahead();
    Result<bool> step_to(int frame, const host::Interrupt& interrupt, FrameRecord& record, Work& work);
    Result<bool> prepare_for(int frame, bool long_way);
    Result<std::optional<WrittenFrame>> draw(int frame, const host::Interrupt& interrupt);
    Result<void> check_driver(const std::string& doing);
    WrittenFrame finish(DrawnFrame drawn);
    Result<Outcome> hand_over(WrittenFrame frame);
    Result<bool> close_loop(const host::Interrupt& interrupt);
    Result<Outcome> make_in_tiles(int frame, const host::Interrupt& interrupt);
    DrawnPixels read_back() const;
    std::optional<DrawnPixels> draw_samples(int frame, const host::Interrupt& interrupt);
    void rescue_output();

    const CapturePlan& plan_;
    render::Renderer& renderer_;
    bool in_doubt_; ///< another run might choose another program
    gl::Capabilities driver_;
    render::FrameStepper stepper_;
    StateSaver saver_;
    const SavedState* start_ = nullptr;
    double prepare_milliseconds_ = 0;
    LoopCheck loop_;
    std::optional<LensDrawing> lens_;
    std::vector<nlohmann::ordered_json> lens_reports_; ///< one for each frame, with --json
    Delivery delivery_;
    host::Watchdog watchdog_; ///< its thread may use all members before it
    std::optional<FramesAhead> ahead_;
};

} // namespace tidemark::cli
