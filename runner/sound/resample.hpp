// Converts one channel to another sample rate.
#pragma once

#include <span>
#include <vector>

namespace tidemark::sound {

/// Returns the samples, band-limited by a sinc with 32 crossings at the lower rate under a Blackman window.
/// Sample n is at the time n / to_rate; outside of `samples` there is silence. Returns the same samples if
/// the rates are equal.
std::vector<float> resampled(std::span<const float> samples, int from_rate, int to_rate);

} // namespace tidemark::sound
