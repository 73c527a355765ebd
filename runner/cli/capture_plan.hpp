// The options of `tidemark capture`, and the plan made once from them: the scene, its frames with their
// states, how they are drawn, where they go, and the identity of the run. Errors in the command line are
// found here, except those that only the driver or the compiled scene shows; later code uses the plan, not
// the options.
#pragma once

#include "cli/capture_frames.hpp"
#include "host/command_line.hpp"
#include "host/devices.hpp"
#include "host/fingerprint.hpp"
#include "host/frame_files.hpp"
#include "host/program_trial.hpp"
#include "host/requests.hpp"
#include "host/supervision.hpp"
#include "media/picture_file.hpp"
#include "render/exposure.hpp"
#include "render/renderer.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

struct CaptureOptions {
    SceneRequest scene;
    FrameOptions frames;
    std::string like;                           ///< a picture; empty: none
    std::optional<FrameSequence> like_frames{}; ///< of that picture's metadata
    std::string like_fingerprint{};             ///< Fingerprint::text, of that picture's metadata
    std::optional<std::string> output;
    std::string depth;
    std::string transfer;
    bool layers = false;
    std::string alpha;
    std::string codec;
    std::optional<std::string> crop;
    platform::DeviceChoice device{};
    std::optional<double> timeout;
    std::string sheet;
    TimeSpan time{};
    std::string pad; ///< "even", or empty
    bool plain = false;
    std::optional<double> allowed_difference;
    std::optional<int> tile;
    std::optional<int> samples;
    std::optional<double> shutter;
    bool json = false;
    bool resume = false;
    bool loop = false;
    int state_every = 0;
    std::string shard;
    std::vector<std::string> words{}; ///< the arguments, without --shard, --resume and --json
};

/// Frames of a video that are encoded separately.
struct VideoSegment {
    std::vector<int> frames;
    std::vector<int> ticks; ///< for each frame, the number of video ticks that it is shown
    bool kept = false;      ///< already exists
    bool others = false;    ///< made by another shard

    bool is_to_be_made() const { return !kept && !others; }
};

struct CapturePlan {
    CaptureOptions options{}; ///< completed by --like
    scene::Scene scene;
    FrameSequence frames;
    render::FrameStates states; ///< of `frames`: the state of any frame by its number
    Fingerprint identity;       ///< of the run; its device is set when there is a context
    OutputName output;
    bool cube =
        false; ///< the shown pass is a cube, drawn as a panorama or, with {} in the name, as six faces
    std::optional<Rectangle> crop{}; ///< the part of a drawn picture that is written; nothing: all of it
    Extent written{};                ///< size of a written picture, except for six faces
    bool padded = false;             ///< `written` has a column or a row more than what is drawn
    image::SampleDepth depth = image::SampleDepth::u8;
    image::Transfer transfer = image::Transfer::srgb; ///< of the files
    image::Alpha alpha = image::Alpha::where_needed;  ///< of Image; where_needed: alpha is 1
    std::optional<SheetGrid> sheet{};                 ///< its cells are the frames
    /// Sample depth when all passes are written as layers; nothing: one picture.
    std::optional<image::SampleDepth> layers{};
    std::string codec{};                  ///< of a video; empty: the default of its file type
    VideoPace pace;                       ///< of a video
    std::vector<VideoSegment> segments{}; ///< of a video: all its frames
    render::RenderOptions drawing;        ///< for frames drawn whole
    render::Exposure exposure;
    std::optional<TrialPlan> trial; ///< of a program with stronger optimisation than `drawing` has
    std::optional<Shard> shard{};   ///< the shard that makes `frames`
    std::vector<int> kept{};        ///< frames that already exist, not in `frames`

    /// Returns the fingerprint of a frame of the run.
    Fingerprint identity_of(int frame) const { return identity.of_frame(states(frame)); }
    bool keeps_alpha() const { return alpha != image::Alpha::where_needed; }
    bool to_picture_files() const { return !output.standard_output() && !output.video(); }
};

/// Returns the transfer of a pass's samples as drawn. A buffer's samples are state, not colours.
image::Transfer drawn_transfer(const std::string& pass);

/// Returns the codec of --codec. Fails (ErrorCode::usage) if a file of that name cannot have it.
Result<std::string> parse_codec(const std::string& text, const OutputName& output);

/// Returns true if --resume could continue it.
bool can_be_resumed(const CapturePlan& plan);

/// Returns how to resume a capture that ended after so many whole frames; empty if it would start again.
std::string words_on_resuming(const CapturePlan& plan, size_t whole_frames);

/// Converts options to a plan. Loads the scene, and prints its warnings.
Result<CapturePlan> plan_capture(const CaptureOptions& options);

/// Completes the options from the picture's metadata; without --like they are unchanged. Paths outside the
/// scene's folder are left out with a message, since a file must not cause others to be read. Fails if the
/// picture holds no moment, or if its scene does not exist.
Result<CaptureOptions> with_likeness(CaptureOptions options);

/// The sound of a scene instead of its pictures.
struct SoundPlan {
    scene::Scene scene;
    OutputPath output;
    platform::DeviceChoice device;
    glsl::Precision precision = glsl::Precision::single;
    TimePart part{0, 60};
};

/// Returns true if the output is a .wav file.
bool wants_sound(const CaptureOptions& options);
Result<SoundPlan> plan_sound(const CaptureOptions& options);

// Compiles the programs that draw a plan, with tiles for large frames, and the faster of two programs if a
// trial is planned.

/// A context must be current. --timeout applies.
Result<Trial> compile(const CapturePlan& plan, Interrupt& interrupt);

/// Adds the options of `tidemark capture`, also for other code that parses its command line.
void add_capture_options(Command command, CaptureOptions& options);

/// Adds --codec, for every command that makes videos.
void add_codec_option(Command command, std::string& codec);

} // namespace tidemark::cli
