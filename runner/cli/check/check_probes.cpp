#include "cli/check/check_probes.hpp"

#include "base/file.hpp"
#include "base/shell_word.hpp"
#include "cli/check/asked.hpp"
#include "cli/check/one_thread.hpp"
#include "cli/console.hpp"
#include "cli/forked.hpp"
#include "cli/progress.hpp"
#include "cli/version.hpp"
#include "glsl/overrides.hpp"
#include "image/files/picture_file.hpp"
#include "platform/headless_context.hpp"

#include <fmt/format.h>
#include <sys/time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <span>
#include <sstream>

namespace tidemark::cli {
namespace fs = std::filesystem;
namespace {

using lab::Verdict;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Once there is something to trace, the probes end at this part of --budget.
constexpr double k_share_of_probes = 0.75;
constexpr const char* k_not_asked = "not asked: --budget is spent";

std::string probe_names() {
    std::string names;
    for (const lab::Probe& probe : lab::all_probes())
        names += fmt::format("{}{}", names.empty() ? "" : ", ", probe.name);
    return names;
}

Result<std::vector<const lab::Probe*>> chosen_probes(const std::vector<std::string>& names) {
    std::vector<const lab::Probe*> chosen;
    for (const std::string& name : names)
        if (std::ranges::find(lab::all_probes(), name, &lab::Probe::name) == lab::all_probes().end())
            return fail(ErrorCode::usage, fmt::format("--probe {}: there are {}", name, probe_names()));
    for (const lab::Probe& probe : lab::all_probes())
        if (names.empty() || std::ranges::find(names, probe.name) != names.end())
            chosen.push_back(&probe);
    return chosen;
}

Result<lab::Promises> promises_of(const fs::path& path, const scene::Scene& scene) {
    const fs::path file = file_beside(path, "check.json");
    std::error_code ignored;
    if (!fs::exists(file, ignored))
        return lab::Promises{};
    const auto text = read_text_file(file);
    if (!text)
        return fail(text.error());
    return lab::parse_promises(*text, file.string(),
                               [&](const std::string& name) { return glsl::definition_of(scene, name); });
}

std::string reproduction(const ProbesRequest& request, const lab::Situation& situation) {
    std::string options;
    const auto add = [&options](const char* name, const std::vector<std::string>& values) {
        for (const std::string& value : values)
            options += fmt::format("{} {} ", name, shell_word(value));
    };
    add("--set", request.scene.sets);
    add("--define", request.scene.defines);
    add("--channel", request.scene.channels);
    if (!request.scene.files.media.empty())
        add("--media", {request.scene.files.media.string()});
    if (request.scene.files.allow_outside)
        options += "--allow-outside ";
    return fmt::format("tidemark capture {} {}{} -o {}", shell_word(request.scene.path.string()), options,
                       lab::capture_options(situation),
                       shell_word(request.scene.path.stem().string() + ".exr"));
}

Result<void> keep_picture(const fs::path& folder, Asked& asked) {
    if (folder.empty() || !asked.answer.picture)
        return {};
    if (auto made = make_folder(folder); !made)
        return made;
    asked.picture = folder / fmt::format("{}.png", asked.probe->name);
    return image::write_picture(asked.picture, *asked.answer.picture);
}

/// Asks one probe, unless the scene leaves it out and nobody named it.
Result<Asked> ask(const lab::Probe& probe, lab::ProbeBench& bench, bool by_name, bool time_left) {
    Asked asked{&probe, {Verdict::not_applicable, {}}};
    const auto skipped = bench.promises().skip.find(std::string(probe.name));
    if (!by_name && skipped != bench.promises().skip.end()) {
        asked.answer.sentence = "left out by the scene: " + skipped->second;
    } else if (!time_left) {
        asked.answer.sentence = k_not_asked;
    } else {
        const Clock::time_point start = Clock::now();
        auto answer = probe.ask(bench);
        if (!answer)
            return fail(std::move(answer.error()));
        asked.answer = *std::move(answer);
        asked.seconds = seconds_since(start);
    }
    return asked;
}

using Probes = std::span<const lab::Probe* const>;

/// By SIGALRM, whatever it is at. Nothing when the time is over: then no probe is begun.
void end_process_after(double seconds) {
    itimerval timer{};
    timer.it_value.tv_sec = time_t(std::max(seconds, 0.0));
    timer.it_value.tv_usec = suseconds_t(1e6 * std::fmod(std::max(seconds, 0.0), 1.0));
    ::setitimer(ITIMER_REAL, &timer, nullptr);
}

/// In a process of its own: one line for each probe.
Result<void> ask_all(const ProbesRequest& request, const scene::Scene& scene, const lab::Promises& promises,
                     Probes probes, Clock::time_point start, const Tell& tell) {
    auto painter = one_thread_painter(scene, request.device);
    if (!painter)
        return fail(std::move(painter.error()));
    const auto context = platform::HeadlessContext::create(request.device);
    if (!context)
        return fail(context.error());
    lab::DrawElsewhere with_one_thread;
    if (counts_threads())
        with_one_thread = [&](const lab::Situation& situation) {
            return drawn_by(*painter, situation, request.budget - seconds_since(start));
        };
    lab::ProbeBench bench(scene, promises, with_one_thread);
    Progress progress("probes", probes.size());
    double limit = request.budget;
    for (const lab::Probe* probe : probes) {
        auto asked = ask(*probe, bench, !request.probes.empty(), seconds_since(start) < limit);
        if (!asked)
            return fail(std::move(asked.error()));
        if (auto kept = keep_picture(request.output, *asked); !kept)
            return kept;
        tell(dump(told(*asked)));
        if (asked->answer.non_finite && limit == request.budget) {
            limit = k_share_of_probes * request.budget;
            end_process_after(limit - seconds_since(start));
        }
        progress.advance();
    }
    return {};
}

/// Adds what a process told. The error is the one it ended with.
Result<void> take(const std::string& output, std::vector<Asked>& all) {
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) {
        const Json json = Json::parse(line);
        if (auto error = told_error(json))
            return fail(*std::move(error));
        all.push_back(told_answer(json));
    }
    return {};
}

/// Answers of all probes, in their order. The driver may hang or crash on the way: then the probe it was
/// asked for has that as its answer.
Result<std::vector<Asked>> answers(const ProbesRequest& request, const scene::Scene& scene,
                                   const lab::Promises& promises, Probes probes, Clock::time_point start) {
    std::vector<Asked> all;
    const auto seconds_left = [&] {
        const bool to_trace = std::ranges::any_of(all, [](const Asked& a) { return a.answer.non_finite; });
        return (to_trace ? k_share_of_probes : 1) * request.budget - seconds_since(start);
    };
    while (all.size() < probes.size()) {
        const double left = seconds_left();
        if (left <= 0) {
            all.push_back({probes[all.size()], {Verdict::not_applicable, k_not_asked}});
            continue;
        }
        const size_t before = all.size();
        const Clock::time_point began = Clock::now();
        const auto run = run_forked(
            [&](const Tell& tell) {
                if (auto done = ask_all(request, scene, promises, probes.subspan(before), start, tell); !done)
                    tell(dump(told(done.error())));
            },
            left);
        if (!run)
            return fail(run.error());
        if (auto taken = take(run->output, all); !taken)
            return fail(std::move(taken.error()));
        if (all.size() == probes.size())
            break;
        Asked cut{probes[all.size()], {Verdict::not_applicable, "cut: --budget is spent"}};
        if (run->signal != 0 && run->signal != SIGALRM)
            cut.answer = {Verdict::fail, fmt::format("the driver crashed (signal {})", run->signal)};
        cut.seconds = seconds_since(began);
        for (const Asked& asked : std::span(all).subspan(before))
            cut.seconds -= asked.seconds;
        all.push_back(std::move(cut));
    }
    return all;
}

/// What gave birth to what a probe found not finite.
void trace(const ProbesRequest& request, const scene::Scene& scene, Asked& asked, double seconds) {
    const lab::Situation& where = *asked.answer.where;
    const auto set = lab::in_situation(scene, where);
    const int frame = lab::inputs_of(where).frame;
    TraceJob job{request.device, where.extent, where.pass, {}};
    job.request.frame = frame;
    job.request.start = frame - lab::run_up_of(where);
    job.request.inputs = [&](int at) { return lab::inputs_of(where, frame - at); };
    const auto found = set.and_then([&](const scene::Scene& same) -> Result<TraceFound> {
        if (seconds > 0)
            return trace_apart(same, job, seconds);
        return fail(ErrorCode::timed_out, "--budget is spent");
    });
    if (!found)
        asked.trace = fmt::format("not traced: {}\n", to_string(found.error()));
    else if (!found->found)
        asked.trace = "not traced: drawn again, every pixel is finite\n";
    else
        asked.trace = found->text + (found->ended.empty() ? "" : "  note: " + found->ended + '\n');
    if (found)
        asked.trace_json = found->json;
}

/// Each line behind `margin`.
std::string indented(const std::string& text, const std::string& margin) {
    std::string result;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        result += margin + line + '\n';
    return result;
}

std::string table(const ProbesRequest& request, const std::vector<Asked>& all) {
    double seconds = 0;
    for (const Asked& asked : all)
        seconds += asked.seconds;
    std::string text;
    for (const Asked& asked : all) {
        text += fmt::format("{:4}  {:10} {}", lab::to_string(asked.answer.verdict), asked.probe->name,
                            asked.answer.sentence);
        if (asked.seconds > 0)
            text += fmt::format("  [{:.0f} %]", 100 * asked.seconds / seconds);
        text += '\n';
        const std::string margin(17, ' ');
        text += indented(asked.trace, margin);
        if (asked.answer.where)
            text += fmt::format("{}{}\n", margin, reproduction(request, *asked.answer.where));
        if (!asked.picture.empty())
            text += fmt::format("{}{}\n", margin, asked.picture.string());
    }
    return text + fmt::format("{:.1f} s\n", seconds);
}

std::string report(const ProbesRequest& request, const std::vector<Asked>& all) {
    Json json = {{"tidemark", k_version}, {"scene", request.scene.path.string()}};
    json["probes"] = Json::array();
    for (const Asked& asked : all) {
        Json entry = {{"probe", asked.probe->name},
                      {"verdict", lab::to_string(asked.answer.verdict)},
                      {"found", asked.answer.sentence},
                      {"seconds", asked.seconds}};
        if (asked.answer.where)
            entry["reproduction"] = reproduction(request, *asked.answer.where);
        if (!asked.picture.empty())
            entry["picture"] = asked.picture.string();
        if (asked.answer.non_finite) {
            entry["trace"] = asked.trace_json;
            entry["traced"] = asked.trace;
        }
        json["probes"].push_back(std::move(entry));
    }
    return dump(json, 2) + "\n";
}

} // namespace

Result<int> list_probes() {
    std::string text;
    for (const lab::Probe& probe : lab::all_probes())
        text += fmt::format("{:10} {}\n", probe.name, probe.about);
    return put(text).map([] { return 0; });
}

Result<int> check_probes(const ProbesRequest& request) {
    const auto probes = chosen_probes(request.probes);
    if (!probes)
        return fail(probes.error());
    if (!(request.budget > 0))
        return fail(ErrorCode::usage, "--budget: give a number of seconds above 0");
    const Clock::time_point start = Clock::now();
    auto scene = load(request.scene);
    if (!scene)
        return fail(std::move(scene.error()));
    const auto promises = promises_of(request.scene.path, *scene);
    if (!promises)
        return fail(promises.error());
    auto told = answers(request, *scene, *promises, *probes, start);
    if (!told)
        return fail(std::move(told.error()));
    std::vector<Asked>& all = *told;
    for (Asked& asked : all)
        if (asked.answer.non_finite)
            trace(request, *scene, asked, request.budget - seconds_since(start));
    const bool failed =
        std::ranges::any_of(all, [](const Asked& asked) { return asked.answer.verdict == Verdict::fail; });
    return put(request.json ? report(request, all) : table(request, all)).map([failed] {
        return failed ? exit_code(ErrorCode::check_failed) : 0;
    });
}

} // namespace tidemark::cli
