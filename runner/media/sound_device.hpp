// Reads sound from an ALSA device; libasound is loaded when one is opened.
#pragma once

#include "base/error.hpp"
#include "media/spectrum.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
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

// Plays samples on ALSA's default device. libasound is loaded when a scene first has something to play.

struct AlsaDevice;

/// Player of 16-bit stereo, left and right samples interleaved.
class Playback {
public:
    /// Opens the device. ErrorCode::load gives the reason if the library or the device is missing.
    static Result<Playback> open(int rate);
    Playback(Playback&&) noexcept;
    Playback& operator=(Playback&&) noexcept;
    ~Playback();

    /// Writes as many samples as the device has room for, never waits, and returns their number per channel.
    /// Returns nothing if the device had run out of samples: the following ones play late.
    std::optional<size_t> write(std::span<const int16_t> samples);

    /// Stops at once and drops samples that were written but not yet played.
    void silence();

private:
    explicit Playback(std::unique_ptr<AlsaDevice> device);

    std::unique_ptr<AlsaDevice> device_;
};

} // namespace tidemark::sound
