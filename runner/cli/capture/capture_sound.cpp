#include "cli/capture/capture_sound.hpp"

#include "base/try.hpp"
#include "cli/console.hpp"
#include "cli/progress.hpp"
#include "platform/headless_context.hpp"
#include "render/sound_renderer.hpp"
#include "sound/sound_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

namespace tidemark::cli {

Result<std::vector<int16_t>> draw_sound(const scene::Scene& scene, glsl::Precision precision, double start,
                                        double duration, const Interrupt& interrupt) {
    if (constexpr double k_last = render::SoundRenderer::k_longest_seconds; start + duration > k_last)
        return fail(ErrorCode::usage,
                    fmt::format("sound ends at {} s: iSampleOffset counts its samples in an int", k_last));
    auto renderer = TRY(render::SoundRenderer::create(scene, render::Date{}, precision));
    const auto count = 2 * size_t(std::llround(duration * render::k_sample_rate));
    const auto first = int(std::llround(start * render::k_sample_rate));
    const auto block = 2 * size_t(render::SoundRenderer::block_samples());
    std::vector<int16_t> samples;
    Progress progress("blocks of sound", (count + block - 1) / block);
    while (samples.size() < count && !interrupt.requested()) {
        const std::vector<int16_t> drawn = renderer.draw(first + int(samples.size() / 2));
        samples.insert(samples.end(), drawn.begin(), drawn.end());
        progress.advance();
    }
    samples.resize(count);
    return samples;
}

std::optional<StagedFile> draw_sound_of_video(const CapturePlan& plan, const Interrupt& interrupt) {
    if (!plan.output.video() || plan.shard) // `gather` draws it
        return std::nullopt;
    const std::vector<int>& frames = plan.frames.frames;
    const VideoPace& pace = plan.pace;
    const bool heard = plan.output.pattern().extension() != ".gif" && plan.scene.find(scene::PassKind::sound);
    if (!pace.not_in_time.empty())
        say(fmt::format("the video does not go by the scene's time: {}, {:.4g} a second{}", pace.not_in_time,
                        pace.fps, heard ? "; it is silent" : ""));
    if (pace.holds)
        say(fmt::format("its frames are not evenly apart: the video shows each until the next one is due, "
                        "{:.4g} a second",
                        pace.fps));
    if (!heard || !pace.not_in_time.empty())
        return std::nullopt;
    const std::vector<int> shown = ticks_of(frames, pace);
    const auto ticks = std::accumulate(shown.begin(), shown.end(), size_t{0});
    const double first = plan.frames.state.at_frame(frames.front()).seconds();
    auto samples = draw_sound(plan.scene, plan.drawing.precision, std::max(0.0, first),
                              double(ticks) / pace.fps, interrupt);
    auto file = StagedFile::create(plan.output.of_frame(0), ".wav");
    Result<void> written = !file      ? fail(std::move(file.error()))
                           : !samples ? fail(std::move(samples.error()))
                                      : sound::write_wav(file->path(), int(render::k_sample_rate), *samples);
    if (written)
        return *std::move(file);
    say("the video is silent: " + to_string(written.error()));
    return std::nullopt;
}

Result<int> capture_sound(const SoundPlan& plan) {
    const Interrupt interrupt;
    const auto context = TRY(platform::HeadlessContext::create(plan.device));
    const auto samples = TRY(draw_sound(plan.scene, plan.precision, 0, plan.duration, interrupt));
    if (interrupt.requested())
        return Interrupt::k_exit_code;
    TRY(sound::write_wav(plan.output, int(render::k_sample_rate), samples));
    say(fmt::format("wrote {}", plan.output.string()));
    return 0;
}

} // namespace tidemark::cli
