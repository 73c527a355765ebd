// The results of a capture's frames: each one where --json or a sheet lists them, otherwise only what the
// final messages need, in constant memory.
#pragma once

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "cli/capture_plan.hpp"
#include "host/supervision.hpp"
#include "media/image.hpp"
#include "media/picture_file.hpp"
#include "render/gl_sync.hpp"
#include "render/renderer.hpp"

#include <cstdint>
#include <deque>
#include <future>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::cli {

/// The result of one frame. Its state is not stored but computed again from its number: the states of 10,000
/// frames would take 30 MB.
struct FrameRecord {
    int frame = 0;
    std::string file;
    std::string sha256;
    double milliseconds = 0;
    size_t not_finite = 0;   ///< pixels
    size_t no_coverage = 0;  ///< pixels with an alpha below 0 or above 1, where alpha is kept
    size_t passes_drawn = 0; ///< including the frames that lead to it; 0: same picture as the frame before
};

class FrameRecords {
public:
    /// Frames with a certain property: the first one and their number.
    struct Found {
        std::optional<FrameRecord> first{};
        size_t count = 0;
    };

    /// `listed`: keep each record.
    explicit FrameRecords(bool listed) : listed_(listed) {}

    void add(FrameRecord record);

    size_t count() const { return count_; }
    /// Requires at least one frame.
    const FrameRecord& first() const { return *first_; }
    const FrameRecord& last() const { return *last_; }
    const Found& not_finite() const { return not_finite_; }
    const Found& no_coverage() const { return no_coverage_; }
    /// All records if `listed`, otherwise none.
    const std::vector<FrameRecord>& list() const { return list_; }

private:
    bool listed_;
    size_t count_ = 0;
    std::optional<FrameRecord> first_;
    std::optional<FrameRecord> last_;
    Found not_finite_;
    Found no_coverage_;
    std::vector<FrameRecord> list_;
};

// A drawn frame of a capture: its pixels and its record.

struct DrawnFrame {
    FrameRecord record;
    image::Image picture;
};

// Reads frames back asynchronously: the pixels of earlier frames are copied while the driver draws the next
// one and the encoders work.

class FramesAhead {
public:
    /// Returns true if reading ahead is faster with this renderer. The environment variable
    /// TIDEMARK_READ_BACK overrides it with `ahead` or `at-once`.
    static bool pays(std::string_view renderer);

    /// `renderer` and `dog` must outlive it. `limit`: seconds for a frame.
    FramesAhead(const render::Renderer& renderer, Watchdog& dog, std::optional<double> limit);

    bool empty() const { return ring_.empty(); }
    bool full() const { return ring_.full(); }

    /// Adds the frame that was just drawn, whose work began at `begun`. Returns false if the driver has no
    /// memory for it.
    bool add(const FrameRecord& record, Watchdog::Clock::time_point begun);
    /// Returns the oldest frame; waits for it.
    DrawnFrame take();

private:
    struct Waiting {
        FrameRecord record;
        Watchdog::Clock::time_point begun;
    };

    const render::Renderer& renderer_;
    Watchdog& dog_;
    std::optional<double> limit_;
    gl::PixelRing ring_;
    std::deque<Waiting> waiting_;
    /// The time of a later frame counts from here at the earliest, so that waiting for an earlier one is not
    /// included.
    Watchdog::Clock::time_point last_taken_;
};

// Checks whether a sequence is a seamless loop: compares the frame after the last with the first, and for
// scale the second with the first.

/// Returns the frame that would come next.
int frame_behind(const std::vector<int>& frames);

class LoopCheck {
public:
    /// Adds a frame; call it for each one in order, and for the frame after the last.
    void see(const image::Image& picture);

    /// PSNR in dB of the latest frame against the first, and of the second against the first.
    double closing() const { return closing_; }
    double step() const { return step_; }
    std::string words() const;

private:
    image::Image first_;
    size_t seen_ = 0;
    double step_ = 0, closing_ = 0;
};

// Writes a frame that is drawn in tiles, band by band from the top, to a picture file or to standard output.
// Works on its own thread while the next band is drawn.

/// Writes RGB bytes to standard output, rows from the top down, as video tools read raw frames.
Result<void> put_raw(const image::Image& image);

/// Adds the samples unchanged, rows from the top: the SHA-256 of `--json`.
void add_rows(Sha256& hash, const image::Image& image);

class BandOutput {
public:
    /// `stream`: nothing for standard output. `hashed`: compute `sha256`.
    BandOutput(std::optional<image::PictureStream> stream, bool hashed);

    /// Waits until the previous band is written, starts to write this one, and returns the previous band.
    Result<image::Image> take(image::Image band);
    /// Finishes after the last band; the file appears.
    Result<void> finish();

    /// Returns the hash of the pixels, after `finish`.
    std::string sha256() { return hash_ ? hash_->digits() : std::string(); }
    /// Returns the number of pixels that are NaN or infinite, after `finish`.
    size_t not_finite() const { return not_finite_; }
    /// Returns the number of pixels whose alpha is below 0 or above 1, after `finish`; always 0 for bytes.
    size_t no_coverage() const { return no_coverage_; }

private:
    Result<void> write();
    Result<void> wait();

    std::optional<image::PictureStream> stream_;
    std::optional<Sha256> hash_;
    size_t not_finite_ = 0;
    size_t no_coverage_ = 0;
    image::Image band_; ///< being written
    /// Last, so that its destructor waits while the other members still exist.
    std::future<Result<void>> writing_;
};

// Reads back the passes other than the shown one, as layers of its file.

/// Returns the other passes in the order of drawing: `Buffer A`, and for a cube `Cube A px` to `Cube A nz`.
/// Each has the orientation of a file with that pass or face alone, but always with alpha, so that all frames
/// of a sequence have the same channels.
std::vector<image::PictureLayer> other_layers(const render::Renderer& renderer, image::SampleDepth depth);

/// Returns the names of all layers, the shown pass first.
std::vector<std::string> layer_names(const render::Renderer& renderer);

// `tidemark capture SCENE -o sound.wav`: writes the Sound pass to a file.

/// Returns the scene's sound from `start` on (seconds): interleaved left and right samples,
/// render::k_sample_rate of each a second. After an interrupt the rest is silent. A context must be current.
Result<std::vector<int16_t>> draw_sound(const scene::Scene& scene, glsl::Precision precision, double start,
                                        double duration, const Interrupt& interrupt);

/// Returns the sound during the frames of a video, as a WAV file. Errors are printed and the video is silent,
/// since pictures without sound are better than none.
std::optional<StagedFile> draw_sound_of_video(const CapturePlan& plan, const Interrupt& interrupt);

Result<int> capture_sound(const SoundPlan& plan);

} // namespace tidemark::cli
