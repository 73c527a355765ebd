// What ShaderToy's music inputs hold: 512 bytes of spectrum and 512 bytes of wave, at a time.
#pragma once

#include "sound/analyser.hpp"
#include "sound/sound_file.hpp"

#include <cstdint>
#include <deque>
#include <vector>

namespace tidemark::sound {

/// The site's own signal where there is no sound to hear, at `iTime` = `time`. (iChannelTime is then 10 +
/// iTime.)
SignalBytes silent_signal(double time);

/// A sound as WebAudio's AnalyserNode at its defaults shows it in a context of 44100 Hz: mixed down to mono,
/// blocks of 2048 samples under a Blackman window (alpha 0.16), 512 of the 1024 magnitudes (21.5 Hz each),
/// smoothed with 0.8, -100..-30 dB as 0..255; the wave is the oldest 512 samples of the block, 128 (1 + x).
/// A browser smooths from call to call; here a call stands for sixty a second since the start of the sound,
/// at whole multiples of 1/60 s, of which the last 128 are counted (0.8^128 is -248 dB): the bytes depend on
/// the sound and the time alone. The wave is that of the very time.
class Spectrum {
public:
    explicit Spectrum(const SoundData& sound);

    double duration() const { return duration_; }

    /// `time` in seconds from the start of the sound; before it and after its end there is silence.
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
