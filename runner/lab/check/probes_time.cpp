// What becomes of a scene as its clock runs: rounding, cuts, and random numbers that hang on roundings.
#include "image/compare/metrics.hpp"
#include "lab/check/picture_gap.hpp"
#include "lab/check/probes.hpp"
#include "text/tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

namespace tidemark::lab {
namespace {

/// Between two pictures that show whether motion goes on or is cut: a hundredth of a frame at 60 a second, or
/// as many steps of iTime in binary32 as motion needs to show.
double instant(double time) {
    return std::max(1.0 / 6000, 8 * (double(std::nextafter(float(time), 1e9f)) - double(float(time))));
}

/// Frames that are closer than this do not jump, whatever their neighbours do.
constexpr double k_close_psnr = 45; // dB

/// Numbers in the text and among the knobs that time may be taken modulo of.
std::vector<double> possible_periods(const scene::Scene& scene) {
    std::set<double> periods;
    const auto note = [&](double number) {
        if (number >= 1 && number <= 1e5)
            periods.insert(number);
    };
    const auto read = [&](const text::MappedText& text) {
        for (const text::Token& token : text::tokenize(text.text())) {
            double number = 0;
            if (token.kind == text::TokenKind::number &&
                std::from_chars(token.text.data(), token.text.data() + token.text.size(), number).ec ==
                    std::errc{})
                note(number);
        }
    };
    read(scene.common);
    for (const scene::Pass& pass : scene.passes)
        read(pass.text);
    for (const scene::Knob& knob : scene.knobs)
        note(knob.value[0]);
    return {periods.begin(), periods.end()};
}

/// How much less alike the pictures an instant before and after `moment` are than their neighbours, dB; and
/// how alike.
struct Jump {
    double drop = 0;
    double psnr = 0;
};
Result<Jump> jump_at(ProbeBench& bench, double moment) {
    std::vector<image::Image> frames;
    for (const double offset : {-1.5, -0.5, 0.5, 1.5}) {
        auto frame = bench.picture({.time = moment + offset * instant(moment)});
        if (!frame)
            return fail(std::move(frame.error()));
        frames.push_back(*std::move(frame));
    }
    double psnr[3];
    for (size_t i = 0; i < 3; ++i) {
        const auto difference = image::compare(frames[i], frames[i + 1]);
        if (!difference)
            return fail(difference.error());
        psnr[i] = difference->psnr;
    }
    return Jump{std::min({psnr[0], psnr[2], 2 * k_close_psnr}) - psnr[1], psnr[1]};
}

} // namespace

/// Of a second: a moment like most, which is no binary32.
constexpr double k_third = 1.0 / 3;

Result<Answer> ask_horizon(ProbeBench& bench) {
    double good = 0;
    for (const double time : {1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6}) {
        const Situation situation{.time = time + k_third};
        const auto as_is = bench.picture(situation);
        if (!as_is)
            return fail(as_is.error());
        auto truth = bench.picture(situation, glsl::Precision::promoted);
        if (!truth)
            return Answer{Verdict::not_applicable, "not to be had in double: " + to_string(truth.error())};
        const double difference = p99_difference(*as_is, *truth);
        if (difference <= k_visible_gap) {
            good = time;
            continue;
        }
        const bool kept = good >= bench.promises().time_horizon;
        const std::string found =
            good == 0
                ? fmt::format(
                      "float and double differ from the first second on: by {:.3g} in 1 % of the pixels "
                      "at 1 s, which is not the clock's doing",
                      difference)
                : fmt::format("good to {:g} s; at {:g} s, where iTime moves in steps of {:.2g} s, 1 % of "
                              "the pixels are off by {:.3g} or more",
                              good, time, double(std::nextafter(float(time), 1e9f)) - double(float(time)),
                              difference);
        return Answer{kept        ? Verdict::pass
                      : good == 0 ? Verdict::warn
                                  : Verdict::fail,
                      found, situation, *as_is};
    }
    return Answer{Verdict::pass, "float and double show the same up to 1e6 s"};
}

Result<Answer> ask_jumps(ProbeBench& bench) {
    const std::vector<double> periods = possible_periods(bench.scene());
    Answer answer;
    double worst = bench.promises().smoothest_jump;
    for (const double period : periods) {
        const auto jump = jump_at(bench, period);
        if (!jump)
            return fail(jump.error());
        if (!(jump->drop > worst) || jump->psnr > k_close_psnr)
            continue;
        worst = jump->drop;
        answer = {Verdict::fail,
                  fmt::format("at {:g} s the picture is cut: {:.1f} dB from one instant to the next, {:.1f} "
                              "less than before and after",
                              period, jump->psnr, jump->drop),
                  Situation{.time = period + instant(period) / 2}};
    }
    if (answer.verdict == Verdict::pass)
        answer.sentence =
            fmt::format("no cut at {} numbers that time may be taken modulo of", periods.size());
    return answer;
}

Result<Answer> ask_hashes(ProbeBench& bench) {
    const auto hashes = bench.hashes();
    if (!hashes)
        return Answer{Verdict::not_applicable, "not to be read: " + to_string(hashes.error())};
    std::string found;
    for (const glsl::KeptHash& hash : *hashes)
        if (hash.kind == glsl::HashKind::sine)
            found += fmt::format("{}{}:{}{}", found.empty() ? "" : ", ", hash.where.file, hash.where.line,
                                 hash.function.empty() ? "" : " " + hash.function);
    if (found.empty())
        return Answer{Verdict::pass, "no random numbers from large sines"};
    return Answer{Verdict::warn, "fract of a large sine, another number on every GPU: " + found};
}

} // namespace tidemark::lab
