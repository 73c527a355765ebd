// Sound that is heard: samples go to the default device of ALSA, which is loaded when a scene first has
// something to play.
#pragma once

#include "base/result.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace tidemark::sound {

struct AlsaDevice;

/// 16-bit stereo, left and right in turn.
class Playback {
public:
    /// ErrorCode::load says why there is nothing to hear: no library, no device.
    static Result<Playback> open(int rate);
    Playback(Playback&&) noexcept;
    Playback& operator=(Playback&&) noexcept;
    ~Playback();

    /// Hands over what the device has room for, never waits, and gives the number of samples (of each side)
    /// that were taken. Nothing when the device had run dry: what comes next is heard late.
    std::optional<size_t> write(std::span<const int16_t> samples);

    /// At once; what was handed over and is not yet heard is dropped.
    void silence();

private:
    explicit Playback(std::unique_ptr<AlsaDevice> device);

    std::unique_ptr<AlsaDevice> device_;
};

} // namespace tidemark::sound
