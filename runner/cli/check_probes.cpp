// Draws pictures with one thread, in a child process: llvmpipe reads its number of threads when it starts.

#include "base/error.hpp"
#include "base/file.hpp"
#include "cli/check.hpp"
#include "cli/check_report.hpp"
#include "host/console.hpp"
#include "host/devices.hpp"
#include "host/diagnostics.hpp"
#include "host/forked.hpp"
#include "host/gl_context.hpp"
#include "host/json.hpp"
#include "host/requests.hpp"
#include "host/supervision.hpp"
#include "lab/probe_bench.hpp"
#include "media/picture_file.hpp"
#include "render/gl_context.hpp"
#include "scene/load_scene.hpp"
#include "shader/definitions.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace tidemark::cli {

using namespace host;
using host::to_json;

namespace {

Result<image::Image> picture(const scene::Scene& scene, const host::DeviceChoice& device,
                             const render::FrameState& state) {
    const auto context = TRY(host::HeadlessContext::create(device));
    return lab::ProbeBench(scene, {}).picture(state);
}

/// Encodes the bit patterns, since JSON has no NaN.
Json bits_of(const image::Image& picture) {
    Json bits = Json::array();
    for (const float sample : picture.f32())
        bits.push_back(std::bit_cast<uint32_t>(sample));
    return bits;
}

} // namespace

/// Starts a process that sleeps until `drawn_by`. Call it before this process has a context.
Result<ForkedHelper> one_thread_painter(const scene::Scene& scene, const host::DeviceChoice& device) {
    return ForkedHelper::start([&](const std::string& question, const Tell& tell) {
        ::setenv("LP_NUM_THREADS", "0", 1); // no threads in addition to the calling one
        const auto drawn =
            frame_state_of(parse_json(question)).and_then([&](const render::FrameState& state) {
                return picture(scene, device, state);
            });
        tell(dump(drawn ? bits_of(*drawn) : to_json(drawn.error())));
    });
}

/// Returns true if the driver of the current context can be limited to one thread.
bool counts_threads() {
    return gl::query_capabilities().renderer.starts_with("llvmpipe");
}

/// Draws the picture, once: RGB of Image as ProbeBench::picture returns it.
Result<image::Image> drawn_by(ForkedHelper& painter, const render::FrameState& state, double seconds) {
    const auto run = TRY(painter.ask(dump(to_json(state)), {seconds}));
    if (run.timed_out)
        return fail(ErrorCode::timed_out,
                    fmt::format("drawing with one thread did not finish within {:.3g} s", seconds));
    if (run.output.empty())
        return fail(ErrorCode::load, run.crash);
    const Json bits = parse_json(run.output);
    if (auto error = error_of(bits))
        return fail(*std::move(error));
    image::Image picture(state.extent, 3, image::SampleType::f32);
    std::ranges::transform(bits, picture.f32().begin(),
                           [](const Json& sample) { return std::bit_cast<float>(sample.get<uint32_t>()); });
    return picture;
}

namespace fs = std::filesystem;
namespace {

using lab::Verdict;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The share of the remaining time that tracing one finding may take.
constexpr double k_share_of_trace = 0.9;

constexpr const char* k_not_asked = "not run: --budget is used up";
constexpr const char* k_not_finished = "not finished: --budget is used up";
constexpr const char* k_interrupted = "not run: interrupted";

std::string probe_names() {
    std::string names;
    for (const lab::Probe& probe : lab::all_probes())
        names += fmt::format("{}{}", names.empty() ? "" : ", ", probe.name);
    return names;
}

Result<std::vector<const lab::Probe*>> chosen_probes(const std::vector<std::string>& names) {
    for (const std::string& name : names)
        if (std::ranges::find(lab::all_probes(), name, &lab::Probe::name) == lab::all_probes().end())
            return fail(ErrorCode::usage,
                        fmt::format("--probe {}: no such probe; there are {}", name, probe_names()));
    std::vector<const lab::Probe*> chosen;
    for (const lab::Probe& probe : lab::all_probes())
        if (names.empty() || std::ranges::find(names, probe.name) != names.end())
            chosen.push_back(&probe);
    return chosen;
}

Result<void> keep_picture(const OutputPath& folder, ProbeResult& asked) {
    if (folder.empty() || !asked.answer.picture || !is_finding(asked.answer.verdict))
        return {};
    const OutputPath picture = folder / fmt::format("{}.png", asked.probe->name);
    asked.picture = picture.path();
    return image::write_picture(picture, *asked.answer.picture);
}

Result<void> keep_page(const OutputPath& folder, const ProbesRequest& request,
                       std::span<const ProbeResult> all, double seconds) {
    const OutputPath page = folder / "index.html";
    TRY(write_file(page, verdict_page(request, all, seconds)));
    say(fmt::format("wrote {}", page.string()));
    return {};
}

/// Runs one probe, unless the scene skips it and it was not named on the command line.
Result<ProbeResult> ask(const lab::Probe& probe, lab::ProbeBench& bench, bool by_name, bool time_left) {
    ProbeResult asked{&probe, {}};
    const auto skipped = bench.promises().skip.find(std::string(probe.name));
    if (!by_name && skipped != bench.promises().skip.end()) {
        asked.answer = {Verdict::not_applicable, "skipped by the scene: " + skipped->second};
    } else if (!time_left) {
        asked.answer = {Verdict::cut, k_not_asked};
    } else {
        const Clock::time_point start = Clock::now();
        auto answer = TRY(probe.ask(bench));
        asked.answer = std::move(answer);
        asked.seconds = seconds_since(start);
    }
    return asked;
}

/// Returns the failure for a driver that crashed or was reset.
lab::Answer broken_driver(const std::string& message) {
    return {.verdict = Verdict::fail, .sentence = message, .effect = message};
}

using Probes = std::span<const lab::Probe* const>;

/// Runs in a child process and sends one line for each probe. If the driver was reset or out of memory, that
/// is the result of the current probe and the run stops, since later pictures would be invalid.
Result<void> ask_all(const ProbesRequest& request, const scene::Scene& scene, const lab::Promises& promises,
                     Probes probes, Clock::time_point start, const Tell& tell) {
    auto painter = TRY(one_thread_painter(scene, request.device));
    const auto context = TRY(host::HeadlessContext::create(request.device));
    lab::DrawElsewhere with_one_thread;
    if (counts_threads())
        with_one_thread = [&](const render::FrameState& state) {
            return drawn_by(painter, state, request.budget - seconds_since(start));
        };
    lab::ProbeBench bench(scene, promises, with_one_thread);
    for (const lab::Probe* probe : probes) {
        auto asked = TRY(ask(*probe, bench, !request.probes.empty(), seconds_since(start) < request.budget));
        const auto driver = gl::check_work("drawing");
        if (!driver)
            asked.answer = broken_driver(driver.error().message);
        if (auto kept = keep_picture(OutputPath::typed(request.output).sparing(files_read(scene)), asked);
            !kept)
            return kept;
        tell(dump(to_json(asked)));
        if (!driver)
            break;
    }
    return {};
}

/// Called with each result as it arrives.
using Take = std::function<Result<void>(ProbeResult)>;

/// Runs all probes in order. If the driver hangs or crashes, that is the result of the probe that was
/// running. After an interrupt the remaining probes are cut.
Result<void> answer_all(const ProbesRequest& request, const scene::Scene& scene,
                        const lab::Promises& promises, Probes probes, Clock::time_point start,
                        const Interrupt& interrupt, const Take& take) {
    while (!probes.empty()) {
        const double left = request.budget - seconds_since(start);
        if (left <= 0 || interrupt.requested()) {
            const char* why = interrupt.requested() ? k_interrupted : k_not_asked;
            if (auto taken = take({probes.front(), {Verdict::cut, why}}); !taken)
                return taken;
            probes = probes.subspan(1);
            continue;
        }
        const Clock::time_point began = Clock::now();
        double seconds = 0; // time of the finished probes and of handling their results
        double taking = 0;  // time to handle the previous result, while the next probe waited
        Result<void> heard;
        const size_t before = probes.size();
        const auto run = run_forked(
            [&](const Tell& tell) {
                if (auto done = ask_all(request, scene, promises, probes, start, tell); !done)
                    tell(dump(to_json(done.error())));
            },
            {.seconds = left, .unwanted = [&] { return interrupt.requested(); }},
            [&](std::string_view line) {
                const Json json = parse_json(line);
                if (auto error = error_of(json))
                    heard = fail(*std::move(error));
                if (!heard)
                    return;
                auto asked = result_of(json);
                if (!asked) {
                    heard = fail(std::move(asked.error()));
                    return;
                }
                asked->seconds = std::max(asked->seconds - taking, 0.0);
                const double spent = asked->seconds;
                probes = probes.subspan(1);
                const Clock::time_point taken = Clock::now();
                heard = take(*std::move(asked));
                taking = seconds_since(taken);
                seconds += spent + taking;
            });
        if (!run)
            return fail(run.error());
        if (!heard)
            return heard;
        if (probes.empty())
            break;
        const bool ended_by_itself = !run->timed_out && run->crash.empty() && probes.size() < before;
        if (ended_by_itself || run->unwanted) // after a reset of the driver the rest gets a new context
            continue;
        ProbeResult last{probes.front(), {Verdict::cut, k_not_finished}};
        if (!run->crash.empty())
            last.answer = broken_driver(run->crash);
        last.seconds = seconds_since(began) - seconds;
        TRY(take(std::move(last)));
        probes = probes.subspan(1);
    }
    return {};
}

/// Finds the origin of a NaN or infinity that a probe found.
void trace(const ProbesRequest& request, const scene::Scene& scene, const Interrupt& interrupt,
           ProbeResult& asked, double seconds) {
    const render::FrameState& where = *asked.answer.where;
    const auto set = lab::in_state(scene, where);
    TraceJob job{request.device, {}, [&] { return interrupt.requested(); }};
    job.request.states = [&](int frame) { return where.at_frame(frame); };
    job.request.frame = where.frame;
    job.request.start = lab::first_frame_of(where);
    const auto found = set.and_then([&](const scene::Scene& same) -> Result<TraceFound> {
        if (seconds > 0)
            return trace_apart(same, job, seconds);
        return fail(ErrorCode::timed_out, "--budget is used up");
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

} // namespace

Result<lab::Promises> promises_of(const SceneRequest& request, const scene::Scene& scene) {
    const fs::path file = file_beside(request.path, "check.json");
    std::error_code ignored;
    if (!fs::exists(file, ignored))
        return lab::Promises{};
    const auto text = TRY(scene::Bounds(file.parent_path(), request.files.allow_outside).read_text(file));
    return lab::parse_promises(text, file.string(),
                               [&](const std::string& name) { return glsl::definition_of(scene, name); });
}

Result<int> list_probes() {
    std::string text;
    for (const lab::Probe& probe : lab::all_probes())
        text += fmt::format("{:10} {}\n", probe.name, probe.about);
    return put(text).map([] { return 0; });
}

Result<int> check_probes(const ProbesRequest& request, Interrupt& interrupt) {
    std::optional<Interrupt::Immediate> at_once(std::in_place, interrupt); // nothing is found yet
    const auto probes = TRY(chosen_probes(request.probes));
    if (!(request.budget > 0))
        return fail(ErrorCode::usage, "--budget: give a number of seconds above 0");
    const Clock::time_point start = Clock::now();
    host::compile_for_few_drawings();
    auto scene = TRY(load(request.scene));
    const auto promises = TRY(promises_of(request.scene, scene));
    const OutputPath folder = OutputPath::typed(request.output).sparing(files_read(scene));
    if (!request.output.empty())
        TRY(make_folder(folder)); // before the probes, whose time would be lost if the folder cannot be made
    const bool shown = request.json || ::isatty(STDERR_FILENO) == 1;
    Progress progress("probes", shown ? probes.size() : 0, {.limit = request.budget});
    std::vector<ProbeResult> all;
    at_once.reset(); // from here on an interrupt ends the probes, and what they found is printed
    const auto take = [&](ProbeResult asked) -> Result<void> {
        if (asked.answer.non_finite)
            trace(request, scene, interrupt, asked,
                  k_share_of_trace * (request.budget - seconds_since(start)));
        all.push_back(std::move(asked));
        progress.advance();
        return {};
    };
    const auto done = answer_all(request, scene, promises, probes, start, interrupt, take);
    if (!done)
        return fail(done.error());
    progress.step_aside();
    if (!request.output.empty())
        TRY(keep_page(folder, request, all, seconds_since(start)));
    if (findings_are_diagnostics())
        for (const JoinedFinding& joined : joined_findings(request, all))
            if (joined.level != Verdict::note || request.all)
                say(finding(scene, joined));
    const std::string text = request.json                 ? report(request, all)
                             : findings_are_diagnostics() ? ""
                                                          : printed(request, all, seconds_since(start));
    return put(text).map([&] { return interrupt.requested() ? Interrupt::k_exit_code : exit_code(all); });
}

} // namespace tidemark::cli
