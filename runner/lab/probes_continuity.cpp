// Checks a scene as its clock runs: rounding, jumps, and random numbers that depend on rounding.

#include "base/error.hpp"
#include "base/measurement.hpp"
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

/// Returns the seconds between two pictures that distinguish a jump from motion: a hundredth of a frame at 60
/// fps, or eight steps of iTime in binary32 if that is more.
double instant(double time) {
    return std::max(1.0 / 6000, 8 * (double(std::nextafter(float(time), 1e9f)) - double(float(time))));
}

/// Pictures closer than this look the same.
constexpr double k_close_psnr = 45; // dB
/// Pictures closer than this do not count as a jump, whatever the steps around are.
constexpr double k_least_jump = 40; // dB
/// A jump is this much larger, as a quotient of root mean squares, than most other steps.
constexpr double k_jump_ratio = 3;
/// The same for a moment at which the scene starts again, where the following second is evidence, too.
constexpr double k_restart_ratio = 1.5;
/// The same for a step that is also much larger than those before and after it.
constexpr double k_beside_ratio = 1.5;
/// The share of the steps that move the picture at all and are smaller than the one a jump is compared with.
constexpr double k_most_steps = 0.9;

/// Returns the step that most steps that move the picture do not exceed, as a PSNR in dB; infinite if none
/// moves.
double usual_psnr(std::vector<double> psnrs) {
    std::erase_if(psnrs, [](double psnr) { return std::isinf(psnr); });
    return psnrs.empty() ? INFINITY : quantile(psnrs, 1 - k_most_steps);
}

/// Returns whether a step of the first PSNR is a jump where most steps have the second.
bool is_jump(double psnr, double usual, double ratio = k_jump_ratio) {
    return psnr < k_least_jump && usual - psnr > 20 * std::log10(ratio);
}

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

double psnr_of(const image::Image& left, const image::Image& right) {
    return image::compare(left, right)->psnr;
}

/// PSNRs of pictures around a moment, dB.
struct Jump {
    double moment = 0;
    image::Image after;   ///< the picture just after the moment
    double psnr = 0;      ///< of the pictures half an instant before and after the moment
    double elsewhere = 0; ///< of each with its other neighbour, the lower one; infinite: nothing moves there

    double drop() const { return std::min(elsewhere, 2 * k_close_psnr) - psnr; }
};
Result<Jump> jump_at(ProbeBench& bench, double moment) {
    std::vector<image::Image> frames;
    const double step = instant(moment);
    for (const double offset : {-1.5, -0.5, 0.5, 1.5}) {
        auto frame = TRY(bench.picture(state_at(moment + offset * step)));
        frames.push_back(std::move(frame));
    }
    return Jump{moment, frames[2], psnr_of(frames[1], frames[2]),
                std::min(psnr_of(frames[0], frames[1]), psnr_of(frames[2], frames[3]))};
}

/// Returns the PSNR that most steps from frame to frame have in the two seconds around a moment. A scene that
/// flickers or cuts all the time has no jump.
Result<double> usual_frame_step(ProbeBench& bench, double moment) {
    constexpr int k_frames = 120;
    constexpr double k_frame = 1.0 / 60;
    std::vector<double> psnrs;
    std::optional<image::Image> last;
    for (int i = 0; i <= k_frames; ++i) {
        auto frame = TRY(bench.picture(state_at(std::max(0.0, moment + (i - k_frames / 2 + 0.5) * k_frame))));
        if (last)
            psnrs.push_back(psnr_of(*last, frame));
        last = std::move(frame);
    }
    return usual_psnr(std::move(psnrs));
}

/// Returns whether the scene starts again at the moment: its next second looks like its first, in which it
/// moves.
Result<bool> starts_again(ProbeBench& bench, double moment) {
    const double first = 0.5 * instant(moment);
    std::vector<image::Image> start;
    bool moves = false;
    for (const double after : {first, 0.31, 0.97}) {
        start.push_back(TRY(bench.picture(state_at(after))));
        const auto again = TRY(bench.picture(state_at(moment + after)));
        if (psnr_of(start.back(), again) <= k_close_psnr)
            return false;
        moves = moves || psnr_of(start.front(), start.back()) <= k_close_psnr;
    }
    return moves;
}

/// The mismatch to show, and whether a viewer would see it.
struct ShownMismatch {
    Mismatch mismatch;
    bool seen = false;
};

/// Returns the first mismatch from `first` on that a viewer would see, up to the promised time; if there is
/// none, `first`. If the pictures differ without a large iTime, a viewer does not see other random details.
Result<ShownMismatch> mismatch_to_show(ProbeBench& bench, const Mismatch& first, bool from_the_start) {
    Mismatch next = first;
    for (;;) {
        if (breaks_up(next.floats, next.doubles, from_the_start))
            return ShownMismatch{std::move(next), true};
        if (10 * next.seconds > bench.promises().time_horizon)
            return ShownMismatch{first};
        next.seconds *= 10;
        next.state = state_at_float(next.seconds);
        next.floats = TRY(bench.picture(next.state));
        next.doubles = TRY(bench.picture(next.state, glsl::Precision::promoted));
        next.difference = p99_difference(next.floats, next.doubles);
    }
}

/// Adds the place of the hash whose function the line is in, so that both are one finding.
void add_hash_around(ProbeBench& bench, const SourceLocation& line, Answer& answer) {
    const auto hashes = bench.hashes();
    const auto texts = read_texts(bench, true);
    if (!hashes || !texts)
        return;
    const auto holds = [](const SourceLocation& first, const SourceLocation& last, const SourceLocation& at) {
        return first.file == at.file && first.line <= at.line && at.line <= last.line;
    };
    for (const PassText& pass : *texts)
        for (const glsl::Node& node : pass.text->tree().nodes) {
            if (node.kind != glsl::NodeKind::function)
                continue;
            const SourceLocation first = pass.text->spelled(node.begin),
                                 last = pass.text->spelled(node.end - 1);
            if (!holds(first, last, line))
                continue;
            for (const glsl::KeptHash& hash : *hashes)
                if (holds(first, last, hash.where))
                    add_place(answer, hash.where);
        }
}

} // namespace

Result<Answer> ask_horizon(ProbeBench& bench) {
    TRY(bench.picture(state_at(1))); // report errors of the scene itself first, not as a lack of doubles
    const auto horizon = find_horizon(bench);
    if (!horizon)
        return Answer{Verdict::not_applicable, "cannot be drawn in double: " + to_string(horizon.error())};
    std::string steps;
    if (horizon->time_step)
        steps = fmt::format("; at {:g} s iTime itself moves in steps of {:.2g} s, which change 1 % of the "
                            "pixels by {:.3g} or more",
                            horizon->time_step->seconds, horizon->time_step->step,
                            horizon->time_step->difference);
    if (!horizon->mismatch)
        return Answer{Verdict::pass, "float and double agree up to 1e6 s" + steps};
    const double good = horizon->good;
    const bool kept = good >= bench.promises().time_horizon;
    const Mismatch& first = *horizon->mismatch;
    const std::string found =
        good == 0
            ? fmt::format("float and double differ already at 1 s, by {:.3g} or more in 1 % of the "
                          "pixels: not because of a large iTime",
                          first.difference)
            : fmt::format("at the same iTime, float and double agree up to {:g} s; at {:g} s 1 % of the "
                          "pixels are off by {:.3g} or more",
                          good, first.seconds, first.difference);
    if (kept)
        return Answer{Verdict::pass, found + steps, first.state, first.floats};
    const auto [shown, noticeable] = TRY(mismatch_to_show(bench, first, good == 0));
    const auto lost = where_digits_are_lost(bench, shown);
    Answer answer{bench.promises().stated.contains("time_horizon") ? Verdict::fail
                  : noticeable                                     ? Verdict::warn
                                                                   : Verdict::note,
                  found + (lost ? "; " + lost->sentence : "") + steps, shown.state, shown.floats};
    const char* const effect = noticeable ? "the picture breaks up" : "the picture changes a little";
    answer.effect = shown.seconds <= 1
                        ? std::string("the picture depends on the rounding of floats, from the start")
                        : fmt::format("{} within {}: floats have too few digits for iTime", effect,
                                      duration_in_words(shown.seconds));
    if (lost) {
        add_place(answer, lost->where);
        add_hash_around(bench, lost->where, answer);
    }
    return answer;
}

namespace {

/// Suspected jumps that are compared with the steps around them; each takes 121 pictures.
constexpr size_t k_most_suspects = 3;

/// A jump fails if the file promises smoothness and is a warning if the clock restarts; otherwise it is a
/// note, since a cut may be intended.
Answer answer_of(const Jump& jump, bool again, bool promised) {
    const std::string elsewhere =
        std::isinf(jump.elsewhere) ? "no change" : fmt::format("{:.1f} dB", jump.elsewhere);
    const char* const consequence = again      ? " back to the picture of 0 s"
                                    : promised ? ""
                                               : "; if the cut is intended, add \"skip\" to its .check.json";
    return {promised ? Verdict::fail
            : again  ? Verdict::warn
                     : Verdict::note,
            fmt::format("the picture jumps at {:g} s (PSNR {:.1f} dB between neighbouring instants, {} "
                        "elsewhere){}",
                        jump.moment, jump.psnr, elsewhere, consequence),
            state_at(jump.moment + instant(jump.moment) / 2),
            jump.after,
            false,
            fmt::format("the picture jumps at {:g} s{}", jump.moment,
                        again ? ": the clock starts again from 0 there" : "")};
}

/// Returns the jumps at numbers of the text, the largest first.
Result<std::vector<Jump>> suspects_of(ProbeBench& bench, const std::vector<double>& periods) {
    std::vector<Jump> suspects;
    for (const double period : periods) {
        Jump jump = TRY(jump_at(bench, period));
        if (jump.drop() > bench.promises().smoothest_jump && jump.psnr < k_least_jump)
            suspects.push_back(std::move(jump));
    }
    std::ranges::sort(suspects, std::greater(), &Jump::drop);
    suspects.resize(std::min(suspects.size(), k_most_suspects));
    return suspects;
}

} // namespace

Result<Answer> ask_time_discontinuity(ProbeBench& bench) {
    const std::vector<double> periods = possible_periods(bench.scene());
    const bool promised = bench.promises().stated.contains("smoothest_jump");
    Answer answer;
    for (const Jump& jump : TRY(suspects_of(bench, periods))) {
        const double usual = TRY(usual_frame_step(bench, jump.moment));
        if (!is_jump(jump.psnr, usual, k_restart_ratio))
            continue;
        const bool again = TRY(starts_again(bench, jump.moment));
        if (!again && !is_jump(jump.psnr, usual))
            continue;
        Answer found = answer_of(jump, again, promised);
        for (const SourceLocation& where : places_of_number(bench.scene(), jump.moment))
            add_place(found, where);
        if (found.verdict > answer.verdict)
            answer = std::move(found);
    }
    if (answer.verdict == Verdict::pass)
        answer.sentence = fmt::format("no jump at any of {} candidate periods", periods.size());
    return answer;
}

namespace {

/// Returns whether a pass has a function of that name that main does not reach, and none has one that it
/// does.
bool is_never_called(const std::vector<PassText>& texts, const std::string& function) {
    bool unreached = false;
    for (const PassText& pass : texts) {
        if (!pass.facts.function(function))
            continue;
        if (glsl::functions_of_main(*pass.text, pass.facts).contains(function))
            return false;
        unreached = true;
    }
    return unreached;
}

} // namespace

Result<Answer> ask_hashes(ProbeBench& bench) {
    const auto hashes = bench.hashes();
    if (!hashes)
        return Answer{Verdict::not_applicable,
                      "the scene cannot be promoted to double: " + to_string(hashes.error())};
    const auto texts = read_texts(bench, true);
    std::vector<std::string> sines, products; // Common is part of every pass, so list each once
    Answer answer{Verdict::note};
    for (const glsl::KeptHash& hash : *hashes) {
        if (texts && is_never_called(*texts, hash.function))
            continue;
        const std::string said = fmt::format("{}:{}{}", hash.where.file, hash.where.line,
                                             hash.function.empty() ? "" : " " + hash.function);
        const bool product = hash.kind == glsl::HashKind::product && !hash.function.empty();
        auto& list = product ? products : sines;
        if ((!product && hash.kind != glsl::HashKind::sine) || std::ranges::find(list, said) != list.end())
            continue;
        if (product && !depends_on_contraction(bench, {hash.function}).value_or(false))
            continue;
        list.push_back(said);
        add_place(answer, hash.where);
    }
    if (!sines.empty())
        answer.sentence = "fract of a large sine gives different numbers on each GPU: " + listed(sines);
    if (!products.empty())
        answer.sentence +=
            fmt::format("{}fract of a large product gives different numbers on a GPU with fused "
                        "multiply-add: {}",
                        sines.empty() ? "" : "; ", listed(products));
    if (answer.sentence.empty())
        return Answer{Verdict::pass,
                      "no random numbers from large sines, nor from products that rounding changes"};
    if (sines.empty()) {
        answer.effect = "random numbers differ from one GPU to the next";
        answer.cause = "fract() of a large product is rounded differently with fused multiply-add";
    }
    return answer;
}

// Checks whether a picture repeats exactly, with one thread too, and whether it changes evenly with the
// mouse.

namespace {

/// Narrow and high: small mouse steps in few pixels.
constexpr Extent k_strip{16, 180};
/// A mouse step jumps if its PSNR is this much below that of the steps before and after it.
constexpr double k_turn = 6; // dB
/// A sweep in which fewer steps move the picture has no usual step to compare a jump with.
constexpr std::ptrdiff_t k_least_steps = 10;
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

/// The largest jump of a sweep, and its first picture that is not finite.
struct Swept {
    bool changes = false;
    bool jumps = false;
    double usual = 0; ///< PSNR that most steps have, dB
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
    found.usual = usual_psnr(steps);
    const auto moving = std::ranges::count_if(steps, [](double psnr) { return !std::isinf(psnr); });
    double most = 0;
    for (size_t i = 1; i + 1 < steps.size() && moving >= k_least_steps; ++i) {
        const double drop = std::min(steps[i - 1], steps[i + 1]) - steps[i];
        if (drop <= std::max(most, k_turn) || !is_jump(steps[i], found.usual, k_beside_ratio))
            continue;
        most = drop;
        found.jumps = true;
        found.psnr = steps[i];
        found.step = int(i) + 1;
    }
    return found;
}

/// Returns whether one of four quarter steps of the mouse, in a picture four times as wide, is as large as
/// all of them together. A picture that only turns quickly there, or of which hard edges cross a few pixels,
/// changes by less in each of them; and in a narrow strip one cell of a coarse pattern is a large part.
Result<bool> jumps_in_quarters(ProbeBench& bench, const Sweep& sweep, int step) {
    constexpr int k_finer = 4;
    constexpr double k_least_of_all = 2; // dB
    const glm::ivec2 wider = sweep.extent.width < sweep.extent.height ? glm::ivec2(4, 1) : glm::ivec2(1, 4);
    const Extent extent{sweep.extent.width * wider.x, sweep.extent.height * wider.y};
    const glm::vec2 first = sweep.pixel(step) * wider,
                    along = glm::vec2(sweep.pixel(step + 1) - sweep.pixel(step)) / float(k_finer);
    std::vector<image::Image> pictures;
    for (int finer = -1; finer <= k_finer + 1; ++finer) {
        render::Mouse mouse = render::Mouse::clicked(first, false);
        mouse.position = mouse.pressed_at = first + float(finer) * along;
        pictures.push_back(TRY(bench.picture(with_mouse(mouse, plain_state(extent)))));
    }
    std::vector<double> steps;
    for (size_t i = 1; i < pictures.size(); ++i)
        steps.push_back(psnr_of(pictures[i - 1], pictures[i]));
    const auto largest = size_t(std::min_element(steps.begin() + 1, steps.end() - 1) - steps.begin());
    const double beside = std::min(steps[largest - 1], steps[largest + 1]);
    const double all = psnr_of(pictures[1], pictures[k_finer + 1]);
    return steps[largest] < k_least_jump && steps[largest] - all < k_least_of_all &&
           beside - steps[largest] > k_turn;
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
    if (found.jumps && TRY(jumps_in_quarters(bench, sweep, found.step)))
        return show(Verdict::warn, found.step + 1,
                    fmt::format("the picture jumps where the mouse goes from {} = {} to {} of {}: PSNR "
                                "{:.1f} dB, while 90 % of such steps have {:.1f} dB or more",
                                sweep.axis, found.step, found.step + 1, sweep.length, found.psnr,
                                found.usual));
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
    for (const Sweep& sweep : sweeps) {
        const auto found = TRY(swept(bench, sweep));
        auto answer = TRY(fault(bench, sweep, found));
        if (answer)
            return *std::move(answer);
        changes |= found.changes;
    }
    if (!changes)
        return Answer{Verdict::not_applicable, "the mouse changes nothing"};
    return Answer{Verdict::pass,
                  "no one-pixel step of the mouse changes the picture by much more than most do"};
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
        if (next - edge > k_turn) {
            Answer answer{
                Verdict::warn,
                fmt::format("a click in {0} 0 shows another view than in {0} 1: PSNR {1:.1f} dB, from {0} 1 "
                            "to 2 {2:.1f} dB",
                            name, edge, next),
                clicked(first), pictures[0]};
            if (!image::compare(TRY(bench.picture(plain_state())), pictures[0])->equal())
                answer.effect = "the picture jumps when the mouse comes to the first column or row";
            return answer;
        }
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
