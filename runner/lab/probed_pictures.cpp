#include "lab/probed_pictures.hpp"

#include "base/error.hpp"
#include "base/extent.hpp"
#include "base/measurement.hpp"
#include "lab/pixel_trace.hpp"
#include "media/comparison.hpp"
#include "media/image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace tidemark::lab {

namespace {

/// Returns the largest sample difference of each pixel.
std::vector<double> largest_differences(const image::Image& left, const image::Image& right) {
    std::vector<double> largest(left.extent.pixels());
    const auto channels = size_t(left.channels);
    for (size_t i = 0; i < left.samples(); ++i) {
        const double difference = std::abs(double(left.f32()[i]) - double(right.f32()[i]));
        // A sample that is finite in one picture only gets the largest difference.
        const bool same =
            left.f32()[i] == right.f32()[i] || (std::isnan(left.f32()[i]) && std::isnan(right.f32()[i]));
        double& most = largest[i / channels];
        most = std::max(most, same ? 0.0 : std::isfinite(difference) ? difference : 1.0);
    }
    return largest;
}

bool is_number(const image::Image& image, size_t pixel) {
    const auto samples = image.f32().subspan(pixel * size_t(image.channels), size_t(image.channels));
    return std::ranges::all_of(samples, [](float sample) { return std::isfinite(sample); });
}

/// A picture as a screen shows it: every sample from 0 to 1, NaN as 0.
class ShownImage {
public:
    explicit ShownImage(const image::Image& image) : image_(image), channels_(size_t(image.channels)) {}

    double at(int x, int y, size_t channel) const {
        const size_t pixel = size_t(y) * size_t(image_.extent.width) + size_t(x);
        const float sample = image_.f32()[pixel * channels_ + channel];
        return std::isnan(sample) ? 0 : std::clamp(double(sample), 0.0, 1.0);
    }

    /// Returns the mean of one channel over a part of the picture.
    double mean(const Rectangle& part, size_t channel) const {
        double sum = 0;
        for (int y = part.y; y < part.y + part.extent.height; ++y)
            for (int x = part.x; x < part.x + part.extent.width; ++x)
                sum += at(x, y, channel);
        return sum / double(part.extent.pixels());
    }

    /// Returns the mean square of the differences between neighbours.
    double detail() const {
        double squares = 0;
        for (int y = 0; y + 1 < image_.extent.height; ++y)
            for (int x = 0; x + 1 < image_.extent.width; ++x)
                for (size_t channel = 0; channel < channels_; ++channel) {
                    const double here = at(x, y, channel);
                    squares +=
                        std::pow(at(x + 1, y, channel) - here, 2) + std::pow(at(x, y + 1, channel) - here, 2);
                }
        return squares / double(image_.samples());
    }

private:
    const image::Image& image_;
    size_t channels_;
};

/// Returns how many times more detail one picture has than the other; less than a step of 8 bits counts as
/// none.
double ratio_of_detail(const image::Image& left, const image::Image& right) {
    constexpr double k_none = 2 * k_visible_gap * k_visible_gap;
    const double a = ShownImage(left).detail() + k_none, b = ShownImage(right).detail() + k_none;
    return std::max(a, b) / std::min(a, b);
}

bool means_differ(const image::Image& left, const image::Image& right, const Rectangle& part, double most) {
    for (size_t channel = 0; channel < size_t(left.channels); ++channel)
        if (std::abs(ShownImage(left).mean(part, channel) - ShownImage(right).mean(part, channel)) > most)
            return true;
    return false;
}

std::string decibels(double mean_square) {
    return mean_square == 0 ? "the same" : fmt::format("{:.1f} dB", -10 * std::log10(mean_square));
}

} // namespace

double p99_difference(const image::Image& left, const image::Image& right) {
    return quantile(largest_differences(left, right), 0.99);
}

double visibly_different_percent(const image::Image& left, const image::Image& right) {
    const std::vector<double> largest = largest_differences(left, right);
    const auto visible = std::ranges::count_if(largest, [](double gap) { return gap > k_visible_gap; });
    return 100 * double(visible) / double(largest.size());
}

bool looks_different(const image::Image& left, const image::Image& right) {
    constexpr int k_block = 4;
    constexpr double k_most_blocks = 0.05, k_other_detail = 1.3;
    size_t blocks = 0, different = 0;
    for (int y = 0; y < left.extent.height; y += k_block)
        for (int x = 0; x < left.extent.width; x += k_block) {
            const Extent size{std::min(k_block, left.extent.width - x),
                              std::min(k_block, left.extent.height - y)};
            ++blocks;
            different += means_differ(left, right, {x, y, size}, k_noticeable_gap);
        }
    return double(different) > k_most_blocks * double(blocks) ||
           ratio_of_detail(left, right) > k_other_detail;
}

bool breaks_up(const image::Image& floats, const image::Image& doubles, bool from_the_start) {
    constexpr double k_same_brightness = 0.02, k_same_detail = 2; // noise of few spots varies as much
    const bool alike = !means_differ(floats, doubles, {0, 0, floats.extent}, k_same_brightness) &&
                       ratio_of_detail(floats, doubles) < k_same_detail;
    return p99_difference(floats, doubles) > k_noticeable_gap && looks_different(floats, doubles) &&
           !(from_the_start && alike);
}

std::string alikeness(const image::Image& before, const image::Image& after) {
    if (const auto difference = image::compare(before, after); difference && !std::isnan(difference->psnr))
        return decibels(difference->rmse * difference->rmse);
    const auto channels = size_t(before.channels);
    size_t none_before = 0, none_after = 0, numbers = 0;
    double squares = 0;
    for (size_t pixel = 0; pixel < before.extent.pixels(); ++pixel) {
        const bool first = is_number(before, pixel), second = is_number(after, pixel);
        none_before += !first;
        none_after += !second;
        if (!first || !second)
            continue;
        ++numbers;
        for (size_t i = pixel * channels; i < (pixel + 1) * channels; ++i)
            squares += std::pow(double(before.f32()[i]) - double(after.f32()[i]), 2);
    }
    const std::string counted =
        fmt::format("{} pixels with NaN or infinity become {}", none_before, none_after);
    return numbers == 0
               ? counted + ", and no pixel is finite in both"
               : fmt::format("{}, {} over the rest", counted, decibels(squares / double(numbers * channels)));
}

size_t different_pixels(const image::Image& left, const image::Image& right) {
    const auto pixel = std::ptrdiff_t(left.row_bytes()) / left.extent.width;
    size_t count = 0;
    for (auto a = left.bytes.begin(), b = right.bytes.begin(); a != left.bytes.end(); a += pixel, b += pixel)
        count += !std::equal(a, a + pixel, b);
    return count;
}

namespace {

/// A picture in grey with non-finite pixels in magenta, and the number of these.
struct Marked {
    image::Image map;
    size_t bad = 0; ///< pixels
};
Marked marked(const image::Image& picture) {
    Marked result{image::Image(picture.extent, 3, image::SampleType::f32)};
    const auto channels = size_t(picture.channels);
    for (size_t i = 0; i < picture.extent.pixels(); ++i) {
        const auto samples = picture.f32().subspan(i * channels, channels);
        const bool bad = std::ranges::any_of(samples, [](float v) { return !std::isfinite(v); });
        const float grey = bad ? 0.0f : std::clamp((samples[0] + samples[1] + samples[2]) / 3, 0.0f, 1.0f);
        const float shown[] = {bad ? 1.0f : grey, grey, bad ? 1.0f : grey};
        std::ranges::copy(shown, result.map.f32().begin() + std::ptrdiff_t(3 * i));
        result.bad += bad;
    }
    return result;
}

std::string kinds(const image::FiniteCensus& census) {
    std::string text;
    const std::pair<size_t, const char*> kinds[] = {
        {census.nan, "NaN"}, {census.positive_infinity, "+Inf"}, {census.negative_infinity, "-Inf"}};
    for (const auto& [count, name] : kinds)
        if (count > 0)
            text += fmt::format("{}{}", text.empty() ? "" : ", ", name);
    return text;
}

/// Returns nothing if the plain state is finite; otherwise the answer that refers to `times`, which reports
/// it.
Result<std::optional<Answer>> known_before(ProbeBench& bench) {
    const auto passes = TRY(bench.passes(plain_state()));
    if (not_finite(bench, plain_state(), passes))
        return Answer{Verdict::not_applicable, "NaN or infinity in the unchanged scene: see times"};
    return std::optional<Answer>{};
}

} // namespace

std::string duration_in_words(double seconds) {
    constexpr std::pair<double, const char*> units[] = {{86400, "days"}, {3600, "hours"}, {60, "minutes"}};
    for (const auto& [length, name] : units)
        if (seconds >= 1.5 * length)
            return fmt::format("{:.2g} {}", seconds / length, name);
    return fmt::format("{:.3g} s", seconds);
}

Verdict severity_in(const ProbeBench& bench, const FrameState& state) {
    const auto outside = [&](const glm::vec2& place) {
        return place.x < 0 || place.y < 0 || place.x > float(state.extent.width) ||
               place.y > float(state.extent.height);
    };
    if (state.seconds() < 0 || std::min(state.extent.width, state.extent.height) < 2)
        return Verdict::note;
    if (state.seconds() > bench.promises().time_horizon || !state.channels.empty() ||
        outside(state.mouse.position) || outside(state.mouse.pressed_at))
        return Verdict::warn;
    return Verdict::fail;
}

namespace {

/// Returns what is unusual about a state, to follow a clause: " at 2.8 hours".
std::string situation(const FrameState& state) {
    std::string words;
    if (!state.channels.empty())
        words += " with --channel " + state.channels.front();
    if (!state.knobs.empty())
        words += " with " + to_string(state.knobs);
    if (state.mouse != render::Mouse{})
        words += fmt::format(" with the mouse at {:.0f},{:.0f} of {}x{}", state.mouse.position.x,
                             state.mouse.position.y, state.extent.width, state.extent.height);
    else if (state.extent.width % 2 != 0 || state.extent.height % 2 != 0)
        words += fmt::format(" in a picture of {}x{}", state.extent.width, state.extent.height);
    if (const double seconds = state.seconds(); seconds < 0 || seconds > 1)
        words += " at " + duration_in_words(seconds);
    return words;
}

/// Returns whether all that is not finite are some +Inf that show as the pixels around them do: fully bright.
bool shows_as_around(const image::Image& picture, const image::FiniteCensus& census) {
    constexpr size_t k_some = 100; // of so many samples one
    if (census.nan > 0 || census.negative_infinity > 0 ||
        k_some * census.positive_infinity > picture.samples())
        return false;
    const auto channels = size_t(picture.channels);
    const auto at = [&](int x, int y, size_t channel) {
        return picture.f32()[(size_t(y) * size_t(picture.extent.width) + size_t(x)) * channels + channel];
    };
    for (int y = 0; y < picture.extent.height; ++y)
        for (int x = 0; x < picture.extent.width; ++x)
            for (size_t channel = 0; channel < channels; ++channel)
                for (const auto& [i, k] : {std::pair(x - 1, y), {x + 1, y}, {x, y - 1}, {x, y + 1}})
                    if (std::isinf(at(x, y, channel)) && i >= 0 && k >= 0 && i < picture.extent.width &&
                        k < picture.extent.height && at(i, k, channel) < 1)
                        return false;
    return true;
}

} // namespace

std::optional<Answer> not_finite(const ProbeBench& bench, const FrameState& state,
                                 const std::vector<PassPicture>& passes) {
    for (const PassPicture& pass : passes) {
        const image::FiniteCensus census = image::census(pass.picture);
        if (census.non_finite() == 0)
            continue;
        Marked shown = marked(pass.picture);
        Answer answer{severity_in(bench, state),
                      fmt::format("{} in {} of {} pixels of {}, first at pixel {},{}", kinds(census),
                                  shown.bad, pass.picture.extent.pixels(), pass.pass,
                                  census.first_non_finite->x, census.first_non_finite->y),
                      state, std::move(shown.map), true};
        const bool image = pass.pass == bench.scene().image().name;
        answer.where->pass = image ? "" : pass.pass;
        answer.effect = fmt::format("some pixels {}are NaN or infinite{}",
                                    image ? "" : fmt::format("of {} ", pass.pass), situation(state));
        if (image && shows_as_around(pass.picture, census)) {
            answer.verdict = Verdict::note;
            answer.effect = "some pixels are infinite, and show as bright as those around them";
        }
        return answer;
    }
    return std::nullopt;
}

Result<Answer> look(ProbeBench& bench, const std::vector<FrameState>& states) {
    Answer answer;
    size_t bad = 0, subnormal = 0, beyond_half = 0;
    for (const FrameState& state : states) {
        const auto passes = TRY(bench.passes(state));
        for (const PassPicture& pass : passes) {
            const image::FiniteCensus census = image::census(pass.picture);
            subnormal += census.subnormal > 0;
            beyond_half += census.beyond_half > 0;
        }
        auto fault = not_finite(bench, state, passes);
        bad += fault.has_value();
        if (fault && (!answer.where || fault->verdict > answer.verdict))
            answer = *std::move(fault);
    }
    answer.sentence += bad > 0 ? fmt::format("; in {} of {} situations", bad, states.size())
                               : fmt::format("no NaN or infinity in {} situations", states.size());
    if (subnormal > 0)
        answer.sentence += fmt::format("; subnormal numbers in {}", subnormal);
    if (beyond_half > 0)
        answer.sentence += fmt::format("; numbers too large for half floats in {}", beyond_half);
    return answer;
}

Result<Answer> look_anew(ProbeBench& bench, const std::vector<FrameState>& states) {
    auto known = TRY(known_before(bench));
    return known ? *std::move(known) : look(bench, states);
}

namespace {

/// A step of iTime that is shorter than this does not disturb motion.
constexpr double k_short_step = 1.0 / 240; // s

/// Compares two pictures in double that are a step of iTime apart, if the step is long.
Result<std::optional<TimeStep>> visible_step(ProbeBench& bench, double seconds, const FrameState& state,
                                             const image::Image& picture) {
    const auto time = float(state.seconds());
    const double next = double(std::nextafter(time, INFINITY)), step = next - double(time);
    if (step < k_short_step)
        return std::optional<TimeStep>{};
    const auto later = TRY(bench.picture(render::at_time(next, state), glsl::Precision::promoted));
    const double difference = p99_difference(picture, later);
    return difference > k_visible_gap ? std::optional(TimeStep{seconds, step, difference}) : std::nullopt;
}

} // namespace

std::optional<LostDigits> where_digits_are_lost(ProbeBench& bench, const Mismatch& mismatch) {
    constexpr double k_least_lost = 2;
    const std::vector<double> largest = largest_differences(mismatch.floats, mismatch.doubles);
    const auto worst = int(std::ranges::max_element(largest) - largest.begin());
    const int width = mismatch.floats.extent.width, height = mismatch.floats.extent.height;
    const auto renderer = bench.drawn(mismatch.state);
    if (!renderer)
        return std::nullopt;
    // Pictures begin with their top row, pixels are counted from the bottom.
    const auto trace = trace_pixel(**renderer, render::inputs_of(mismatch.state),
                                   {.pixel = {worst % width, height - 1 - worst / width}});
    const TracedLine* const line = trace ? most_lossy(*trace) : nullptr;
    if (!line)
        return std::nullopt;
    const SourceLocation& where = line->line.where;
    if (line->lost >= k_least_lost)
        return LostDigits{
            where, fmt::format("{}:{} loses {:.1f} digits at once", where.file, where.line, line->lost)};
    return LostDigits{where,
                      fmt::format("{}:{} adds so large a number that {:.1f} digits of the other are dropped",
                                  where.file, where.line, line->dropped)};
}

Result<Horizon> find_horizon(ProbeBench& bench) {
    Horizon horizon;
    for (const double time : {1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6}) {
        const FrameState state = state_at_float(time);
        auto as_is = TRY(bench.picture(state));
        auto truth = TRY(bench.picture(state, glsl::Precision::promoted));
        if (!horizon.time_step)
            horizon.time_step = TRY(visible_step(bench, time, state, truth));
        const double difference = p99_difference(as_is, truth);
        if (difference > k_visible_gap) {
            horizon.mismatch = Mismatch{time, state, std::move(as_is), std::move(truth), difference};
            break;
        }
        horizon.good = time;
    }
    return horizon;
}

} // namespace tidemark::lab
