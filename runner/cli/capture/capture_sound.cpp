#include "cli/capture/capture_sound.hpp"

#include "base/try.hpp"
#include "cli/console.hpp"
#include "cli/progress.hpp"
#include "platform/headless_context.hpp"
#include "render/sound_renderer.hpp"
#include "sound/sound_file.hpp"

#include <fmt/format.h>

#include <cmath>

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
