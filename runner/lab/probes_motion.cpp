// The same again, and the next pixel of the mouse.
#include "image/metrics.hpp"
#include "lab/probes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::lab {
namespace {

/// Narrow and high: small steps of the mouse in few pixels.
constexpr Extent k_narrow{16, 180};
/// A step that changes the picture so much more than the steps before and after it is a turn.
constexpr double k_turn = 4; // dB

} // namespace

Result<Answer> ask_repeats(ProbeBench& bench) {
    const Situation situation{.time = 2};
    const auto first = bench.picture(situation);
    if (!first)
        return fail(first.error());
    const auto same = [&](const Result<image::Image>& other) {
        return other && other->bytes == first->bytes;
    };
    const auto say_no = [&](const char* when) {
        return Answer{Verdict::fail, fmt::format("another picture {}", when), situation, *first};
    };
    if (!same(bench.picture(situation)))
        return say_no("at once again");
    (void)bench.picture({.time = 7});
    if (!same(bench.picture(situation)))
        return say_no("after another frame");
    if (!same(bench.fresh_picture(situation)))
        return say_no("after compiling anew");
    return Answer{Verdict::pass, "the same bytes again, after another frame and compiled anew"};
}

Result<Answer> ask_camera(ProbeBench& bench) {
    std::vector<image::Image> rows;
    for (int y = 1; y < k_narrow.height; ++y) {
        auto picture = bench.picture({.extent = k_narrow, .mouse = glm::ivec2(k_narrow.width / 2, y)});
        if (!picture)
            return fail(std::move(picture.error()));
        rows.push_back(*std::move(picture));
    }
    std::vector<double> steps;
    for (size_t i = 0; i + 1 < rows.size(); ++i)
        steps.push_back(image::compare(rows[i], rows[i + 1])->psnr);
    if (std::ranges::all_of(steps, [](double psnr) { return std::isinf(psnr); }))
        return Answer{Verdict::not_applicable, "the mouse's height changes nothing"};
    size_t at = 1;
    double most = 0;
    for (size_t i = 1; i + 1 < steps.size(); ++i)
        if (const double drop = std::min(steps[i - 1], steps[i + 1]) - steps[i]; drop > most) {
            most = drop;
            at = i;
        }
    if (!(most > k_turn))
        return Answer{Verdict::pass,
                      fmt::format("one pixel of the mouse changes the picture evenly, to {:.1f} dB", most),
                      {},
                      {}};
    const int y = int(at) + 1;
    return Answer{
        Verdict::fail,
        fmt::format("the mouse from y = {} to {} of {} turns the picture: {:.1f} dB, {:.1f} less than "
                    "the steps beside it",
                    y, y + 1, k_narrow.height, steps[at], most),
        Situation{.extent = k_narrow, .mouse = glm::ivec2(k_narrow.width / 2, y + 1)}, rows[at + 1]};
}

} // namespace tidemark::lab
