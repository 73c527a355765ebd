#include "report/log_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace tidemark::report {
namespace {

/// Margin beyond the outermost values, as a fraction of the axis.
constexpr double k_room = 0.07;
constexpr size_t k_fewest_ticks = 3;
constexpr double k_most_ticks = 9;

/// Returns `mantissas` times every `stride`-th power of ten, within the axis.
std::vector<double> multiples(const LogAxis& axis, std::span<const double> mantissas, int stride) {
    std::vector<double> found;
    const int from = int(std::floor(std::log10(axis.low) / stride)) * stride;
    for (int power = from; std::pow(10.0, power) <= axis.high; power += stride)
        for (const double mantissa : mantissas)
            if (const double value = mantissa * std::pow(10.0, power);
                value >= axis.low && value <= axis.high)
                found.push_back(value);
    return found;
}

/// Returns evenly spaced round numbers, for an axis whose ends differ by a factor of about two.
std::vector<double> round_numbers(const LogAxis& axis) {
    const double wanted = (axis.high - axis.low) / 4;
    const double power = std::pow(10.0, std::floor(std::log10(wanted)));
    const double step = power * (wanted < 2 * power ? 1 : wanted < 5 * power ? 2 : 5);
    std::vector<double> found;
    const auto last = int(std::floor(axis.high / step));
    for (auto n = int(std::ceil(axis.low / step)); n <= last; ++n)
        found.push_back(n * step);
    return found;
}

std::string superscript(int number) {
    constexpr std::array k_digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text;
    for (const char c : std::to_string(number))
        text += c == '-' ? "⁻" : k_digits[size_t(c - '0')];
    return text;
}

} // namespace

double LogAxis::pixel(double value) const {
    return first + (last - first) * (std::log(value) - std::log(low)) / (std::log(high) - std::log(low));
}

LogAxis log_axis(double least, double most, double first, double last) {
    const double span = std::max(std::log(most) - std::log(least), 0.1);
    const double factor = std::exp(k_room * span / (1 - 2 * k_room));
    using Limits = std::numeric_limits<double>;
    return {std::max(least / factor, Limits::min()), std::min(most * factor, Limits::max()), first, last};
}

std::vector<double> ticks(const LogAxis& axis) {
    constexpr std::array k_one{1.0};
    constexpr std::array k_three{1.0, 2.0, 5.0};
    const double decades = std::log10(axis.high) - std::log10(axis.low);
    auto found = multiples(axis, k_one, std::max(1, int(std::ceil(decades / k_most_ticks))));
    if (found.size() < k_fewest_ticks)
        found = multiples(axis, k_three, 1);
    return found.size() < k_fewest_ticks ? round_numbers(axis) : found;
}

std::string tick_text(double value) {
    const int power = int(std::floor(std::log10(value) + 1e-9));
    if (power > -4 && power < 5)
        return fmt::format("{:.4g}", value);
    const std::string mantissa = fmt::format("{:.4g}", value / std::pow(10.0, power));
    return (mantissa == "1" ? "" : mantissa + "·") + "10" + superscript(power);
}

} // namespace tidemark::report
