// A sound as it comes from a device of ALSA, which is loaded when one is opened.
#pragma once

#include "base/result.hpp"
#include "sound/analyser.hpp"

#include <memory>
#include <string>

namespace tidemark::sound {

struct AlsaDevice;

class Microphone {
public:
    /// `device` as ALSA's configuration names it: `default`, `plughw:1`. ErrorCode::load says why it cannot
    /// be listened to.
    static Result<Microphone> open(const std::string& device);
    Microphone(Microphone&&) noexcept;
    Microphone& operator=(Microphone&&) noexcept;
    ~Microphone();

    /// The spectrum, smoothed from call to call as a browser does, and the wave of what was heard last. Never
    /// waits; where nothing came since the last call, what came before counts again.
    SignalBytes hear();

private:
    explicit Microphone(std::unique_ptr<AlsaDevice> device);
    void listen();

    std::unique_ptr<AlsaDevice> device_;
    Block newest_{}; ///< samples, the oldest first
    Magnitudes mean_{};
};

} // namespace tidemark::sound
