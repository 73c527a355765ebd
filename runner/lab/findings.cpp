#include "base/error.hpp"
#include "lab/fix.hpp"
#include "lab/march_hits.hpp"
#include "lab/nan_trace.hpp"
#include "lab/probed_pictures.hpp"
#include "lab/probed_rays.hpp"
#include "lab/probes.hpp"
#include "lab/text_findings.hpp"
#include "shader/fixes.hpp"
#include "shader/undefined_behaviour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace tidemark::lab {
namespace {

/// The probes for NaN and infinity.
constexpr Result<Answer> (*k_finite_probes[])(ProbeBench&) = {ask_times,  ask_frames, ask_mouse, ask_sizes,
                                                              ask_inputs, ask_knobs,  ask_search};

/// Adds a finding unless one has the same sentence: several probes may find one place, and Common is part of
/// several passes.
void add_once(CurableFindings& found, Finding finding) {
    if (std::ranges::find(found.all, finding.sentence, &Finding::sentence) == found.all.end())
        found.all.push_back(std::move(finding));
}

glsl::Cure all_of(const std::vector<glsl::Cure>& cures) {
    glsl::Cure all;
    for (const glsl::Cure& cure : cures) {
        all.wraps.insert(all.wraps.end(), cure.wraps.begin(), cure.wraps.end());
        if (all.reason.find(cure.reason) == all.reason.npos)
            all.reason += (all.reason.empty() ? "" : "; ") + cure.reason;
    }
    return all;
}

/// Returns a finding of a text, with at most one fix.
Finding found_in_text(Finding::Kind kind, std::string sentence, std::optional<glsl::Cure> cure) {
    Finding finding{kind, std::move(sentence), {}, {}};
    if (cure)
        finding.cures.push_back(*std::move(cure));
    return finding;
}

class FindingsCollector {
public:
    FindingsCollector(ProbeBench& bench, const std::vector<PassText>& texts) : bench_(bench), texts_(texts) {}

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
        for (const Outside& outside : TRY(explore(bench_))->outside)
            if (outside.bound)
                add_bound(outside);
        return std::move(found_);
    }

private:
    const PassText* text_of(size_t pass) const {
        const auto found = std::ranges::find(texts_, pass, &PassText::pass);
        return found == texts_.end() ? nullptr : &*found;
    }

    void add_call(const UndefinedCall& call) {
        const PassText* const pass = text_of(call.pass);
        Finding finding{Finding::Kind::undefined, call.sentence, call.where, {}};
        if (call.site.kind == glsl::DomainKind::whole)
            if (auto cure = glsl::between_whole_quotients(*pass->text, pass->facts, call.site.node))
                finding.cures.push_back(*std::move(cure));
        std::ranges::move(glsl::domain_guards(*pass->text, pass->facts, call.site.node),
                          std::back_inserter(finding.cures));
        add_once(found_, std::move(finding));
    }

    void add_bound(const Outside& outside) {
        const PassText* const pass = text_of(outside.pass);
        if (!pass)
            return;
        if (outside.site.kind == glsl::DomainKind::negative)
            add_once(found_,
                     found_in_text(Finding::Kind::remainder, outside.sentence,
                                   glsl::unsigned_dividend(*pass->text, pass->facts, outside.site.node)));
        else
            add_once(found_, {Finding::Kind::bounds, outside.sentence, {}, {}});
    }

    /// Traces a picture that is not finite. Adds the first operation that was not finite and the one whose
    /// fix, by the trace, makes the pixel finite.
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
        const size_t before = found_.all.size();
        for (const auto* origin : {&(*trace)->fix, &(*trace)->first})
            if (*origin)
                add_origin(**origin, (*trace)->pass, where);
        if (found_.all.size() == before + 2)
            cure_both(found_.all[before], found_.all[before + 1]);
        return {};
    }

    /// Adds a fix of both operations to the first finding, for a pixel that is not finite for two reasons.
    static void cure_both(Finding& one, const Finding& other) {
        if (!one.cures.empty() && !other.cures.empty())
            one.cures.push_back(all_of({one.cures.front(), other.cures.front()}));
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
        add_once(found_, std::move(finding));
    }

    /// Returns the guards for the operation that a trace names by its place and text.
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

void add_without_value(CurableFindings& found, const PassText& pass) {
    for (const glsl::Unassigned& each : glsl::find_unassigned(*pass.text, pass.facts))
        if (const std::string sentence = sentence_for(*pass.text, each); !sentence.empty())
            add_once(found, found_in_text(Finding::Kind::no_value, sentence + " is read without a value",
                                          glsl::initial_value(*pass.text, pass.facts, each)));
}

void add_miscounting(CurableFindings& found, const PassText& pass) {
    for (const glsl::FloatCounter& each : glsl::miscounting_loops(*pass.text, pass.facts))
        if (const std::string place = place_of(*pass.text, pass.text->tree()[each.loop].begin);
            !place.empty())
            add_once(found, found_in_text(Finding::Kind::counter, place + ": " + words_for(each),
                                          glsl::whole_counter(*pass.text, each)));
}

void add_divergent(CurableFindings& found, const PassText& pass, const scene::Pass& of) {
    for (const glsl::Divergent& each : glsl::find_divergent(*pass.text, pass.facts, which_have_mipmaps(of)))
        if (const std::string place = place_of(*pass.text, pass.text->tree()[each.call].begin);
            !place.empty() && !each.harmless) {
            Finding finding{Finding::Kind::divergence, place + ": " + words_for(*pass.text, each), {}, {}};
            for (const auto propose : {glsl::hoisted_derivative, glsl::base_level})
                if (auto cure = propose(*pass.text, pass.facts, each))
                    finding.cures.push_back(*std::move(cure));
            add_once(found, std::move(finding));
        }
}

void add_wrong_edges(CurableFindings& found, const PassText& pass) {
    for (const glsl::WrongEdges& each : glsl::find_wrong_edges(*pass.text, pass.facts))
        if (const std::string sentence = sentence_for(*pass.text, each); !sentence.empty())
            add_once(found, found_in_text(Finding::Kind::edges, sentence,
                                          glsl::ordered_edges(*pass.text, pass.facts, each)));
}

/// Finds faults of a marching scene's rays: wrong first hits, by proof, and rays that run out of steps.
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
        std::vector<glsl::Cure> cures;
        if (const PassText* const text = text_of(pass)) {
            if (counts.step_over + counts.went_past > 0)
                cures = glsl::shorter_steps(*text->text, place_of_march(lines),
                                            TRY(safe_step(bench_, pass)).value_or(1));
            std::ranges::move(glsl::more_turns(*text->text, place_of_march(lines)),
                              std::back_inserter(cures));
        }
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
        const double percent = TRY(most_running_out(bench_, usual_views())).percent;
        if (percent <=
            most_allowed(bench_, bench_.promises().most_exhausted_percent, "most_exhausted_percent"))
            return {};
        const auto lines = lines_of(*pass.function, pass.function->loops().front());
        std::vector<glsl::Cure> cures;
        if (const PassText* const text = text_of(pass)) {
            // If rays run out of steps in float only, the threshold is below the rounding error.
            const Verdict epsilon = TRY(ask_epsilon(bench_)).verdict;
            if (is_finding(epsilon))
                cures = glsl::larger_threshold(*text->text, text->facts, place_of_march(lines));
            std::ranges::move(glsl::more_turns(*text->text, place_of_march(lines)),
                              std::back_inserter(cures));
        }
        found_.all.push_back(
            {Finding::Kind::budget,
             fmt::format("{}:{}: {:.3g} % of the rays run out of steps in the worst of four views",
                         lines.test.file, lines.test.line, percent),
             {},
             std::move(cures)});
        return {};
    }

    static glsl::MarchPlace place_of_march(const glsl::MarchLines& lines) {
        return {lines.test, lines.updates};
    }

    const PassText* text_of(const MarchingPass& pass) const {
        const auto text = std::ranges::find(texts_, pass.index, &PassText::pass);
        return text == texts_.end() ? nullptr : &*text;
    }

    ProbeBench& bench_;
    const std::vector<PassText>& texts_;
    CurableFindings& found_;
};

/// Most expressions to try one by one; after these all are tried at once.
constexpr size_t k_most_alone_cures = 6;

/// Returns changes of all passes that are equal in real arithmetic; those in Common only once.
std::vector<glsl::Cure> equal_texts(const std::vector<PassText>& texts) {
    std::vector<glsl::Cure> cures;
    for (const PassText& pass : texts)
        for (const auto propose : {glsl::reduced_times, glsl::rewrites})
            for (glsl::Cure& cure : propose(*pass.text, pass.facts))
                if (std::ranges::find(cures, cure) == cures.end())
                    cures.push_back(std::move(cure));
    return cures;
}

/// Adds the first moment at which float and double differ visibly, if it is before the promised one. Only if
/// there are changes that may help.
void add_rounding(ProbeBench& bench, CurableFindings& found, const std::vector<PassText>& texts) {
    std::vector<glsl::Cure> cures = equal_texts(texts);
    if (cures.empty())
        return;
    const auto horizon = find_horizon(bench);
    if (!horizon || !horizon->mismatch || horizon->good >= bench.promises().time_horizon)
        return;
    if (cures.size() > 1) {
        glsl::Cure all = all_of(cures);
        cures.resize(std::min(cures.size(), k_most_alone_cures));
        cures.push_back(std::move(all));
    }
    found.all.push_back(
        {Finding::Kind::rounding,
         fmt::format("at {:.6g} s float and double differ by {:.3g} or more in 1 % of the pixels",
                     horizon->mismatch->state.seconds(), horizon->mismatch->difference),
         horizon->mismatch->state, std::move(cures)});
}

/// Adds the hashes of large sines, those in Common only once.
void add_hashes(CurableFindings& found, const std::vector<PassText>& texts) {
    for (const PassText& pass : texts)
        for (glsl::Cure& cure : glsl::whole_hashes(*pass.text, pass.facts)) {
            std::vector<std::string> places;
            for (size_t i = 1; i < cure.wraps.size(); ++i) // the first wrap inserts the hash function
                places.push_back(
                    fmt::format("{}:{}", cure.wraps[i].first.where.file, cure.wraps[i].first.where.line));
            add_once(found, found_in_text(Finding::Kind::hash,
                                          "fract of a large sine gives different numbers on each GPU: " +
                                              listed(places),
                                          std::move(cure)));
        }
}

} // namespace

Result<CurableFindings> find_curable(ProbeBench& bench, bool hashes) {
    const auto written = read_texts(bench, true), linked = read_texts(bench, false);
    if (!written || !linked)
        return CurableFindings{
            {}, {}, "the text cannot be analysed: " + to_string((written ? linked : written).error())};
    CurableFindings found = TRY(FindingsCollector(bench, *linked).run());
    for (const PassText& pass : *written) {
        add_without_value(found, pass);
        add_miscounting(found, pass);
        add_divergent(found, pass, bench.scene().passes[pass.pass]);
        add_wrong_edges(found, pass);
    }
    for (Seam& seam : TRY(find_seams(bench, *written))) {
        found.all.push_back({Finding::Kind::seam, seam.sentence, seam.where, {}});
        found.all.back().cures.push_back(std::move(seam.cure));
    }
    TRY(RayFinder(bench, *written, found).run());
    add_rounding(bench, found, *written);
    if (hashes)
        add_hashes(found, *written);
    return found;
}

} // namespace tidemark::lab
