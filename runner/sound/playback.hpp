// Plays samples on ALSA's default device. libasound is loaded when a scene first has something to play.
#pragma once

#include "base/result.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace tidemark::sound {

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
    /// Returns nothing if the device had run out of samples: the following ones are heard late.
    std::optional<size_t> write(std::span<const int16_t> samples);

    /// Stops at once and drops samples that were written but not yet played.
    void silence();

private:
    explicit Playback(std::unique_ptr<AlsaDevice> device);

    std::unique_ptr<AlsaDevice> device_;
};

} // namespace tidemark::sound
