// The step between the renderer and files. Drawn frames come in; pictures, layers of an .exr, frames of a
// video, cells of a sheet or raw bytes leave, with the crop, the layout of a cube, the samples, the alpha,
// the transfer and the metadata of the plan. Does not draw.
#pragma once

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "cli/capture_plan.hpp"
#include "cli/capture_resume.hpp"
#include "host/frame_files.hpp"
#include "host/supervision.hpp"
#include "media/image.hpp"
#include "media/picture_file.hpp"
#include "media/texture_files.hpp"
#include "render/gl_context.hpp"
#include "render/renderer.hpp"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tidemark::cli {

// The results of a capture's frames: each one where --json or a sheet lists them, otherwise only what the
// final messages need, in constant memory.

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

// A frame on its way from the renderer to its files.

/// The pixels as the renderer gives them: one picture, or the faces of a cube.
using DrawnPixels = std::variant<image::Image, image::CubeFaces>;

struct DrawnFrame {
    FrameRecord record;
    DrawnPixels pixels;
};

/// A frame as it is written: one picture, or one for each face of a cube.
struct WrittenFrame {
    FrameRecord record;
    std::vector<image::Image> pictures;
};

/// Returns a cube as six upright pictures (`six_faces`) or as the panorama that ShaderToy exports; any other
/// picture as it is.
std::vector<image::Image> laid_out(DrawnPixels pixels, bool six_faces);

// Writes a frame that is drawn in tiles, band by band from the top, to a picture file or to standard output.
// Works on its own thread while the next band is drawn.

/// Adds the samples unchanged, rows from the top: the SHA-256 of `--json`.
void add_rows(Sha256& hash, const image::Image& image);

class BandOutput {
public:
    /// `stream`: nothing for standard output. `drawn`: size of the whole picture, of which `crop` is written
    /// (nothing: all of it). `hashed`: compute `sha256`.
    BandOutput(std::optional<image::PictureStream> stream, Extent drawn, std::optional<Rectangle> crop,
               bool hashed);

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
    int rows_; ///< rows of the picture below the bands so far
    std::optional<Rectangle> crop_;
    std::optional<Sha256> hash_;
    size_t not_finite_ = 0;
    size_t no_coverage_ = 0;
    image::Image band_; ///< being written
    /// Last, so that its destructor waits while the other members still exist.
    std::future<Result<void>> writing_;
};

// Reads back the passes other than the shown one, as layers of its file.

/// Returns the names of all layers, the shown pass first.
std::vector<std::string> layer_names(const render::Renderer& renderer);

/// Metadata key of --crop, which `--like` reads.
inline constexpr const char* k_crop = "Crop";

class Delivery {
public:
    /// All references must outlive it. `sound` is a WAV file for a video; empty: silent. `watchdog` is used
    /// from `open` on.
    Delivery(const CapturePlan& plan, const render::Renderer& renderer, const gl::Capabilities& driver,
             host::Watchdog& watchdog, std::filesystem::path sound);

    /// Starts the encoders. `interrupt` must outlive it.
    Result<void> open(const host::Interrupt& interrupt);
    /// Returns true if frames are written band by band. Otherwise a frame is in memory as a whole, also for
    /// several samples in one tile, as videos need it.
    bool in_bands() const;

    /// Converts a frame to what is written of it, and counts its special pixels.
    WrittenFrame prepare(DrawnFrame frame) const;
    /// Writes the frame, or queues it; returns false if the writer has failed and drawing is to stop.
    Result<bool> deliver(WrittenFrame frame);

    /// Starts the output of a frame that is drawn in bands.
    Result<std::unique_ptr<BandOutput>> open_bands(int frame) const;
    /// Registers a frame whose bands are finished.
    void add(FrameRecord record, BandOutput& bands);

    /// Waits for queued pictures; returns false once one could not be written.
    bool drain() { return !writer_ || writer_->drain(); }
    /// Finishes the output after the last frame: joins the video, writes the sheet.
    Result<void> close();
    /// Finishes an interrupted output: pictures stay; an incomplete segment of a video is dropped.
    Result<void> stop();
    /// Does the same on the watchdog's thread, while the main thread is stuck in the driver.
    void rescue();

    /// Returns the number of complete frames on disk that this run wrote.
    size_t written();
    const FrameRecords& records() const { return records_; }

private:
    Result<bool> write(const FrameRecord& record, std::vector<image::Image> pictures);
    Result<void> encode(std::string what, std::optional<double> limit,
                        const std::function<Result<void>()>& work);
    std::vector<image::PictureLayer> layers_of(const FrameRecord& record, image::Image picture) const;
    image::PictureFormat format_of(int frame) const;
    image::PictureFormat format_of_sheet() const;

    const CapturePlan& plan_;
    const render::Renderer& renderer_;
    const gl::Capabilities& driver_;
    host::Watchdog& watchdog_;
    std::filesystem::path sound_;
    const host::Interrupt* interrupt_ = nullptr;
    std::unique_ptr<host::FrameWriter> writer_; ///< of pictures
    std::optional<SegmentedVideo> video_;
    std::atomic<bool> in_encoder_ = false; ///< the main thread is using `video_`
    /// If `writer_`, `video_` and `sheet_` are empty, frames go to standard output.
    std::optional<Sheet> sheet_;
    FrameRecords records_;
};

// The sound of a video, and `tidemark capture SCENE -o sound.wav`.

/// Returns the sounds that --audio selects for a file of that name: `sound`, `inputs`, `both` or `none`;
/// empty: both. Fails (ErrorCode::usage) if the file has no sound, or the scene has nothing of the kind.
Result<render::HeardParts> parse_audio(const std::string& text, const std::filesystem::path& output,
                                       const scene::Scene& scene);

/// Returns the sound during the frames of a video, as a WAV file, and prints what is in it. Errors are
/// printed and the video lacks that sound, since pictures without sound are better than none.
std::optional<StagedFile> draw_sound_of_video(const CapturePlan& plan, const host::Interrupt& interrupt);

Result<int> capture_sound(const SoundPlan& plan);

} // namespace tidemark::cli
