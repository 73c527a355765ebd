#include "render/exposure.hpp"

namespace tidemark::render {
namespace {

/// Mirrors the digits of a number at the point (J. G. van der Corput, 1935); in [0, 1).
double radical_inverse(int number, int base) {
    double inverse = 0;
    for (double digit = 1.0 / base; number > 0; number /= base, digit /= base)
        inverse += digit * (number % base);
    return inverse;
}

/// Returns the mean radical inverse of 0 to `count` - 1.
double mean_inverse(int count, int base) {
    double sum = 0;
    for (int i = 0; i < count; ++i)
        sum += radical_inverse(i, base);
    return sum / count;
}

} // namespace

ExposedFrame expose(const Exposure& exposure, const FrameState& state) {
    const int count = exposure.samples;
    const double middle_x = mean_inverse(count, 2), middle_y = mean_inverse(count, 3);
    ExposedFrame frame{{}, exposure.shutter > 0, exposure.clamped};
    FrameState moment = state;
    for (int i = 0; i < count; ++i) {
        if (frame.moving)
            moment.time = state.seconds() + exposure.shutter * (i + 0.5) / count / state.fps;
        frame.samples.push_back(
            {inputs_of(moment), radical_inverse(i, 2) - middle_x, radical_inverse(i, 3) - middle_y});
    }
    return frame;
}

} // namespace tidemark::render
