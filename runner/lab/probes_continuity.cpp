// Checks a scene as its clock runs: rounding, jumps, and random numbers that depend on rounding.

#include "base/error.hpp"
#include "lab/probed_pictures.hpp"
#include "lab/probes.hpp"
#include "lab/scene_numbers.hpp"
#include "lab/text_findings.hpp"
#include "media/comparison.hpp"
#include "media/image.hpp"
#include "render/exposure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
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

/// Returns the first mismatch from `first` on that is more than barely visible, up to the promised time; if
/// there is none, `first`.
Result<Mismatch> noticeable_mismatch(ProbeBench& bench, const Mismatch& first) {
    Mismatch shown = first;
    while (shown.difference <= k_noticeable_gap && 10 * shown.seconds <= bench.promises().time_horizon) {
        shown.seconds *= 10;
        shown.state = state_at(shown.seconds + 1.0 / 3);
        shown.floats = TRY(bench.picture(shown.state));
        const auto truth = TRY(bench.picture(shown.state, glsl::Precision::promoted));
        shown.difference = p99_difference(shown.floats, truth);
    }
    return shown.difference > k_noticeable_gap ? shown : first;
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
    const Mismatch shown = TRY(noticeable_mismatch(bench, *horizon->mismatch));
    const std::string found =
        good == 0
            ? fmt::format("float and double differ already at 1 s, by {:.3g} or more in 1 % of the pixels: "
                          "not because of a large iTime",
                          horizon->mismatch->difference)
            : fmt::format("float and double agree up to {:g} s; at {:g} s, where iTime moves in steps of "
                          "{:.2g} s, 1 % of the pixels are off by {:.3g} or more",
                          good, time, double(std::nextafter(float(time), 1e9f)) - double(float(time)),
                          horizon->mismatch->difference);
    const bool noticeable = shown.difference > k_noticeable_gap;
    Answer answer{kept                                               ? Verdict::pass
                  : bench.promises().stated.contains("time_horizon") ? Verdict::fail
                  : noticeable                                       ? Verdict::warn
                                                                     : Verdict::note,
                  found, shown.state, shown.floats};
    const char* const effect = noticeable ? "the picture breaks up" : "the picture changes a little";
    answer.effect = good == 0 ? fmt::format("{} through the rounding of floats, from the start", effect)
                              : fmt::format("{} within {}: floats have too few digits for iTime", effect,
                                            duration_in_words(shown.seconds));
    return answer;
}

namespace {

/// A jump fails if the file promises smoothness and is a warning if the clock restarts; otherwise it is a
/// note, since a cut may be intended.
Answer answer_of(const Jump& jump, double moment, bool promised) {
    const std::string elsewhere =
        std::isinf(jump.elsewhere) ? "no change" : fmt::format("{:.1f} dB", jump.elsewhere);
    const char* const consequence = jump.wraps ? " back to the picture of 0 s"
                                    : promised ? ""
                                               : "; if the cut is intended, add \"skip\" to its .check.json";
    return {promised     ? Verdict::fail
            : jump.wraps ? Verdict::warn
                         : Verdict::note,
            fmt::format("the picture jumps at {:g} s (PSNR {:.1f} dB between neighbouring instants, {} "
                        "elsewhere){}",
                        moment, jump.psnr, elsewhere, consequence),
            state_at(moment + instant(moment) / 2),
            jump.after,
            false,
            fmt::format("the picture jumps at {:g} s{}", moment,
                        jump.wraps ? ": the clock starts again from 0 there" : "")};
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
    Answer answer{Verdict::note};
    for (const glsl::KeptHash& hash : *hashes) {
        const std::string said = fmt::format("{}:{}{}", hash.where.file, hash.where.line,
                                             hash.function.empty() ? "" : " " + hash.function);
        if (hash.kind != glsl::HashKind::sine || std::ranges::find(found, said) != found.end())
            continue;
        found.push_back(said);
        add_place(answer, hash.where);
    }
    if (found.empty())
        return Answer{Verdict::pass, "no random numbers from large sines"};
    answer.sentence = "fract of a large sine gives different numbers on each GPU: " + listed(found);
    return answer;
}

// Checks whether a picture repeats exactly, with one thread too, and whether it changes evenly with the
// mouse.

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
        return say_no("after recompiling");
    return Answer{Verdict::pass, "the same bytes again, after another frame and after recompiling"};
}

Result<Answer> ask_threads(ProbeBench& bench) {
    if (!bench.with_one_thread())
        return Answer{Verdict::not_applicable, "this driver has no setting for its number of threads"};
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
    return Answer{Verdict::pass, "the same bytes with one thread and with many"};
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
    const auto show = [&](Verdict verdict, int pixel, std::string sentence) -> Result<std::optional<Answer>> {
        const FrameState where = sweep.at(pixel);
        auto picture = TRY(bench.picture(where));
        return Answer{verdict, std::move(sentence), where, std::move(picture)};
    };
    if (found.not_finite) {
        const auto untouched = TRY(bench.picture(plain_state(sweep.extent)));
        if (image::census(untouched).non_finite() > 0)
            return Answer{Verdict::not_applicable, "NaN or infinity without the mouse, too: see times"};
        auto shown = TRY(show(Verdict::fail, *found.not_finite,
                              fmt::format("NaN or infinity in the picture with the mouse at {} = {} of {}",
                                          sweep.axis, *found.not_finite, sweep.length)));
        shown->effect = fmt::format("some pixels are NaN or infinite with the mouse at {} = {} of {}",
                                    sweep.axis, *found.not_finite, sweep.length);
        return shown;
    }
    if (found.most > k_turn)
        return show(
            Verdict::warn, found.step + 1,
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
    return Answer{Verdict::pass,
                  fmt::format("the picture moves evenly with the mouse: the PSNR of a one-pixel step is at "
                              "most {:.1f} dB less than for the steps beside it",
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
                Verdict::warn,
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
    return Answer{Verdict::pass,
                  "a click at the edge counts as a click; one in the corner changes the picture: " +
                      alikeness(*untouched, *corner)};
}

// Checks whether a picture drawn in tiles, as large ones are (render/picture_parts.hpp), equals one drawn
// whole.

namespace {

/// Not divisible by the tile's size, so that tiles extend past both sides.
constexpr Extent k_odd{61, 37};
constexpr Extent k_tile{16, 8};
constexpr double k_same_to_the_eye = 50; ///< PSNR in dB above which differences are invisible

} // namespace

Result<Answer> ask_tiles(ProbeBench& bench) {
    const FrameState state = state_at(0, k_odd); // frame 0, so that no earlier frame is needed
    const render::FrameInputs inputs = inputs_of(state);
    const auto drawn = [&](std::optional<Extent> tile) {
        auto renderer = render::Renderer::create(
            bench.scene(), {.extent = k_odd, .samples = image::SampleType::f32, .tile = tile});
        if (renderer)
            renderer->draw(inputs);
        return renderer;
    };
    auto cut = TRY(drawn(k_tile));
    if (!cut.tiles())
        return Answer{Verdict::not_applicable, "a pass reads the picture, so it is never drawn in tiles"};
    const image::Image tiled = render::draw_in_tiles(cut, inputs);
    const auto whole = TRY(drawn(std::nullopt));
    const image::Image uncut = whole.read_back();
    const size_t different = different_pixels(tiled, uncut);
    // Mesa 25 reads texture levels slightly differently in each tile.
    if (const auto gap = image::compare(uncut, tiled); different > 0 && gap && gap->psnr >= k_same_to_the_eye)
        return Answer{Verdict::pass,
                      fmt::format("{} of {} pixels differ in {} tiles, too little to be visible: {:.0f} dB",
                                  different, tiled.extent.pixels(), cut.tiles()->count(), gap->psnr)};
    if (different > 0)
        return Answer{Verdict::fail,
                      fmt::format("{} of {} pixels differ when drawn in {}x{} tiles{}", different,
                                  tiled.extent.pixels(), k_tile.width, k_tile.height, bench.see_bounds()),
                      state, image::without_alpha(tiled)};
    return Answer{Verdict::pass, fmt::format("the same bytes in {} tiles", cut.tiles()->count())};
}

} // namespace tidemark::lab
