// Loads libasound when a sound is first played or recorded, and opens devices.

#include "media/sound_device.hpp"

#include "base/dynamic_library.hpp"
#include "base/error.hpp"

#include <alsa/asoundlib.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <memory>

namespace tidemark::sound {

/// The library's functions in use.
struct AlsaLibrary {
    decltype(&snd_pcm_open) open = nullptr;
    decltype(&snd_pcm_close) close = nullptr;
    decltype(&snd_pcm_set_params) set_params = nullptr;
    decltype(&snd_pcm_writei) write = nullptr;
    decltype(&snd_pcm_readi) read = nullptr;
    decltype(&snd_pcm_wait) wait = nullptr;
    decltype(&snd_pcm_start) start = nullptr;
    decltype(&snd_pcm_drop) drop = nullptr;
    decltype(&snd_pcm_prepare) prepare = nullptr;
    decltype(&snd_strerror) message = nullptr;
    decltype(&snd_lib_error_set_handler) set_handler = nullptr;
};

/// An open device; closed by the destructor.
struct AlsaDevice {
    const AlsaLibrary& alsa;
    snd_pcm_t* pcm = nullptr;

    explicit AlsaDevice(const AlsaLibrary& library) : alsa(library) {}
    AlsaDevice(const AlsaDevice&) = delete;
    AlsaDevice& operator=(const AlsaDevice&) = delete;
    ~AlsaDevice() {
        if (pcm)
            alsa.close(pcm);
    }
};

/// Parameters of a device to open.
struct AlsaFormat {
    const char* name; ///< the name in ALSA's configuration, such as "default"
    snd_pcm_stream_t direction;
    snd_pcm_format_t samples;
    unsigned channels;
    unsigned rate;                ///< samples per second and channel
    unsigned buffer_microseconds; ///< length of the device's buffer
};

namespace {

/// Discards the messages that ALSA would print.
void say_nothing(const char*, int, const char*, int, const char*, ...) {}

Result<AlsaLibrary> load_alsa() {
    AlsaLibrary alsa;
    SharedLibrary library("libasound.so.2");
    library.find("snd_pcm_open", alsa.open)
        .find("snd_pcm_close", alsa.close)
        .find("snd_pcm_set_params", alsa.set_params)
        .find("snd_pcm_writei", alsa.write)
        .find("snd_pcm_readi", alsa.read)
        .find("snd_pcm_wait", alsa.wait)
        .find("snd_pcm_start", alsa.start)
        .find("snd_pcm_drop", alsa.drop)
        .find("snd_pcm_prepare", alsa.prepare)
        .find("snd_strerror", alsa.message)
        .find("snd_lib_error_set_handler", alsa.set_handler);
    TRY(library.complete("libasound", "libasound2"));
    alsa.set_handler(say_nothing);
    return alsa;
}

} // namespace

/// Returns the library, loaded by the first call, which also turns off its messages. ErrorCode::load names
/// the missing library or function.
const Result<AlsaLibrary>& alsa_library() {
    static const Result<AlsaLibrary> library = load_alsa();
    return library;
}

/// Opens a device without waiting. The error is ALSA's own message.
Result<std::unique_ptr<AlsaDevice>> open_device(const AlsaFormat& format) {
    constexpr int k_resample = 1;
    const auto& alsa = alsa_library();
    if (!alsa)
        return fail(alsa.error());
    auto device = std::make_unique<AlsaDevice>(*alsa);
    int error = alsa->open(&device->pcm, format.name, format.direction, SND_PCM_NONBLOCK);
    if (error == 0)
        error = alsa->set_params(device->pcm, format.samples, SND_PCM_ACCESS_RW_INTERLEAVED, format.channels,
                                 format.rate, k_resample, format.buffer_microseconds);
    if (error < 0)
        return fail(ErrorCode::load, alsa->message(error));
    return device;
}

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
    // Reads all that came, so that the newest samples are used at low frame rates too. The bound is for a
    // device that never runs out of samples, as a file is.
    constexpr int k_most_blocks = 64;
    for (int block = 0; block < k_most_blocks; ++block) {
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
        if (size_t(count) < came.size())
            return;
    }
}

SignalBytes Microphone::hear() {
    listen();
    smooth(mean_, magnitudes_of(newest_));
    return signal_bytes(mean_, newest_);
}

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
                fmt::format("no audio device found (ALSA says: {})", device.error().message));
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
