#include "bake/study_report.hpp"

#include "bake/fast_marching_study.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "host/console.hpp"
#include "host/study_support.hpp"
#include "host/supervision.hpp"
#include "lab/outcome.hpp"
#include "lab/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::bake {

using namespace host;
namespace {

constexpr int k_study_sides[] = {64, 128, 256, 512, 1024};

// ---- The table

/// Formats an error and its order of convergence against the previous size, for example "1.2e-03 1.97".
std::string error_cell(double error, std::optional<double> before) {
    const std::string order = before ? fmt::format("{:5.2f}", std::log2(*before / error)) : "    -";
    return fmt::format("{:8.1e} {}", error, order);
}

Result<void> put_table(const bake::KnownCase& known, bake::Stencil stencil) {
    using bake::Region;
    if (auto printed = put(fmt::format(
            "\n{}, order {}\n{:>5} | {:^29} | {:^29} | {:>8} {:>8} {:>8} {:>8}\n{:>5} | {:^14} {:^14} | "
            "{:^14} {:^14} |\n",
            known.description, int(stencil), "side", "smooth", "rest", "CPU ms", "ns/node", "updates", "heap",
            "", "largest", "rms", "largest", "rms"));
        !printed)
        return printed;
    std::optional<bake::MarchSample> before;
    for (const int side : k_study_sides) {
        const bake::MarchSample sample = bake::study_march(known, side, stencil);
        const auto cell = [&](Region region, double bake::ErrorNorms::*norm) {
            const auto of = [&](const bake::MarchSample& s) { return s.errors[size_t(region)].*norm; };
            return error_cell(of(sample), before ? std::optional(of(*before)) : std::nullopt);
        };
        const double nodes = double(side) * side;
        auto printed = put(fmt::format(
            "{:5} | {} {} | {} {} | {:8.1f} {:8.0f} {:8.2f} {:8.2f}\n", side,
            cell(Region::smooth, &bake::ErrorNorms::largest), cell(Region::smooth, &bake::ErrorNorms::rms),
            cell(Region::rest, &bake::ErrorNorms::largest), cell(Region::rest, &bake::ErrorNorms::rms),
            1e3 * sample.seconds, 1e9 * sample.seconds / nodes, double(sample.work.updates) / nodes,
            double(sample.work.heap_operations) / nodes));
        if (!printed)
            return printed;
        before = sample;
    }
    return {};
}

Result<void> put_tables() {
    if (auto printed =
            put("Shortest ways from a circle of radius 1 against the exact ones: error, and the power "
                "of the spacing it falls with.\n"
                "smooth: the way keeps 0.1 from land and from the middle. rest of open water: the "
                "middle; of the others: behind\nland and beside it. updates, heap: local solutions "
                "and heap operations a node.\n");
        !printed)
        return printed;
    for (const bake::KnownCase& known : bake::known_cases())
        for (const auto stencil : {bake::Stencil::first_order, bake::Stencil::second_order})
            if (auto printed = put_table(known, stencil); !printed)
                return printed;
    return {};
}

// ---- The report

constexpr bake::Stencil k_stencils[] = {bake::Stencil::first_order, bake::Stencil::second_order};
constexpr int k_usual_side = 512; // the default of the program

/// The parameters of the marching at one point of the study.
struct MarchSetting {
    bake::Stencil stencil = bake::Stencil::second_order;
    int side = k_usual_side;
};

lab::Study plan() {
    lab::Study study;
    study.about =
        "Shortest ways over water from a circle of radius 1, by fast marching. t is the length of a "
        "way, in radii; hits are nodes of the grid in the water, evaluations thousands of local solutions; "
        "a pixel is the spacing of the nodes.";
    for (const bake::KnownCase& known : bake::known_cases())
        study.views.push_back({std::string(known.description)});
    lab::Axis sides{"nodes a side", {}};
    for (const int side : k_study_sides)
        sides.values.push_back(fmt::format("{}", side));
    for (const bake::Stencil stencil : k_stencils)
        study.series.push_back({fmt::format("order {}", int(stencil)),
                                lab::Trust::unknown,
                                {{"order", fmt::format("{}", int(stencil))}},
                                {sides}});
    study.omissions = {
        "The middle of the map, where the circle closes on itself, is left out but on open water."};
    return study;
}

/// Returns the settings of the points of plan(), in the order of lab::points_of: the default setting, then
/// all combinations.
std::vector<MarchSetting> march_settings() {
    std::vector<MarchSetting> settings{{}};
    for (const bake::Stencil stencil : k_stencils)
        for (const int side : k_study_sides)
            settings.push_back({stencil, side});
    return settings;
}

lab::Hits hits_of(std::vector<double> ways, double evaluations) {
    lab::Hits hits;
    hits.evaluations.assign(ways.size(), float(evaluations));
    hits.flags.assign(ways.size(), 0);
    hits.distance = std::move(ways);
    return hits;
}

/// Compares the marches of one setting with the exact results, case by case and together.
void hold_against_exact(const MarchSetting& setting, lab::WorkPrecision& point) {
    std::vector<lab::Hits> exact, found;
    std::vector<std::vector<double>> footprints; // hit_errors takes them at distance 1
    const auto outcome_of = [](const lab::Hits& truth, const lab::Hits& test,
                               const std::vector<double>& pixel) {
        lab::Outcome outcome;
        outcome.hits = lab::hit_errors(truth, test, pixel);
        outcome.causes = lab::count(lab::causes(truth, test));
        return outcome;
    };
    for (const bake::KnownCase& known : bake::known_cases()) {
        bake::MarchSample sample = bake::study_march(known, setting.side, setting.stencil);
        for (std::vector<double>& pixel = footprints.emplace_back(); const double way : sample.ways.exact)
            pixel.push_back(sample.spacing / std::max(way, 1e-9));
        const double thousands = 1e-3 * double(sample.work.updates);
        exact.push_back(hits_of(std::move(sample.ways.exact), 0));
        found.push_back(hits_of(std::move(sample.ways.found), thousands));
        point.views.push_back(outcome_of(exact.back(), found.back(), footprints.back()));
    }
    point.all = outcome_of(lab::joined(exact), lab::joined(found), lab::joined(footprints));
    point.compile_milliseconds = point.first_draw_milliseconds = std::nan("");
}

lab::WorkPrecisionSet march_set(const std::vector<MarchSetting>& settings) {
    lab::WorkPrecisionSet set;
    set.study = plan();
    set.words = {"RMS error of the way, in radii", "thousands of local solutions", "the bake's own setting"};
    set.circumstances = circumstances_now();
    set.circumstances.scene = "bake island";
    set.hit_standard = {"closed forms of the ways, in double: straight lines, tangents, arcs and corners",
                        1e-15, "a few roundings of numbers up to 1"};
    std::vector<lab::Point> points = lab::points_of(set.study);
    for (size_t i = 0; i < points.size(); ++i) {
        set.points.emplace_back().point = std::move(points[i]);
        hold_against_exact(settings[i], set.points.back());
    }
    return set;
}

Result<int> write_march_report(const MarchStudyRequest& request) {
    Interrupt interrupt;
    const OutputPath folder = OutputPath::typed(request.folder);
    TRY(prepare_report(folder));
    const std::vector<MarchSetting> settings = march_settings();
    lab::Findings findings{march_set(settings), {}};
    std::vector<std::vector<std::function<void()>>> marches;
    for (const MarchSetting& setting : settings)
        for (auto& of_point = marches.emplace_back(); const bake::KnownCase& known : bake::known_cases())
            of_point.push_back(bake::march_of(known, setting.side, setting.stencil));
    StudyWatcher watcher(interrupt);
    lab::Timing timing;
    timing.budget = request.budget;
    findings.set.circumstances.complete = lab::time_points(
        timing, watcher.watch(),
        [&](size_t point, size_t view, bool) {
            const lab::Stopwatch watch;
            marches[point][view]();
            return lab::Cost{watch.elapsed(), {}};
        },
        findings.set);
    watcher.finish();
    findings.set.circumstances.clock = "wall clock";
    lab::judge(findings.set);
    lab::observe_orders(findings.set);
    say_findings(findings.set, TRY(write_findings(folder, findings)));
    return interrupt.requested() ? Interrupt::k_exit_code : 0;
}

} // namespace

Result<int> study_march(const MarchStudyRequest& request) {
    TRY(put_tables());
    return request.folder.empty() ? 0 : write_march_report(request);
}

} // namespace tidemark::bake
