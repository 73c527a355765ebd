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
#include "lab/lens.hpp"
#include "media/picture_file.hpp"
#include "render/exposure.hpp"
#include "render/renderer.hpp"
#include "render/sound_renderer.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

/// `--like`: the picture whose metadata complete the options.
struct LikeOptions {
    std::string picture;                         ///< empty: none
    std::optional<host::FrameSequence> frames{}; ///< of its metadata, like the next field
    std::string fingerprint{};                   ///< Fingerprint::text
};

/// How files are encoded.
struct EncodingOptions {
    std::string depth;
    std::string transfer;
    std::string alpha;
    std::string codec;
    std::string pad;   ///< "even", or empty
    std::string audio; ///< "sound", "inputs", "both" or "none"; empty: both
    bool layers = false;
};

/// How frames are drawn.
struct DrawingOptions {
    bool plain = false;
    std::optional<double> allowed_difference;
    std::optional<int> tile;
    std::optional<int> samples;
    std::optional<double> shutter;
};

/// How the command runs: where, how long, how often it saves, and what it prints.
struct RunOptions {
    host::DeviceChoice device{};
    bool es = false; ///< with OpenGL ES
    std::optional<double> timeout;
    bool json = false;
    bool resume = false;
    bool loop = false;
    int state_every = 0;
    std::string shard;
    std::vector<std::string> words{}; ///< the arguments, without --shard, --resume and --json
};

struct CaptureOptions {
    host::SceneRequest scene;
    host::FrameOptions frames;
    TimeSpan time{};
    LikeOptions like;
    std::optional<std::string> output;
    std::optional<std::string> crop;
    std::string sheet;
    std::string lens; ///< empty: the picture
    EncodingOptions encoding;
    DrawingOptions drawing;
    RunOptions run;
};

/// Frames of a video that are encoded separately.
struct VideoSegment {
    std::vector<int> frames;
    std::vector<int> ticks; ///< for each frame, the number of video ticks that it is shown
    bool kept = false;      ///< already exists
    bool others = false;    ///< made by another shard

    bool is_to_be_made() const { return !kept && !others; }
};

/// The part of the drawn pixels that a picture is written from, and how.
struct WrittenArea {
    /// The shown pass is a cube, drawn as a panorama or, with {} in the name, as six faces.
    bool cube = false;
    std::optional<Rectangle> crop{};  ///< the part of a drawn picture that is written; nothing: all of it
    Extent written{};                 ///< size of a written picture, except for six faces
    bool padded = false;              ///< `written` has a column or a row more than what is drawn
    std::optional<SheetGrid> sheet{}; ///< its cells are the frames
};

/// How the samples of a picture are stored.
struct SampleEncoding {
    image::SampleDepth depth = image::SampleDepth::u8;
    image::Transfer transfer = image::Transfer::srgb; ///< of the files
    image::Alpha alpha = image::Alpha::where_needed;  ///< of Image; where_needed: alpha is 1
    /// Sample depth when all passes are written as layers; nothing: one picture.
    std::optional<image::SampleDepth> layers{};
    bool lens_numbers = false; ///< the file holds the numbers of a lens, without a legend
};

struct VideoPlan {
    std::string codec{}; ///< empty: the default of its file type
    VideoPace pace;
    std::vector<VideoSegment> segments{}; ///< all its frames
};

struct DrawingPlan {
    render::RenderOptions options; ///< for frames drawn whole
    render::Exposure exposure;
    std::optional<lab::LensPlan> lens{};  ///< its numbers are drawn instead of the picture
    std::optional<host::TrialPlan> trial; ///< of a program with stronger optimisation than `options` has
};

struct CapturePlan {
    CaptureOptions options{}; ///< completed by --like
    scene::Scene scene;
    host::FrameSequence frames;
    render::FrameStates states; ///< of `frames`: the state of any frame by its number
    host::Fingerprint identity; ///< of the run; its device is set when there is a context
    host::OutputName output;
    WrittenArea area;
    SampleEncoding encoding;
    VideoPlan video;
    DrawingPlan drawing;
    std::optional<Shard> shard{}; ///< the shard that makes `frames`
    std::vector<int> kept{};      ///< frames that already exist, not in `frames`

    /// Returns the fingerprint of a frame of the run.
    host::Fingerprint identity_of(int frame) const { return identity.of_frame(states(frame)); }
    bool keeps_alpha() const { return encoding.alpha != image::Alpha::where_needed; }
    bool to_picture_files() const { return !output.standard_output() && !output.video(); }
};

/// Returns the transfer of a pass's samples as drawn. A buffer's samples are state, not colours.
image::Transfer drawn_transfer(const std::string& pass);

/// Returns the codec of --codec. Fails (ErrorCode::usage) if a file of that name cannot have it.
Result<std::string> parse_codec(const std::string& text, const host::OutputName& output);

/// Sets what --lens changes in a plan whose frames, output and encoding are known; nothing without --lens.
Result<void> plan_lens_output(CapturePlan& plan);
/// Plans the lens for the loaded scene; nothing without --lens.
Result<void> plan_lens(CapturePlan& plan);

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
    host::DeviceChoice device;
    glsl::Precision precision = glsl::Precision::single;
    TimePart part{0, 60};
    render::HeardParts heard{};
};

/// Returns true if the output is a .wav file.
bool wants_sound(const CaptureOptions& options);
Result<SoundPlan> plan_sound(const CaptureOptions& options);

/// Adds the options of `tidemark capture`, also for other code that parses its command line.
void add_capture_options(host::Command command, CaptureOptions& options);

/// Adds --codec, for every command that makes videos.
void add_codec_option(host::Command command, std::string& codec);

} // namespace tidemark::cli
