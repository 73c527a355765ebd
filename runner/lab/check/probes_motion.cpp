// Checks whether a picture repeats exactly, with one thread too, and whether it changes evenly with the
// mouse.
#include "base/try.hpp"
#include "image/census.hpp"
#include "image/compare/metrics.hpp"
#include "lab/check/picture_gap.hpp"
#include "lab/check/probes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace tidemark::lab {
namespace {

/// Narrow and high: small mouse steps in few pixels.
constexpr Extent k_strip{16, 180};
/// A mouse step jumps if its PSNR is this much below that of the steps before and after it.
constexpr double k_turn = 4; // dB
/// Pictures closer than this do not count as a jump, however alike their neighbours are.
constexpr double k_alike = 60; // dB

} // namespace

Result<Answer> ask_repeats(ProbeBench& bench) {
    const FrameState state = state_at(2);
    const auto first = TRY(bench.picture(state));
    const auto same = [&](const Result<image::Image>& other) { return other && other->bytes == first.bytes; };
    const auto say_no = [&](const char* when) {
        return Answer{Verdict::fail,
                      fmt::format("the same inputs give another picture {}{}", when, bench.see_bounds()),
                      state, first};
    };
    if (!same(bench.picture(state)))
        return say_no("when drawn again at once");
    (void)bench.picture(state_at(7));
    if (!same(bench.picture(state)))
        return say_no("after another frame");
    if (!same(bench.fresh_picture(state)))
        return say_no("after compiling anew");
    return Answer{Verdict::pass, "the same bytes again, after another frame and compiled anew"};
}

Result<Answer> ask_threads(ProbeBench& bench) {
    if (!bench.with_one_thread())
        return Answer{Verdict::not_applicable, "this driver does not let us choose its number of threads"};
    // Drivers distribute squares of 64 pixels to their threads, so the picture needs several.
    const FrameState state = state_at(2, {200, 136});
    const auto alone = bench.with_one_thread()(state);
    if (!alone)
        return Answer{Verdict::not_applicable,
                      "it could not be drawn with one thread: " + alone.error().message};
    auto together = TRY(bench.picture(state));
    if (const size_t different = different_pixels(*alone, together))
        return Answer{Verdict::fail,
                      fmt::format("{} of {} pixels differ when one thread draws them all{}", different,
                                  state.extent.pixels(), bench.see_bounds()),
                      state, std::move(together)};
    return Answer{Verdict::pass, "the same bytes whether many threads draw or one"};
}

namespace {

/// A mouse movement pixel by pixel along one axis, with the other coordinate in the middle.
struct Sweep {
    const char* axis;
    Extent extent;
    int length;
    std::function<glm::ivec2(int)> pixel;

    FrameState at(int step) const {
        return with_mouse(render::Mouse::clicked(pixel(step), false), plain_state(extent));
    }
};

/// The largest jump of a sweep relative to the steps around it, and its first picture that is not finite.
struct Swept {
    bool changes = false;
    double most = 0; ///< PSNR below that of the steps before and after, dB
    double psnr = 0;
    int step = 1; ///< the jump is from this pixel to the next
    std::optional<int> not_finite{};
};

Result<Swept> swept(ProbeBench& bench, const Sweep& sweep) {
    Swept found;
    std::vector<double> steps;
    std::optional<image::Image> last;
    for (int pixel = 1; pixel < sweep.length; ++pixel) {
        auto picture = TRY(bench.picture(sweep.at(pixel)));
        if (!found.not_finite && image::census(picture).non_finite() > 0)
            found.not_finite = pixel;
        if (last)
            steps.push_back(image::compare(*last, picture)->psnr);
        last = std::move(picture);
    }
    found.changes = !std::ranges::all_of(steps, [](double psnr) { return std::isinf(psnr); });
    for (size_t i = 1; i + 1 < steps.size(); ++i)
        if (const double drop = std::min(steps[i - 1], steps[i + 1]) - steps[i]; drop > found.most) {
            found.most = drop;
            found.psnr = steps[i];
            found.step = int(i) + 1;
        }
    return found;
}

/// Returns the answer if the sweep shows a fault.
Result<std::optional<Answer>> fault(ProbeBench& bench, const Sweep& sweep, const Swept& found) {
    const auto show = [&](int pixel, std::string sentence) -> Result<std::optional<Answer>> {
        const FrameState where = sweep.at(pixel);
        auto picture = TRY(bench.picture(where));
        return Answer{Verdict::fail, std::move(sentence), where, std::move(picture)};
    };
    if (found.not_finite) {
        const auto untouched = TRY(bench.picture(plain_state(sweep.extent)));
        if (image::census(untouched).non_finite() > 0)
            return Answer{Verdict::not_applicable, "NaN or infinity without the mouse, too: see times"};
        return show(*found.not_finite,
                    fmt::format("NaN or infinity in the picture with the mouse at {} = {} of {}", sweep.axis,
                                *found.not_finite, sweep.length));
    }
    if (found.most > k_turn)
        return show(
            found.step + 1,
            fmt::format(
                "the picture jumps where the mouse goes from {} = {} to {} of {}: PSNR {:.1f} dB, {:.1f} "
                "dB less than for the steps beside it",
                sweep.axis, found.step, found.step + 1, sweep.length, found.psnr, found.most));
    return std::optional<Answer>{};
}

} // namespace

Result<Answer> ask_camera(ProbeBench& bench) {
    const Sweep sweeps[] = {
        {"y", k_strip, k_strip.height, [](int y) { return glm::ivec2(k_strip.width / 2, y); }},
        {"x", {k_strip.height, k_strip.width}, k_strip.height, [](int x) {
             return glm::ivec2(x, k_strip.width / 2);
         }}};
    bool changes = false;
    double most = 0;
    for (const Sweep& sweep : sweeps) {
        const auto found = TRY(swept(bench, sweep));
        auto answer = TRY(fault(bench, sweep, found));
        if (answer)
            return *std::move(answer);
        changes |= found.changes;
        most = std::max(most, found.most);
    }
    if (!changes)
        return Answer{Verdict::not_applicable, "the mouse changes nothing"};
    return Answer{
        Verdict::pass,
        fmt::format("the picture turns evenly: the PSNR of a step of the mouse by a pixel is at most "
                    "{:.1f} dB less than for the steps beside it",
                    most)};
}

Result<Answer> ask_mouse_edge(ProbeBench& bench) {
    const Extent size = k_probe_extent;
    const std::pair<const char*, glm::ivec2> edges[] = {{"column", {0, size.height / 2}},
                                                        {"row", {size.width / 2, 0}}};
    const auto clicked = [](glm::ivec2 pixel) { return with_mouse(render::Mouse::clicked(pixel, false)); };
    for (const auto& [name, first] : edges) {
        const glm::ivec2 inwards = first.x == 0 ? glm::ivec2(1, 0) : glm::ivec2(0, 1);
        std::vector<image::Image> pictures;
        for (int pixel = 0; pixel < 3; ++pixel) {
            auto picture = TRY(bench.picture(clicked(first + pixel * inwards)));
            pictures.push_back(std::move(picture));
        }
        const double edge = image::compare(pictures[0], pictures[1])->psnr;
        const double next = std::min(image::compare(pictures[1], pictures[2])->psnr, k_alike);
        if (next - edge > k_turn)
            return Answer{
                Verdict::fail,
                fmt::format("a click in {0} 0 shows another view than in {0} 1: PSNR {1:.1f} dB, from {0} 1 "
                            "to 2 {2:.1f} dB",
                            name, edge, next),
                clicked(first), pictures[0]};
    }
    const auto untouched = bench.picture(plain_state());
    const auto corner = bench.picture(clicked({1, 1}));
    if (!untouched || !corner)
        return fail(!untouched ? untouched.error() : corner.error());
    if (image::compare(*untouched, *corner)->equal())
        return Answer{Verdict::not_applicable, "a click changes nothing"};
    return Answer{Verdict::pass, "a click at the edge is taken for a click; one in the corner changes the "
                                 "picture: " +
                                     alikeness(*untouched, *corner)};
}

} // namespace tidemark::lab
