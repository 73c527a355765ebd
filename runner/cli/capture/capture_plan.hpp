// What `tidemark capture` was told, and what that comes to: the scene, its frames, how they are drawn and
// where they go. What is wrong with the command line is said here, but for what only the driver or the
// compiled scene knows; behind the plan nobody reads the options.
#pragma once

#include "cli/capture/shard.hpp"
#include "cli/capture/sheet.hpp"
#include "cli/capture/video_pace.hpp"
#include "cli/options.hpp"
#include "cli/output_name.hpp"
#include "cli/trial.hpp"
#include "image/files/picture_file.hpp"
#include "platform/device_choice.hpp"
#include "render/exposure.hpp"
#include "render/renderer.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

/// What the picture that `--like` names says of itself.
struct Likeness {
    FrameSequence sequence;
    std::string fingerprint; ///< Fingerprint::text
};

struct CaptureOptions {
    SceneRequest scene;
    FrameOptions frames;
    std::string like; ///< a picture; empty: none
    std::optional<Likeness> likeness{};
    std::optional<std::string> output;
    std::string depth;
    std::string transfer;
    bool layers = false;
    std::string alpha;
    std::string codec;
    platform::DeviceChoice device{};
    std::optional<double> timeout;
    std::string sheet;
    std::optional<double> duration; ///< seconds
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
    std::vector<std::string> words{}; ///< as they were typed, without --shard and --resume
};

/// A trial of a program that is specialised further than `CapturePlan::drawing` says.
struct PlannedTrial {
    glsl::Specialise as_far_as = glsl::Specialise::invariant_uniforms;
    TrialPlan frames;
};

/// Frames of a video that are encoded on their own.
struct VideoSegment {
    std::vector<int> frames;
    std::vector<int> ticks; ///< of the video that each of them is shown
    bool kept = false;      ///< it is there already
    bool others = false;    ///< another shard makes it

    bool is_to_be_made() const { return !kept && !others; }
};

struct CapturePlan {
    scene::Scene scene;
    FrameSequence frames;
    OutputName output;
    image::SampleDepth depth = image::SampleDepth::u8;
    image::Transfer transfer = image::Transfer::srgb; ///< of the files
    image::Alpha alpha = image::Alpha::where_needed;  ///< of Image; where_needed: it is 1
    std::optional<SheetGrid> sheet{};                 ///< its cells are the frames
    std::optional<image::SampleDepth> layers{};       ///< the other passes' too, as this; none: one picture
    std::string codec{};                              ///< of a video; empty: that of its name
    VideoPace pace;                                   ///< of a video
    std::vector<VideoSegment> segments{};             ///< of a video: all its frames
    render::RenderOptions drawing;                    ///< frames drawn whole
    render::Exposure exposure;
    std::optional<int> tile_side;
    std::optional<PlannedTrial> trial;
    platform::DeviceChoice device;
    std::optional<double> timeout; ///< seconds for a frame
    SceneRequest request;          ///< that `scene` was loaded by
    std::string like;              ///< the picture that it should come to; empty: none
    std::optional<Likeness> likeness{};
    bool json = false;            ///< reports the frames, with the SHA-256 of their pixels
    bool resume = false;          ///< goes on where a capture was cut short
    bool loop = false;            ///< says whether the sequence goes round
    int state_every = 0;          ///< frames between two saved states of buffers; 0: none is saved
    std::optional<Shard> shard{}; ///< whose `frames` these are
    std::vector<int> kept{};      ///< frames that are there already, and no more among `frames`
    /// The command that finds where a pixel of that frame stops being a number.
    std::function<std::string(const render::FrameState&)> trace_command;

    bool to_picture_files() const { return !output.standard_output() && !output.video(); }
};

/// What the samples of a pass stand for as they are drawn. Of a buffer they are state, not colours.
image::Transfer drawn_transfer(const std::string& pass);

/// --codec, where a file of that name may have it (ErrorCode::usage otherwise).
Result<std::string> parse_codec(const std::string& text, const OutputName& output);

/// Whether --resume could go on with it.
bool can_be_resumed(const CapturePlan& plan);

/// How to go on where a capture is cut short after so many whole frames; empty: it begins anew.
std::string words_on_resuming(const CapturePlan& plan, size_t whole_frames);

/// Loads the scene, too, and prints its warnings.
Result<CapturePlan> plan_capture(const CaptureOptions& options);

/// The sound of a scene instead of its pictures.
struct SoundPlan {
    scene::Scene scene;
    OutputPath output;
    platform::DeviceChoice device;
    glsl::Precision precision = glsl::Precision::single;
    double duration = 60; ///< seconds
};

/// Whether `-o x.wav` asks for that.
bool wants_sound(const CaptureOptions& options);
Result<SoundPlan> plan_sound(const CaptureOptions& options);

} // namespace tidemark::cli
