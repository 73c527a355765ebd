#include "image/light_mean.hpp"

#include "image/transfer.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tidemark::image {
namespace {

constexpr size_t k_alpha = 3;

} // namespace

void LightMean::add(const Image& picture) {
    assert(picture.type == SampleType::f32 && picture.channels == 4);
    const auto samples = picture.f32();
    if (count_++ == 0)
        sums_.assign(samples.size(), 0);
    for (size_t i = 0; i < samples.size(); ++i) {
        const double sample = samples[i];
        const double shown = clamped_ && std::isfinite(sample) ? std::clamp(sample, 0.0, 1.0) : sample;
        sums_[i] += i % 4 == k_alpha ? sample : light_of_srgb(shown);
    }
}

void LightMean::take(Image& mean) {
    const auto samples = mean.f32();
    for (size_t i = 0; i < samples.size(); ++i) {
        const double part = sums_[i] / count_;
        samples[i] = float(i % 4 == k_alpha ? part : srgb_of_light(part));
    }
    count_ = 0;
}

} // namespace tidemark::image
