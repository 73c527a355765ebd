#include "sound/playback.hpp"

#include "sound/alsa_library.hpp"

#include <fmt/format.h>

#include <cerrno>

namespace tidemark::sound {
namespace {

/// Length of the device's buffer: short, so that a pause takes effect soon, but long enough for a busy
/// machine.
constexpr unsigned k_buffer_microseconds = 200'000;

} // namespace

Playback::Playback(std::unique_ptr<AlsaDevice> device) : device_(std::move(device)) {}
Playback::Playback(Playback&&) noexcept = default;
Playback& Playback::operator=(Playback&&) noexcept = default;
Playback::~Playback() = default;

Result<Playback> Playback::open(int rate) {
    auto device = open_device(
        {"default", SND_PCM_STREAM_PLAYBACK, SND_PCM_FORMAT_S16, 2, unsigned(rate), k_buffer_microseconds});
    if (device)
        return Playback(*std::move(device));
    if (!alsa_library())
        return fail(std::move(device.error()));
    return fail(ErrorCode::load,
                fmt::format("there is no sound device (ALSA says: {})", device.error().message));
}

std::optional<size_t> Playback::write(std::span<const int16_t> samples) {
    const snd_pcm_sframes_t taken = device_->alsa.write(device_->pcm, samples.data(), samples.size() / 2);
    if (taken >= 0)
        return size_t(taken);
    if (taken == -EAGAIN)
        return 0;
    device_->alsa.prepare(device_->pcm);
    return std::nullopt;
}

void Playback::silence() {
    device_->alsa.drop(device_->pcm);
    device_->alsa.prepare(device_->pcm);
}

} // namespace tidemark::sound
