#include "sound/microphone.hpp"

#include "sound/alsa_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>

namespace tidemark::sound {
namespace {

/// Length of the device's buffer: a frame that comes later than this loses samples.
constexpr unsigned k_recorded_microseconds = 500'000;

} // namespace

Microphone::Microphone(std::unique_ptr<AlsaDevice> device) : device_(std::move(device)) {}
Microphone::Microphone(Microphone&&) noexcept = default;
Microphone& Microphone::operator=(Microphone&&) noexcept = default;
Microphone::~Microphone() = default;

Result<Microphone> Microphone::open(const std::string& device) {
    auto opened = open_device({device.c_str(), SND_PCM_STREAM_CAPTURE, SND_PCM_FORMAT_S16, 1, k_analysed_rate,
                               k_recorded_microseconds});
    if (opened && (*opened)->alsa.start((*opened)->pcm) >= 0)
        return Microphone(*std::move(opened));
    return fail(ErrorCode::load, fmt::format("cannot listen to the microphone '{}': {}", device,
                                             opened ? "it does not start" : opened.error().message));
}

void Microphone::listen() {
    std::array<int16_t, k_block> came{};
    const snd_pcm_sframes_t count = device_->alsa.read(device_->pcm, came.data(), came.size());
    if (count == -EAGAIN || count == 0)
        return;
    if (count < 0) { // more samples came than the buffer holds
        device_->alsa.prepare(device_->pcm);
        device_->alsa.start(device_->pcm);
        return;
    }
    std::shift_left(newest_.begin(), newest_.end(), count);
    std::transform(came.begin(), came.begin() + count, newest_.end() - count,
                   [](int16_t sample) { return float(sample) / 32768.0f; });
}

SignalBytes Microphone::hear() {
    listen();
    smooth(mean_, magnitudes_of(newest_));
    return signal_bytes(mean_, newest_);
}

} // namespace tidemark::sound
