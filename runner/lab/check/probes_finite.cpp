// Looks for NaN and infinity by drawing the scene in many situations and counting bits on the CPU.
#include "base/try.hpp"
#include "gl/capabilities.hpp"
#include "lab/check/exploration.hpp"
#include "lab/check/finite_look.hpp"
#include "lab/check/probes.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

namespace tidemark::lab {
namespace {

std::string middle_of(const scene::Knob& knob) {
    scene::KnobValue value{};
    for (size_t i = 0; i < value.size(); ++i) {
        value[i] = (knob.range->low[i] + knob.range->high[i]) / 2;
        if (scene::info(knob.type).whole)
            value[i] = std::floor(value[i]);
    }
    return scene::to_string(knob, value);
}

} // namespace

Result<Answer> ask_times(ProbeBench& bench) {
    return look(bench, usual_moments());
}

Result<Answer> ask_frames(ProbeBench& bench) {
    constexpr int k_frames = 600; // ten seconds at 60 frames per second
    constexpr std::chrono::seconds k_patience(5);
    const auto feedback = TRY(bench.has_feedback());
    if (!feedback)
        return Answer{Verdict::not_applicable, "no frame depends on the one before it"};
    std::optional<Answer> fault;
    int seen = 0;
    const auto start = std::chrono::steady_clock::now();
    const auto done = bench.step([&](const FrameState& at, const std::vector<PassPicture>& passes) {
        fault = not_finite(bench, at, passes);
        return !fault && ++seen < k_frames && std::chrono::steady_clock::now() - start < k_patience;
    });
    if (!done)
        return fail(done.error());
    if (fault)
        fault->sentence = fmt::format("from frame {} on: {}", seen, fault->sentence);
    return fault ? *std::move(fault)
                 : Answer{Verdict::pass, fmt::format("no NaN or infinity in the first {} frames{}", seen,
                                                     seen < k_frames ? ": no more were drawn in 5 s" : "")};
}

Result<Answer> ask_mouse(ProbeBench& bench) {
    const Extent size = k_probe_extent;
    const int w = size.width, h = size.height;
    std::vector<FrameState> states;
    for (const glm::ivec2 pixel :
         {glm::ivec2(1, 1), glm::ivec2(w - 1, 1), glm::ivec2(1, h - 1), glm::ivec2(w - 1, h - 1),
          glm::ivec2(w / 2, 0), glm::ivec2(0, h / 2), glm::ivec2(w / 2, h - 1), glm::ivec2(w - 1, h / 2),
          glm::ivec2(w / 2, h / 2), glm::ivec2(-w, -h), glm::ivec2(2 * w, 2 * h)})
        for (const bool down : {false, true})
            states.push_back(with_mouse(render::Mouse::clicked(pixel, down)));
    const glm::ivec2 low(1, 1), high(w - 1, h - 1), outside(2 * w, -h);
    for (const auto& [from, to] :
         {std::pair(low, high), std::pair(high, low), std::pair(low, outside), std::pair(low, low)})
        for (const bool down : {false, true})
            states.push_back(with_mouse(render::Mouse::dragged(from, to, down)));
    return look_anew(bench, states);
}

Result<Answer> ask_sizes(ProbeBench& bench) {
    std::vector<FrameState> states;
    for (const Extent size : {Extent{1, 1}, Extent{1, 64}, Extent{64, 1}, Extent{63, 37},
                              Extent{gl::query_capabilities().largest_target, 1}})
        states.push_back(plain_state(size));
    return look_anew(bench, states);
}

Result<Answer> ask_knobs(ProbeBench& bench) {
    std::vector<FrameState> states;
    for (const scene::Knob& knob : bench.scene().knobs)
        if (knob.range)
            for (const std::string& value : {scene::to_string(knob, knob.range->low), middle_of(knob),
                                             scene::to_string(knob, knob.range->high)}) {
                states.push_back(plain_state());
                states.back().knobs = {{knob.name, value}};
            }
    if (states.empty())
        return Answer{Verdict::not_applicable, "the scene has no knob with a range"};
    return look_anew(bench, states);
}

Result<Answer> ask_search(ProbeBench& bench) {
    auto plain = look_anew(bench, {});
    if (!plain || plain->verdict == Verdict::not_applicable)
        return plain;
    const auto explored = TRY(explore(bench));
    const std::string unread =
        (explored)->left_out.empty()
            ? ""
            : "; at random alone, as the text cannot be followed: " + (explored)->left_out;
    if ((explored)->not_finite.empty())
        return Answer{Verdict::pass, "no NaN or infinity; " + (explored)->sentence + unread};
    const FrameState& where = (explored)->not_finite.front();
    const auto passes = TRY(bench.passes(where));
    auto fault = not_finite(bench, where, passes);
    if (!fault)
        return Answer{Verdict::warn, "a pixel was NaN or infinite, and finite when it was drawn again",
                      where};
    fault->sentence += "; " + (explored)->sentence + unread;
    return *std::move(fault);
}

} // namespace tidemark::lab
