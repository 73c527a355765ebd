#include "lab/fix/finding.hpp"

#include "base/try.hpp"
#include "glsl/analysis/unassigned.hpp"
#include "glsl/cure/domain_guards.hpp"
#include "glsl/cure/initial_values.hpp"
#include "glsl/cure/march_cures.hpp"
#include "glsl/cure/whole_hashes.hpp"
#include "lab/check/marching_pass.hpp"
#include "lab/check/probes.hpp"
#include "lab/check/rays.hpp"
#include "lab/check/text_words.hpp"
#include "lab/march/recorded_hits.hpp"
#include "lab/trace/nan_origin.hpp"
#include "lab/trace/nan_trace.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::lab {
namespace {

/// The probes that look for what is not finite.
constexpr Result<Answer> (*k_finite_probes[])(ProbeBench&) = {ask_times,  ask_frames, ask_mouse, ask_sizes,
                                                              ask_inputs, ask_knobs,  ask_search};

class Finder {
public:
    Finder(ProbeBench& bench, const std::vector<PassText>& texts) : bench_(bench), texts_(texts) {}

    Result<CurableFindings> run() {
        for (const auto ask : k_finite_probes) {
            const Answer answer = TRY(ask(bench_));
            if (answer.non_finite && answer.where)
                TRY(add_origins(*answer.where));
        }
        found_.views = TRY(usual_views(bench_));
        if (const auto calls = find_undefined(bench_, texts_, found_.views))
            for (const UndefinedCall& each : *calls)
                if (each.percent > 0)
                    add_call(each);
        return std::move(found_);
    }

private:
    const PassText* text_of(size_t pass) const {
        const auto found = std::ranges::find(texts_, pass, &PassText::pass);
        return found == texts_.end() ? nullptr : &*found;
    }

    void add(Finding finding) {
        const auto same = std::ranges::find(found_.all, finding.sentence, &Finding::sentence);
        if (same == found_.all.end())
            found_.all.push_back(std::move(finding));
    }

    void add_call(const UndefinedCall& call) {
        const PassText* const pass = text_of(call.pass);
        add({Finding::Kind::undefined, call.sentence, call.where,
             glsl::domain_guards(*pass->text, pass->facts, call.node)});
    }

    /// Of a picture that is not finite: the first operation that was not, and the one whose cure is said to
    /// cure the pixel.
    Result<void> add_origins(const FrameState& where) {
        const scene::Scene scene = TRY(in_state(bench_.scene(), where));
        auto renderer =
            TRY(render::Renderer::create(scene, {where.extent, image::SampleType::f32, where.pass}));
        TraceRequest request;
        request.states = [&](int frame) { return where.at_frame(frame); };
        request.frame = where.frame;
        request.start = first_frame_of(where);
        const auto trace = trace_nan(renderer, request);
        if (!trace || !*trace)
            return {};
        for (const auto* origin : {&(*trace)->fix, &(*trace)->first})
            if (*origin)
                add_origin(**origin, (*trace)->pass, where);
        return {};
    }

    void add_origin(const NanOrigin& origin, const std::string& pass_name, const FrameState& where) {
        Finding finding{Finding::Kind::not_finite,
                        fmt::format("{}:{}: `{}`{}{}", origin.where.file, origin.where.line, origin.operation,
                                    origin.why.reason.empty() ? "" : ": ", origin.why.reason),
                        where,
                        {}};
        for (const PassText& pass : texts_)
            if (bench_.scene().passes[pass.pass].name == pass_name)
                finding.cures = guards_of(pass, origin);
        add(std::move(finding));
    }

    /// Of the operation that a trace names by its place and its words.
    static std::vector<glsl::Cure> guards_of(const PassText& pass, const NanOrigin& origin) {
        const WatchedText watched{*pass.text, pass.facts};
        const auto& nodes = pass.text->tree().nodes;
        for (glsl::NodeId id = 1; id < nodes.size(); ++id) {
            if (!glsl::is_expression(nodes[id].kind))
                continue;
            const NanOrigin here = describe(watched, id);
            if (here.where == origin.where && here.operation == origin.operation)
                if (auto guards = glsl::domain_guards(*pass.text, pass.facts, id); !guards.empty())
                    return guards;
        }
        return {};
    }

    ProbeBench& bench_;
    const std::vector<PassText>& texts_;
    CurableFindings found_{};
};

void add_without_value(CurableFindings& found, const std::vector<PassText>& texts) {
    for (const PassText& pass : texts)
        for (const glsl::Unassigned& each : glsl::find_unassigned(*pass.text, pass.facts)) {
            Finding finding{Finding::Kind::no_value, sentence_for(*pass.text, each), {}, {}};
            if (finding.sentence.empty())
                continue;
            finding.sentence += " is read without a value";
            if (auto cure = glsl::initial_value(*pass.text, each))
                finding.cures.push_back(*std::move(cure));
            if (std::ranges::find(found.all, finding.sentence, &Finding::sentence) == found.all.end())
                found.all.push_back(std::move(finding));
        }
}

/// What is wrong with the rays of a scene that marches: by proof where they end, and whether they run out of
/// steps.
class RayFinder {
public:
    RayFinder(ProbeBench& bench, const std::vector<PassText>& texts, CurableFindings& found)
        : bench_(bench), texts_(texts), found_(found) {}

    Result<void> run() {
        const auto pass = TRY(marching_pass(bench_));
        if (!pass)
            return {};
        TRY(add_wrong(*pass));
        return add_exhausted(*pass);
    }

private:
    Result<void> add_wrong(const MarchingPass& pass) {
        const RayCounts counts = TRY(count_proved(bench_, pass));
        if (counts.contradicted > 0 || !counts.wrong_loop || wrong_percent(counts) <= k_most_wrong_percent)
            return {};
        const auto lines = lines_of(*pass.function, pass.function->loops()[*counts.wrong_loop]);
        auto cures =
            counts.step_over > 0 ? cures_of(glsl::shorter_steps, pass, lines) : std::vector<glsl::Cure>();
        for (glsl::Cure& cure : cures_of(glsl::more_turns, pass, lines))
            cures.push_back(std::move(cure));
        found_.all.push_back(
            {Finding::Kind::first_hit,
             fmt::format("{}:{}: of {} rays whose first hit is known {} step over it and {} miss it",
                         lines.test.file, lines.test.line, counts.decided(), counts.step_over, counts.miss),
             {},
             std::move(cures)});
        return {};
    }

    Result<void> add_exhausted(const MarchingPass& pass) {
        if (!bench_.has_hits())
            return {};
        const double percent = TRY(most_flagged(bench_, glsl::k_hit_exhausted)).percent;
        if (percent <= bench_.promises().most_exhausted_percent)
            return {};
        const auto lines = lines_of(*pass.function, pass.function->loops().front());
        found_.all.push_back(
            {Finding::Kind::budget,
             fmt::format("{}:{}: {:.3g} % of the rays run out of steps in the worst of four views",
                         lines.test.file, lines.test.line, percent),
             {},
             cures_of(glsl::more_turns, pass, lines)});
        return {};
    }

    template <class CuresOf>
    std::vector<glsl::Cure> cures_of(CuresOf cures, const MarchingPass& pass,
                                     const glsl::MarchLines& lines) const {
        const auto text = std::ranges::find(texts_, pass.index, &PassText::pass);
        return text == texts_.end() ? std::vector<glsl::Cure>()
                                    : cures(*text->text, {lines.test, lines.updates});
    }

    ProbeBench& bench_;
    const std::vector<PassText>& texts_;
    CurableFindings& found_;
};

/// By file; Common stands in several passes.
void add_hashes(CurableFindings& found, const std::vector<PassText>& texts) {
    for (const PassText& pass : texts)
        for (glsl::Cure& cure : glsl::whole_hashes(*pass.text, pass.facts)) {
            std::vector<std::string> places;
            for (size_t i = 1; i < cure.wraps.size(); ++i) // the first is the function that hashes
                places.push_back(
                    fmt::format("{}:{}", cure.wraps[i].first.where.file, cure.wraps[i].first.where.line));
            Finding finding{Finding::Kind::hash,
                            "fract of a large sine gives other numbers on every GPU: " + listed(places),
                            {},
                            {std::move(cure)}};
            if (std::ranges::find(found.all, finding.sentence, &Finding::sentence) == found.all.end())
                found.all.push_back(std::move(finding));
        }
}

} // namespace

Result<CurableFindings> find_curable(ProbeBench& bench, bool hashes) {
    const auto written = read_texts(bench, true), linked = read_texts(bench, false);
    if (!written || !linked)
        return CurableFindings{
            {}, {}, "the text cannot be followed: " + to_string((written ? linked : written).error())};
    CurableFindings found = TRY(Finder(bench, *linked).run());
    add_without_value(found, *written);
    TRY(RayFinder(bench, *written, found).run());
    if (hashes)
        add_hashes(found, *written);
    return found;
}

} // namespace tidemark::lab
