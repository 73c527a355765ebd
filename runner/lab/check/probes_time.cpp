// Checks a scene as its clock runs: rounding, jumps, and random numbers that depend on rounding.
#include "base/try.hpp"
#include "image/compare/metrics.hpp"
#include "lab/check/horizon.hpp"
#include "lab/check/picture_gap.hpp"
#include "lab/check/probe_text.hpp"
#include "lab/check/probes.hpp"
#include "lab/defined_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace tidemark::lab {
namespace {

/// Returns the seconds between two pictures that tell a jump from motion: a hundredth of a frame at 60 fps,
/// or eight steps of iTime in binary32 if that is more.
double instant(double time) {
    return std::max(1.0 / 6000, 8 * (double(std::nextafter(float(time), 1e9f)) - double(float(time))));
}

/// Pictures closer than this do not count as a jump, whatever their neighbours are.
constexpr double k_close_psnr = 45; // dB

/// Returns numbers from 1 to 1e5 of the text and the knobs, any of which time may be taken modulo of.
std::vector<double> possible_periods(const scene::Scene& scene) {
    std::set<double> periods;
    const auto note = [&](double number) {
        if (number >= 1 && number <= 1e5)
            periods.insert(number);
    };
    for (const TextNumber& number : text_numbers(scene))
        note(number.value);
    for (const scene::Knob& knob : scene.knobs)
        note(knob.value[0]);
    return {periods.begin(), periods.end()};
}

/// PSNRs of pictures around a moment, dB.
struct Jump {
    image::Image after;   ///< the picture just after the moment
    double psnr = 0;      ///< of the pictures half an instant before and after the moment
    double elsewhere = 0; ///< of each with its other neighbour, the lower one; infinite: nothing moves there
    bool wraps = false;   ///< the picture after the moment equals that of the start

    double drop() const { return std::min(elsewhere, 2 * k_close_psnr) - psnr; }
};
Result<Jump> jump_at(ProbeBench& bench, double moment) {
    std::vector<image::Image> frames;
    const double step = instant(moment);
    for (const double offset : {-1.5, -0.5, 0.5, 1.5}) {
        auto frame = TRY(bench.picture(state_at(moment + offset * step)));
        frames.push_back(std::move(frame));
    }
    const auto psnr = [&](const image::Image& left, const image::Image& right) {
        return image::compare(left, right)->psnr;
    };
    Jump jump{frames[2], psnr(frames[1], frames[2]),
              std::min(psnr(frames[0], frames[1]), psnr(frames[2], frames[3]))};
    if (jump.psnr <= k_close_psnr && std::isfinite(jump.elsewhere)) {
        const auto start = TRY(bench.picture(state_at(0.5 * step)));
        jump.wraps = psnr(frames[2], start) > k_close_psnr;
    }
    return jump;
}

} // namespace

Result<Answer> ask_horizon(ProbeBench& bench) {
    TRY(bench.picture(state_at(1))); // report errors of the scene itself first, not as a lack of doubles
    const auto horizon = find_horizon(bench);
    if (!horizon)
        return Answer{Verdict::not_applicable, "cannot be drawn in double: " + to_string(horizon.error())};
    if (!horizon->mismatch)
        return Answer{Verdict::pass, "float and double agree up to 1e6 s"};
    const double good = horizon->good, time = horizon->mismatch->seconds;
    const bool kept = good >= bench.promises().time_horizon;
    const std::string found =
        good == 0
            ? fmt::format("float and double differ already at 1 s, by {:.3g} or more in 1 % of the pixels: "
                          "not because of a large iTime",
                          horizon->mismatch->difference)
            : fmt::format("float and double agree up to {:g} s; at {:g} s, where iTime moves in steps of "
                          "{:.2g} s, 1 % of the pixels are off by {:.3g} or more",
                          good, time, double(std::nextafter(float(time), 1e9f)) - double(float(time)),
                          horizon->mismatch->difference);
    return Answer{kept        ? Verdict::pass
                  : good == 0 ? Verdict::warn
                              : Verdict::fail,
                  found, horizon->mismatch->state, horizon->mismatch->floats};
}

namespace {

/// A jump fails if the clock restarts or the file promises smoothness; otherwise it is a warning, since a cut
/// may be intended.
Answer answer_of(const Jump& jump, double moment, bool promised) {
    const std::string elsewhere =
        std::isinf(jump.elsewhere) ? "no change" : fmt::format("{:.1f} dB", jump.elsewhere);
    const char* const consequence = jump.wraps ? " back to the one of 0 s"
                                    : promised
                                        ? ""
                                        : "; a scene that cuts may say so: \"skip\" in its .check.json";
    return {jump.wraps || promised ? Verdict::fail : Verdict::warn,
            fmt::format("the picture jumps at {:g} s (PSNR {:.1f} dB between neighbouring instants, {} "
                        "elsewhere){}",
                        moment, jump.psnr, elsewhere, consequence),
            state_at(moment + instant(moment) / 2), jump.after};
}

} // namespace

Result<Answer> ask_time_discontinuity(ProbeBench& bench) {
    const std::vector<double> periods = possible_periods(bench.scene());
    const Promises& promises = bench.promises();
    Answer answer;
    double worst = 0; // of the findings with the answer's verdict
    for (const double period : periods) {
        const auto jump = TRY(jump_at(bench, period));
        if (!(jump.drop() > promises.smoothest_jump) || jump.psnr > k_close_psnr)
            continue;
        Answer found = answer_of(jump, period, promises.stated.contains("smoothest_jump"));
        if (std::pair(found.verdict, jump.drop()) > std::pair(answer.verdict, worst)) {
            worst = jump.drop();
            answer = std::move(found);
        }
    }
    if (answer.verdict == Verdict::pass)
        answer.sentence = fmt::format("no jump at any of {} candidate periods", periods.size());
    return answer;
}

Result<Answer> ask_hashes(ProbeBench& bench) {
    const auto hashes = bench.hashes();
    if (!hashes)
        return Answer{Verdict::not_applicable,
                      "the scene cannot be promoted to double: " + to_string(hashes.error())};
    std::vector<std::string> found; // Common is part of every pass, so list each once
    for (const glsl::KeptHash& hash : *hashes) {
        const std::string said = fmt::format("{}:{}{}", hash.where.file, hash.where.line,
                                             hash.function.empty() ? "" : " " + hash.function);
        if (hash.kind == glsl::HashKind::sine && std::ranges::find(found, said) == found.end())
            found.push_back(said);
    }
    if (found.empty())
        return Answer{Verdict::pass, "no random numbers from large sines"};
    return Answer{Verdict::warn, "fract of a large sine gives other numbers on every GPU: " + listed(found)};
}

} // namespace tidemark::lab
