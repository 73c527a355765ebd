// Measures what it costs to load a library that a scene without such inputs does not load.

#include "base/error.hpp"
#include "base/measurement.hpp"
#include "cli/inspect.hpp"
#include "host/console.hpp"
#include "host/forked.hpp"
#include "host/gl_context.hpp"
#include "host/json.hpp"
#include "lab/savings.hpp"
#include "media/picture_codecs.hpp"
#include "media/sound_file.hpp"
#include "render/gl_context.hpp"

#include <fmt/format.h>
#include <link.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

namespace tidemark::cli {

using namespace host;
namespace {

struct OptionalLibrary {
    std::string_view name;
    std::string_view file; ///< part of the name of its shared object
    void (*load)();

    /// Returns true if it is loaded in this process.
    bool is_loaded() const {
        const auto visit = [](dl_phdr_info* object, size_t, void* wanted) {
            const auto& library = *static_cast<const OptionalLibrary*>(wanted);
            return int(std::string_view(object->dlpi_name).find(library.file) != std::string_view::npos);
        };
        return ::dl_iterate_phdr(visit, const_cast<OptionalLibrary*>(this)) != 0;
    }
};

struct LibraryCost {
    lab::Elapsed time; ///< medians
    double mebibytes = 0;
};

constexpr int k_runs = 5;
constexpr double k_saving_seconds = 30; ///< seconds

constexpr OptionalLibrary k_optional_libraries[] = {
    {"OpenImageIO", "tidemark_pictures", [] { static_cast<void>(image::picture_codec()); }},
    {"libsndfile", "libsndfile", [] { static_cast<void>(sound::load_sound_library()); }},
};

double peak_mebibytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024;
}

/// Loads the library in child processes, since a process loads it only once: at least once, and repeatedly
/// for up to `seconds`. Call it before there is an OpenGL context.
Result<LibraryCost> measure_loading(const OptionalLibrary& library, double seconds) {
    const lab::Stopwatch whole;
    std::vector<double> wall, cpu, memory;
    for (int i = 0; i < k_runs && (i == 0 || whole.elapsed().wall < 1e3 * seconds); ++i) {
        const auto child = run_forked(
            [&](const Tell& tell) {
                const double before = peak_mebibytes();
                const lab::Stopwatch watch;
                library.load();
                const lab::Elapsed time = watch.elapsed();
                tell(fmt::format("{} {} {}", time.wall, time.cpu, peak_mebibytes() - before));
            },
            {k_saving_seconds});
        if (!child)
            return fail(child.error());
        std::istringstream told(child->output);
        if (!(told >> wall.emplace_back() >> cpu.emplace_back() >> memory.emplace_back()))
            return fail(ErrorCode::load, fmt::format("loading {} did not finish", library.name));
    }
    return LibraryCost{{lab::median(wall), lab::median(cpu)}, lab::median(memory)};
}

using lab::Omission;
using lab::Saved;
using lab::Saving;

constexpr std::string_view k_libraries = "libraries";
constexpr std::string_view k_all = "all";
/// The share of the remaining time for one library.
constexpr double k_share_of_library = 0.1;
constexpr double k_mebibyte = 1024.0 * 1024.0;

/// Parts that are put back together.
struct Question {
    std::string name;
    std::vector<Omission> things;
};

struct Answer {
    std::string name;
    Saving saving;
};

struct LoadedLibrary {
    const OptionalLibrary& library;
    LibraryCost cost;
};

bool asks_for(const SavingsOptions& options, std::string_view thing) {
    return std::any_of(options.things.begin(), options.things.end(),
                       [&](const std::string& asked) { return asked == thing || asked == k_all; });
}

std::vector<Question> questions_of(const SavingsOptions& options) {
    std::vector<Question> questions;
    const auto all = lab::omissions();
    for (const Omission& thing : all)
        if (asks_for(options, thing.name))
            questions.push_back({std::string(thing.name), {thing}});
    if (asks_for(options, k_all))
        questions.push_back({std::string(k_all), {all.begin(), all.end()}});
    return questions;
}

double left_of(const SavingsOptions& options, const lab::Stopwatch& watch) {
    return options.budget - watch.elapsed().wall / 1e3;
}

Result<std::vector<LoadedLibrary>> load_libraries(const SavingsOptions& options,
                                                  const lab::Stopwatch& watch) {
    std::vector<LoadedLibrary> loaded;
    if (!asks_for(options, k_libraries))
        return loaded;
    for (const OptionalLibrary& library : k_optional_libraries) {
        auto cost = TRY(measure_loading(library, k_share_of_library * left_of(options, watch)));
        loaded.push_back({library, cost});
    }
    return loaded;
}

/// Divides the remaining time evenly among the questions.
Result<std::vector<Answer>> ask(const SavingsOptions& options, const scene::Scene& scene,
                                const render::RenderOptions& target, const std::vector<Question>& questions,
                                const lab::Stopwatch& watch) {
    std::vector<Answer> answers;
    if (questions.empty())
        return answers;
    auto bench = TRY(lab::SavingsBench::create(scene, target));
    for (const Question& question : questions) {
        const auto saving = TRY(bench.measure(
            question.things, left_of(options, watch) / double(questions.size() - answers.size())));
        answers.push_back({question.name, saving});
    }
    return answers;
}

/// Formats with about three significant digits, at most to the microsecond.
std::string milliseconds_text(double value) {
    return fmt::format("{:+.{}f}", value, std::abs(value) < 1 ? 3 : std::abs(value) < 10 ? 2 : 0);
}

std::string to_text(const Saved& saved) {
    return fmt::format("{} {} [{}, {}]", milliseconds_text(saved.without).substr(1),
                       milliseconds_text(saved.more), milliseconds_text(saved.interval.low),
                       milliseconds_text(saved.interval.high));
}

std::string change(size_t without, size_t with_it) {
    return without == with_it ? fmt::format("{}", with_it) : fmt::format("{} -> {}", without, with_it);
}

constexpr std::string_view k_row = "{:<16}  {:<30}  {:<30}  {:>11}  {:>9}  {:>9}  {:>9}  {}\n";

std::string row_of_frame(const Answer& answer) {
    const Saving& saving = answer.saving;
    const render::FrameWork& without = saving.without.frame;
    const render::FrameWork& with_it = saving.with_it.frame;
    const double bytes = double(with_it.texture_bytes) - double(without.texture_bytes);
    return fmt::format(fmt::runtime(k_row), answer.name, to_text(saving.start.wall),
                       to_text(saving.frame.wall), fmt::format("{:+.2f} MiB", bytes / k_mebibyte),
                       change(without.draws, with_it.draws), change(without.uniforms, with_it.uniforms),
                       change(without.channels, with_it.channels),
                       saving.same_pixels ? "the same" : "differ");
}

std::string row_of_file(const Answer& answer) {
    const Saving& saving = answer.saving;
    return fmt::format("{:<16}  encoding a PNG: {}, {} bytes; its colours {}\n", answer.name,
                       to_text(saving.file.wall),
                       change(saving.without.file_bytes, saving.with_it.file_bytes),
                       saving.same_pixels ? "are the same" : "differ");
}

std::string to_text(const Answer& answer) {
    if (!answer.saving.cut.empty())
        return fmt::format("{:<16}  not measured: {}\n", answer.name, answer.saving.cut);
    if (!answer.saving.left_out())
        return fmt::format("{:<16}  nothing of this kind is left out of this scene\n", answer.name);
    return (answer.saving.in_frame() ? row_of_frame(answer) : "") +
           (answer.saving.in_file() ? row_of_file(answer) : "");
}

std::string to_text(const LoadedLibrary& loaded) {
    if (loaded.library.is_loaded())
        return fmt::format("{:<16}  this scene needs it\n", loaded.library.name);
    return fmt::format("{:<16}  {} (CPU {}), {:+.1f} MiB of memory\n", loaded.library.name,
                       milliseconds_text(loaded.cost.time.wall), milliseconds_text(loaded.cost.time.cpu),
                       loaded.cost.mebibytes);
}

Json json_of(const Saved& saved) {
    return {{"without", saved.without},
            {"more", saved.more},
            {"low", saved.interval.low},
            {"high", saved.interval.high}};
}

Json json_of(const lab::SavedTime& time) {
    return {{"wall_ms", json_of(time.wall)}, {"cpu_ms", json_of(time.cpu)}};
}

Json json_of(const lab::Work& work) {
    Json json = {{"draws", work.frame.draws},
                 {"uniforms", work.frame.uniforms},
                 {"channels", work.frame.channels},
                 {"texture_bytes", work.frame.texture_bytes}};
    if (work.file_bytes > 0)
        json["file_bytes"] = work.file_bytes;
    return json;
}

Json json_of(const Answer& answer) {
    const Saving& saving = answer.saving;
    if (!saving.cut.empty())
        return {{"with", answer.name}, {"cut", saving.cut}};
    Json json = {{"with", answer.name}, {"left_out", saving.left_out()}};
    if (saving.in_frame())
        json.update({{"start", json_of(saving.start)}, {"frame", json_of(saving.frame)}});
    if (saving.in_file())
        json["file"] = json_of(saving.file);
    if (saving.left_out())
        json.update({{"without", json_of(saving.without)},
                     {"with_it", json_of(saving.with_it)},
                     {"same_pixels", saving.same_pixels}});
    return json;
}

Json json_of(const LoadedLibrary& loaded) {
    const LibraryCost& cost = loaded.cost;
    return {{"name", loaded.library.name},
            {"left_out", !loaded.library.is_loaded()},
            {"wall_ms", cost.time.wall},
            {"cpu_ms", cost.time.cpu},
            {"memory_mib", cost.mebibytes}};
}

std::string report_text(const SavingsOptions& options, const std::vector<Answer>& answers,
                        const std::vector<LoadedLibrary>& libraries) {
    std::string text = fmt::format(
        "{}, {}, {}: milliseconds without the thing, what it adds, and the 95 % interval of that\n",
        options.scene.path.string(), options.size, gl::query_capabilities().renderer);
    const auto in_frame = [](const Answer& answer) { return answer.saving.in_frame(); };
    if (std::ranges::any_of(answers, in_frame))
        text += fmt::format(fmt::runtime(k_row), "with", "start", "per frame", "textures", "draws",
                            "uniforms", "channels", "pixels");
    for (const Answer& answer : answers)
        text += to_text(answer);
    for (const LoadedLibrary& library : libraries)
        text += to_text(library);
    return text;
}

Json report_json(const SavingsOptions& options, const std::vector<Answer>& answers,
                 const std::vector<LoadedLibrary>& libraries) {
    Json json = {{"tidemark", k_version},    {"scene", options.scene.path.string()},
                 {"size", options.size},     {"renderer", gl::query_capabilities().renderer},
                 {"savings", Json::array()}, {"libraries", Json::array()}};
    for (const Answer& answer : answers)
        json["savings"].push_back(json_of(answer));
    for (const LoadedLibrary& library : libraries)
        json["libraries"].push_back(json_of(library));
    return json;
}

} // namespace

std::vector<std::string> things_left_out() {
    std::vector<std::string> names;
    for (const Omission& thing : lab::omissions())
        names.emplace_back(thing.name);
    names.emplace_back(k_libraries);
    names.emplace_back(k_all);
    return names;
}

Result<int> inspect_savings(const SavingsOptions& options) {
    const lab::Stopwatch watch;
    const auto extent = TRY(parse_size(options.size));
    const auto scene = TRY(load(options.scene));
    const auto libraries = load_libraries(options, watch); // before there is a context
    if (!libraries)
        return fail(libraries.error());
    const auto context = TRY(host::HeadlessContext::create(options.device));
    render::RenderOptions target;
    target.extent = extent;
    target.pass = options.pass;
    target.precision = precision_of(options.scene);
    target.specialise = glsl::Specialise::unreachable;
    const auto answers = TRY(ask(options, scene, target, questions_of(options), watch));
    TRY(gl::check_work("measuring"));
    const auto printed = put(options.json ? dump(report_json(options, answers, *libraries), 2) + "\n"
                                          : report_text(options, answers, *libraries));
    const bool same =
        std::ranges::all_of(answers, [](const Answer& answer) { return answer.saving.same_pixels; });
    const bool whole =
        std::ranges::all_of(answers, [](const Answer& answer) { return answer.saving.cut.empty(); });
    return printed.map([&] { return !same ? 1 : whole ? 0 : exit_code(ErrorCode::timed_out); });
}

} // namespace tidemark::cli
