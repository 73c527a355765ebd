// Runs `tidemark capture`: draws the frames of a plan and passes them to the encoders.
#pragma once

#include "cli/capture_output.hpp"
#include "cli/capture_plan.hpp"
#include "cli/capture_resume.hpp"
#include "host/fingerprint.hpp"
#include "host/frame_files.hpp"
#include "host/moment.hpp"
#include "host/supervision.hpp"
#include "render/frame_stepper.hpp"
#include "render/gl_context.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

class Capture {
public:
    /// `plan` and `compiled` must outlive it. `sound` is a WAV file for a video; empty: silent.
    Capture(const CapturePlan& plan, Fingerprint fingerprint, Trial& compiled,
            std::filesystem::path sound = {});

    /// Starts from a saved state instead of the beginning. Call it before `run`.
    void start_from(const SavedState& state) { start_ = &state; }

    /// Draws and delivers every frame; returns false if it was interrupted.
    Result<bool> run(Interrupt& interrupt);

    /// Returns the number of complete frames on disk, including those kept from before: `--resume` continues
    /// from them.
    size_t whole_frames();

    const FrameRecords& records() const { return records_; }
    /// Valid for a complete sequence.
    const LoopCheck& loop() const { return loop_; }
    /// Returns the report of `--json`.
    nlohmann::ordered_json report() const;

private:
    using Clock = Watchdog::Clock;
    enum class Outcome { made, interrupted, unwanted };
    /// The work on one frame.
    struct Work {
        Clock::time_point begun = Clock::now(); ///< includes the frames that lead to it
        Clock::time_point start = begun;
        std::optional<Watchdog::Watch> watch;
    };

    bool in_bands() const;
    bool keeps_alpha() const { return plan_.alpha != image::Alpha::where_needed; }
    void prepare(Interrupt& interrupt);
    void restore();
    bool draws_ahead() const;
    Result<Outcome> make(int frame, const Interrupt& interrupt);
    Result<Outcome> make_ahead(int frame, const Interrupt& interrupt);
    Result<Outcome> hand_over_ahead(DrawnFrame drawn);
    Result<Outcome> hand_over_all_ahead();
    Result<bool> step_to(int frame, const Interrupt& interrupt, FrameRecord& record, Work& work);
    Result<bool> prepare_for(int frame, bool long_way);
    Result<std::optional<DrawnFrame>> draw(int frame, const Interrupt& interrupt);
    Result<void> check_driver(const std::string& doing);
    void look_at(DrawnFrame& drawn);
    Result<Outcome> hand_over(DrawnFrame drawn);
    Result<bool> close_loop(const Interrupt& interrupt);
    Result<Outcome> make_in_tiles(int frame, const Interrupt& interrupt);
    Result<std::unique_ptr<BandOutput>> open_bands(const FrameRecord& record) const;
    image::Image read_back() const;
    std::optional<image::Image> draw_samples(int frame, const Interrupt& interrupt);
    Result<bool> deliver(const FrameRecord& record, image::Image image);
    std::vector<image::PictureLayer> layers_of(const FrameRecord& record, image::Image image) const;
    image::PictureFormat format_of(const FrameRecord& record) const;
    image::PictureFormat format_of_sheet() const;
    Result<void> open_output();
    Result<void> close_output();
    Result<void> encode(std::string what, std::optional<double> limit,
                        const std::function<Result<void>()>& work);
    void rescue_output();

    const CapturePlan& plan_;
    Fingerprint fingerprint_; ///< of the run
    render::Renderer& renderer_;
    bool in_doubt_; ///< another run might choose another program
    gl::Capabilities driver_;
    render::FrameStates states_;
    render::FrameStepper stepper_;
    StateSaver saver_;
    const SavedState* start_ = nullptr;
    double prepare_milliseconds_ = 0;
    std::filesystem::path sound_;
    std::unique_ptr<FrameWriter> writer_; ///< of pictures
    std::optional<SegmentedVideo> video_;
    std::atomic<bool> in_encoder_ = false; ///< the main thread is using `video_`
    const Interrupt* interrupt_ = nullptr; ///< during `run`
    /// If `writer_`, `video_` and `sheet_` are empty, frames go to standard output.
    std::optional<Sheet> sheet_;
    LoopCheck loop_;
    FrameRecords records_;
    Watchdog watchdog_; ///< its thread may use all members before it
    std::optional<FramesAhead> ahead_;
};

} // namespace tidemark::cli
