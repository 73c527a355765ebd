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
    const auto shown = [&](double sample) {
        return clamped_ && std::isfinite(sample) ? std::clamp(sample, 0.0, 1.0) : sample;
    };
    for (size_t pixel = 0; pixel < samples.size(); pixel += 4) {
        const double alpha = shown(samples[pixel + k_alpha]);
        for (size_t i = pixel; i < pixel + k_alpha; ++i)
            sums_[i] += alpha * light_of_srgb(shown(samples[i]));
        sums_[pixel + k_alpha] += alpha;
    }
}

void LightMean::take(Image& mean) {
    const auto samples = mean.f32();
    for (size_t pixel = 0; pixel < samples.size(); pixel += 4) {
        const double alpha = sums_[pixel + k_alpha];
        for (size_t i = pixel; i < pixel + k_alpha; ++i)
            samples[i] = float(alpha == 0 && sums_[i] == 0 ? 0 : srgb_of_light(sums_[i] / alpha));
        samples[pixel + k_alpha] = float(alpha / count_);
    }
    count_ = 0;
}

} // namespace tidemark::image
