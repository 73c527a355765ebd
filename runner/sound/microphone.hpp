// Reads sound from an ALSA device; libasound is loaded when one is opened.
#pragma once

#include "base/result.hpp"
#include "sound/analyser.hpp"

#include <memory>
#include <string>

namespace tidemark::sound {

struct AlsaDevice;

class Microphone {
public:
    /// Opens `device`, a name of ALSA's configuration such as `default` or `plughw:1`. ErrorCode::load gives
    /// the reason if it cannot be opened.
    static Result<Microphone> open(const std::string& device);
    Microphone(Microphone&&) noexcept;
    Microphone& operator=(Microphone&&) noexcept;
    ~Microphone();

    /// Returns the spectrum, smoothed from call to call as in a browser, and the wave of the newest samples.
    /// Never waits; if no samples came since the last call, it analyses the previous ones again.
    SignalBytes hear();

private:
    explicit Microphone(std::unique_ptr<AlsaDevice> device);
    void listen();

    std::unique_ptr<AlsaDevice> device_;
    Block newest_{}; ///< samples, oldest first
    Magnitudes mean_{};
};

} // namespace tidemark::sound
