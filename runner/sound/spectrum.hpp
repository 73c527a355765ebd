// Computes the bytes of ShaderToy's music inputs at a time: 512 of spectrum and 512 of wave.
#pragma once

#include "sound/analyser.hpp"
#include "sound/sound_file.hpp"

#include <cstdint>
#include <deque>
#include <vector>

namespace tidemark::sound {

/// Returns the signal that ShaderToy's site uses when there is no sound, at `iTime` = `time`. (iChannelTime
/// is then 10 + iTime.)
SignalBytes silent_signal(double time);

/// A sound as WebAudio's AnalyserNode at its defaults shows it in a context of 44100 Hz: mixed down to mono,
/// blocks of 2048 samples under a Blackman window (alpha 0.16), 512 of the 1024 magnitudes (21.5 Hz each),
/// smoothed with 0.8, -100..-30 dB as 0..255; the wave is the oldest 512 samples of the block, 128 (1 + x). A
/// browser smooths from call to call. Here each call counts as sixty calls per second since the start of the
/// sound, at whole multiples of 1/60 s, of which the last 128 count (0.8^128 is -248 dB): the bytes depend
/// only on the sound and the time. The wave is that of the exact time.
class Spectrum {
public:
    explicit Spectrum(const SoundData& sound);

    double duration() const { return duration_; }

    /// Returns the bytes at `time`, in seconds from the start of the sound; before the start and after the
    /// end there is silence.
    SignalBytes at(double time);

private:
    Block block_before(int64_t end) const;
    void step_to(int64_t step);

    double duration_ = 0.0;
    std::vector<float> mono_; ///< at 44100 Hz
    std::deque<Magnitudes> recent_;
    int64_t newest_ = -1; ///< the step of recent_.back()
};

} // namespace tidemark::sound
