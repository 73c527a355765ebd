#include "cli/capture_sound.hpp"

#include "cli/console.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "platform/headless_context.hpp"
#include "render/sound_renderer.hpp"
#include "sound/sound_file.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tidemark::cli {
namespace {

/// A WAV file of 16-bit stereo counts its bytes in 32 bits: some six hours. Nobody listens so long.
constexpr double k_longest = 3600;

} // namespace

Result<int> capture_sound(const SceneRequest& scene_request, const SoundRequest& request) {
    if (!(request.duration > 0) || request.duration > k_longest)
        return fail(ErrorCode::usage, fmt::format("--duration {}: give seconds above 0, at most {}",
                                                  request.duration, k_longest));
    const Interrupt interrupt;
    const auto scene = load(scene_request);
    if (!scene)
        return fail(scene.error());
    const auto context = platform::HeadlessContext::create(request.device);
    if (!context)
        return fail(context.error());
    auto renderer = render::SoundRenderer::create(*scene, precision_of(scene_request));
    if (!renderer)
        return fail(std::move(renderer.error()));
    const auto count = size_t(std::llround(request.duration * render::k_sample_rate));
    const auto block = size_t(render::SoundRenderer::block_samples());
    std::vector<int16_t> samples;
    Progress progress("blocks of sound", (count + block - 1) / block);
    while (samples.size() < 2 * count) {
        if (interrupt.requested())
            return Interrupt::k_exit_code;
        const std::vector<int16_t> drawn = renderer->draw(int(samples.size() / 2), render::Date{});
        samples.insert(samples.end(), drawn.begin(), drawn.end());
        progress.advance();
    }
    samples.resize(2 * count);
    if (auto written = sound::write_wav(request.output, int(render::k_sample_rate), samples); !written)
        return fail(std::move(written.error()));
    say(fmt::format("wrote {}", request.output));
    return 0;
}

} // namespace tidemark::cli
