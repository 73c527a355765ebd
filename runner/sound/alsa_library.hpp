// libasound, loaded when a sound is first played or listened to.
#pragma once

#include "base/result.hpp"

#include <alsa/asoundlib.h>

#include <memory>

namespace tidemark::sound {

/// The functions of the library that we call.
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

/// Loaded by the first call, which quiets what it would print by itself. ErrorCode::load says what is
/// missing.
const Result<AlsaLibrary>& alsa_library();

/// A device of it, open.
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

/// What is asked of a device.
struct AlsaFormat {
    const char* name; ///< as ALSA's configuration has it: "default"
    snd_pcm_stream_t direction;
    snd_pcm_format_t samples;
    unsigned channels;
    unsigned rate;                ///< samples a second of each channel
    unsigned buffer_microseconds; ///< what it holds at most
};

/// Never waits. The error is ALSA's own reason.
Result<std::unique_ptr<AlsaDevice>> open_device(const AlsaFormat& format);

} // namespace tidemark::sound
