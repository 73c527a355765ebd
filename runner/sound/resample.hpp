// One channel at another rate.
#pragma once

#include <span>
#include <vector>

namespace tidemark::sound {

/// Band-limited: a sinc of 32 crossings of the lower rate under a Blackman window. Sample n of the result
/// stands at the time n / to_rate; outside of `samples` there is silence. The same samples when the rates are
/// equal.
std::vector<float> resampled(std::span<const float> samples, int from_rate, int to_rate);

} // namespace tidemark::sound
