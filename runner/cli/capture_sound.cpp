// The sound of a video or a .wav: the Sound pass and the channels that read sound files or videos, mixed.

#include "cli/capture_delivery.hpp"
#include "host/console.hpp"
#include "host/gl_context.hpp"
#include "media/sound_file.hpp"
#include "media/video_output.hpp"
#include "render/sound_renderer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace tidemark::cli {

using namespace host;
namespace {

/// Returns the scene's sound from `start` on (seconds): interleaved left and right samples,
/// render::k_sample_rate of each a second. After an interrupt the rest is silent. A context must be current.
Result<std::vector<int16_t>> draw_sound(const scene::Scene& scene, glsl::Precision precision, double start,
                                        double duration, const Interrupt& interrupt) {
    if (constexpr double k_last = render::SoundRenderer::k_longest_seconds; start + duration > k_last)
        return fail(
            ErrorCode::usage,
            fmt::format("sound cannot be longer than {} s, because iSampleOffset counts samples in an int",
                        k_last));
    auto renderer = TRY(render::SoundRenderer::create(scene, render::Date{}, precision));
    const auto count = 2 * size_t(std::llround(duration * render::k_sample_rate));
    const auto first = int(std::llround(start * render::k_sample_rate));
    const auto block = 2 * size_t(render::SoundRenderer::block_samples());
    const int lead = first % render::SoundRenderer::block_samples(); // only whole blocks can be drawn
    const size_t drawn_count = 2 * size_t(lead) + count;
    std::vector<int16_t> samples;
    Progress progress("blocks of sound", (drawn_count + block - 1) / block);
    while (samples.size() < drawn_count && !interrupt.requested()) {
        const std::vector<int16_t> drawn = renderer.draw(first - lead + int(samples.size() / 2));
        samples.insert(samples.end(), drawn.begin(), drawn.end());
        progress.advance();
    }
    samples.resize(drawn_count);
    samples.erase(samples.begin(), samples.begin() + 2 * std::ptrdiff_t(lead));
    return samples;
}

/// The rate of Opus in a .webm.
constexpr int k_opus_rate = 48000;

bool has_no_sound(const std::filesystem::path& video) {
    return video.extension() == ".gif" || video.extension() == ".webp";
}

/// The sound of a file, 16-bit stereo.
struct Track {
    int rate = 0;
    std::vector<int16_t> samples;
    std::vector<std::string> heard; ///< `iChannel0 song.ogg`, `the Sound pass`

    /// Returns a line about the sounds in a file of that rate.
    std::string words(int file_rate) const {
        const std::span all(heard);
        const bool several = all.size() > 1;
        return fmt::format("Sound: {}{}{}, {}", fmt::join(all.first(all.size() - 1), ", "),
                           several ? " and " : "", all.back(), sound::rate_words(file_rate, 2));
    }
};

/// Draws and mixes the sounds of a scene. A context must be current if the Sound pass takes part.
struct TrackMaker {
    const scene::Scene& scene;
    glsl::Precision precision;
    render::HeardParts parts;
    const Interrupt& interrupt;
    bool tolerate = false;     ///< print the errors of a sound and go on without it
    std::optional<int> rate{}; ///< of the mix without the Sound pass; none: that of the inputs

    /// Returns nothing if no part has a sound.
    Result<std::optional<Track>> make(const TimePart& part) const;

private:
    using Pass = std::optional<std::vector<int16_t>>;

    Result<std::vector<std::pair<std::string, sound::InputSound>>> read_inputs() const;
    Result<Pass> draw_pass(const TimePart& part, bool alone) const;
};

Result<std::vector<std::pair<std::string, sound::InputSound>>> TrackMaker::read_inputs() const {
    std::vector<std::pair<std::string, sound::InputSound>> inputs;
    if (!parts.inputs)
        return inputs;
    for (const render::HeardChannel& channel : render::heard_channels(scene)) {
        auto read = interrupt.requested() ? std::nullopt : render::read_sound_of(channel);
        if (!read && !tolerate)
            return fail(std::move(read.error()));
        if (!read)
            say(fmt::format("no sound of {}: {}", channel.name, read.error().message));
        else if (*read)
            inputs.emplace_back(channel.name, *std::move(*read));
    }
    return inputs;
}

/// Returns the samples of the Sound pass, or nothing without it. `alone`: there is no other sound.
Result<TrackMaker::Pass> TrackMaker::draw_pass(const TimePart& part, bool alone) const {
    if (!parts.pass || !scene.find(scene::PassKind::sound))
        return std::nullopt;
    auto samples = draw_sound(scene, precision, part.begin, part.length, interrupt);
    if (samples)
        return *std::move(samples);
    if (!tolerate)
        return fail(std::move(samples.error()));
    say(fmt::format("the {} is silent: {}", alone ? "video" : "Sound pass", to_string(samples.error())));
    return std::nullopt;
}

Result<std::optional<Track>> TrackMaker::make(const TimePart& part) const {
    auto inputs = TRY(read_inputs());
    Pass pass = TRY(draw_pass(part, inputs.empty()));
    Track track;
    std::vector<int> rates;
    for (const auto& [name, sound] : inputs) {
        rates.push_back(sound.data.rate);
        track.heard.push_back(name);
    }
    track.rate = pass ? int(render::k_sample_rate) : rate.value_or(sound::mixing_rate(rates));
    if (pass)
        track.heard.emplace_back("the Sound pass");
    if (track.heard.empty())
        return std::nullopt;
    std::vector<sound::LoopedSound> sounds;
    for (auto& [name, sound] : inputs) {
        sounds.emplace_back(sound, track.rate);
        sound.data.samples = {};
    }
    if (pass)
        track.samples = *std::move(pass);
    track.samples.resize(2 * size_t(std::llround(part.length * track.rate)));
    constexpr size_t k_samples_at_once = 1 << 16;
    const auto first = int64_t(std::llround(part.begin * track.rate));
    std::vector<float> mix;
    for (size_t at = 0; !sounds.empty() && at < track.samples.size() && !interrupt.requested();
         at += mix.size()) {
        const auto samples = std::span(track.samples)
                                 .subspan(at)
                                 .first(std::min(k_samples_at_once, track.samples.size() - at));
        mix.assign(samples.begin(), samples.end());
        for (const sound::LoopedSound& sound : sounds)
            sound.add(first + int64_t(at / 2), mix);
        std::ranges::copy(sound::in_16_bits(mix, track.heard.size() > 1), samples.begin());
    }
    return track;
}

} // namespace

Result<render::HeardParts> parse_audio(const std::string& text, const std::filesystem::path& output,
                                       const scene::Scene& scene) {
    const std::string extension = output.extension().string();
    const bool alone = extension == ".wav";
    const auto refuse = [&](std::string_view why) {
        return fail(ErrorCode::usage, fmt::format("--audio {}: {}", text, why));
    };
    const bool has_pass = scene.find(scene::PassKind::sound),
               has_inputs = !render::heard_channels(scene).empty();
    if (alone && !has_pass && !has_inputs)
        return fail(
            ErrorCode::usage,
            fmt::format("'{}' has no sound: it has no Sound pass, and no channel reads a sound or a video",
                        scene.file.string()));
    if (text.empty())
        return render::HeardParts{};
    if (!alone && !image::is_video_name(output))
        return refuse("is for videos and .wav files only");
    if (has_no_sound(output))
        return refuse(fmt::format("a {} has no sound", extension));
    if (alone && text == "none")
        return refuse("a .wav is sound alone: give sound, inputs or both");
    if (text == "sound" && !has_pass)
        return refuse("the scene has no Sound pass");
    if (text == "inputs" && !has_inputs)
        return refuse("no channel of the scene reads a sound or a video");
    return render::HeardParts{text == "sound" || text == "both", text == "inputs" || text == "both"};
}

std::optional<StagedFile> draw_sound_of_video(const CapturePlan& plan, const Interrupt& interrupt) {
    if (!plan.output.video() || plan.shard) // `gather` draws it
        return std::nullopt;
    const std::vector<int>& frames = plan.frames.frames;
    const VideoPace& pace = plan.video.pace;
    const auto parts = parse_audio(plan.options.encoding.audio, plan.output.pattern(), plan.scene);
    const bool heard = parts && !has_no_sound(plan.output.pattern()) &&
                       ((parts->pass && plan.scene.find(scene::PassKind::sound)) ||
                        (parts->inputs && !render::heard_channels(plan.scene).empty()));
    if (!pace.not_in_time.empty())
        say(fmt::format("the video does not follow the scene's time: {}; it shows {:.4g} frames per second{}",
                        pace.not_in_time, pace.fps, heard ? "; it is silent" : ""));
    if (pace.holds)
        say(fmt::format("the frames are not evenly spaced: the video ({:.4g} frames per second) holds each "
                        "until the time of the next",
                        pace.fps));
    if (!heard || !pace.not_in_time.empty())
        return std::nullopt;
    const std::vector<int> shown = ticks_of(frames, pace);
    const auto ticks = std::accumulate(shown.begin(), shown.end(), size_t{0});
    const double first = plan.frames.state.at_frame(frames.front()).seconds();
    TrackMaker maker{plan.scene, plan.drawing.options.precision, *parts, interrupt};
    maker.tolerate = true;
    if (plan.output.pattern().extension() == ".webm")
        maker.rate = k_opus_rate;
    const auto track = maker.make({std::max(0.0, first), double(ticks) / pace.fps});
    if (track && !*track && plan.options.encoding.audio == "inputs")
        say("the video is silent: no input has a sound");
    if (!track || !*track)
        return std::nullopt;
    auto file = StagedFile::create(plan.output.of_frame(0), ".wav");
    Result<void> written = !file ? fail(std::move(file.error()))
                                 : sound::write_wav(file->path(), (*track)->rate, (*track)->samples);
    if (!written) {
        say("the video is silent: " + to_string(written.error()));
        return std::nullopt;
    }
    say((*track)->words(plan.output.pattern().extension() == ".webm" ? k_opus_rate : (*track)->rate));
    return *std::move(file);
}

Result<int> capture_sound(const SoundPlan& plan) {
    const Interrupt interrupt;
    std::optional<host::HeadlessContext> context;
    if (plan.heard.pass && plan.scene.find(scene::PassKind::sound))
        context.emplace(TRY(host::HeadlessContext::create(plan.device)));
    TrackMaker maker{plan.scene, plan.precision, plan.heard, interrupt};
    const auto track = TRY(maker.make(plan.part));
    if (interrupt.requested())
        return Interrupt::k_exit_code;
    if (!track)
        return fail(ErrorCode::usage, fmt::format("'{}' has no sound: its videos have no audio track",
                                                  plan.scene.file.string()));
    TRY(sound::write_wav(plan.output, track->rate, track->samples));
    say(track->words(track->rate));
    say(fmt::format("wrote {}", plan.output.string()));
    return 0;
}

} // namespace tidemark::cli
