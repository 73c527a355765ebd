// Loads libasound when a sound is first played or recorded, and opens devices.
#pragma once

#include "base/result.hpp"

#include <alsa/asoundlib.h>

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

/// Returns the library, loaded by the first call, which also turns off its messages. ErrorCode::load names
/// the missing library or function.
const Result<AlsaLibrary>& alsa_library();

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

/// Opens a device without waiting. The error is ALSA's own message.
Result<std::unique_ptr<AlsaDevice>> open_device(const AlsaFormat& format);

} // namespace tidemark::sound
