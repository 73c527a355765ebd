#include "sound/alsa_library.hpp"

#include "base/shared_library.hpp"
#include "base/try.hpp"

namespace tidemark::sound {
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

const Result<AlsaLibrary>& alsa_library() {
    static const Result<AlsaLibrary> library = load_alsa();
    return library;
}

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

} // namespace tidemark::sound
