#include "base/error.hpp"
#include "base/file.hpp"
#include "cli/commands.hpp"
#include "host/command_line.hpp"
#include "host/console.hpp"
#include "host/diagnostics.hpp"
#include "host/frame_files.hpp"
#include "host/gl_context.hpp"
#include "host/requests.hpp"
#include "host/study_support.hpp"
#include "host/supervision.hpp"
#include "lab/conduct.hpp"
#include "lab/study_data.hpp"
#include "scene/load_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace tidemark::cli {

using namespace host;
namespace fs = std::filesystem;
namespace {

struct StudyOptions {
    SceneRequest scene;
    std::string output;
    std::string file; ///< --study
    std::string size;
    std::vector<std::string> vary;
    std::string views;
    std::vector<std::string> reference;
    std::vector<std::string> even;
    std::string baseline;
    host::DeviceChoice device{};
    lab::Timing timing;
    bool json = false;
};

Result<lab::Study> parse(const fs::path& path, const Result<std::string>& text) {
    if (!text)
        return fail(text.error());
    return lab::parse_study(*text, path.string());
}

/// Returns the scene's own study, without its series if the command line gives --vary.
Result<lab::Study> base_study(const StudyOptions& options) {
    std::error_code ignored;
    if (!options.file.empty())
        return parse(options.file, read_text_file(options.file));
    const fs::path beside = file_beside(options.scene.path, "study.json");
    const bool exists = fs::exists(beside, ignored);
    if (!exists)
        return lab::Study{};
    const scene::Bounds bounds(beside.parent_path(), options.scene.files.allow_outside);
    auto study = parse(beside, bounds.read_text(beside));
    if (study && !options.vary.empty()) {
        study->series.clear();
        study->about.clear();
        study->omissions.clear();
    }
    return study;
}

Result<std::vector<lab::View>> views_of(const std::string& text) {
    if (!text.ends_with(".json"))
        return lab::parse_views(text);
    const auto file = TRY(read_text_file(text));
    auto study = lab::parse_study(fmt::format("{{\"views\": {}}}", file), text);
    if (!study)
        return fail(std::move(study.error()));
    return std::move(study->views);
}

/// Returns the study file with the command line's overrides.
Result<lab::Study> plan_study(const StudyOptions& options) {
    auto study = base_study(options);
    if (!study)
        return study;
    std::vector<lab::Axis> axes;
    for (const std::string& text : options.vary) {
        auto axis = TRY(lab::parse_axis(text, "--vary"));
        axes.push_back(std::move(axis));
    }
    if (!axes.empty())
        study->series = lab::series_of(axes);
    study->precision = precision_of(options.scene);
    if (study->sources.empty() && study->precision == glsl::Precision::single)
        study->sources = {{"rounding", {}, true}};
    for (const std::string& text : options.reference) {
        auto settings = TRY(lab::parse_settings(text, "--reference"));
        if (&text == &options.reference.front())
            study->reference.clear();
        study->reference.insert(study->reference.end(), settings.begin(), settings.end());
    }
    if (!options.views.empty()) {
        auto views = TRY(views_of(options.views));
        study->views = std::move(views);
    }
    if (study->views.empty())
        study->views = lab::default_views();
    if (!options.size.empty()) {
        const auto extent = TRY(parse_size(options.size));
        study->extent = extent;
    }
    study->even.insert(study->even.end(), options.even.begin(), options.even.end());
    return study;
}

/// Adds a curve for each number of the scene that trades time for exactness, if the study names none.
Result<void> choose_series(lab::Study& study, const scene::Scene& scene, const lab::KeepGoing& keep_going) {
    if (!study.series.empty())
        return {};
    auto settings = lab::quality_settings(scene, lab::march_places(scene)).found;
    if (settings.empty())
        return fail(ErrorCode::usage,
                    "found no number in this scene that trades time for exactness: name one with --vary "
                    "NAME=a,b,c, from the coarsest to the strictest");
    auto chosen = TRY(lab::choose_knobs(scene, std::move(settings), study, keep_going));
    if (chosen.settings.empty())
        return fail(ErrorCode::check_failed,
                    "no reference: " + chosen.why + "; name knobs with --vary NAME=a,b,c");
    for (const lab::QualitySetting& each : chosen.settings) {
        say(fmt::format("varies {} ({}): {}", each.axis.name, each.why, fmt::join(each.axis.values, ", ")));
        study.series.push_back({each.axis.name, lab::Trust::unknown, {}, {each.axis}});
    }
    if (!chosen.why.empty())
        say((chosen.as_it_is ? "the scene as it is takes the place of a reference: "
                             : "only the march's own settings are varied: ") +
            chosen.why);
    study.axes = std::move(chosen.axes);
    study.as_it_is = chosen.as_it_is && study.reference.empty();
    if (study.as_it_is)
        study.sources.clear();
    return {};
}

/// Returns the files that the report must not replace. It may replace its baseline.
std::vector<fs::path> files_of_study(const StudyOptions& options, const scene::Scene& scene) {
    std::vector<fs::path> files = files_read(scene);
    files.push_back(options.file.empty() ? file_beside(options.scene.path, "study.json")
                                         : fs::path(options.file));
    if (options.views.ends_with(".json"))
        files.emplace_back(options.views);
    return files;
}

/// Prints what became worse; returns the number of such settings.
Result<size_t> hold_against_baseline(const std::string& file, const std::string& text,
                                     const lab::WorkPrecisionSet& set) {
    const auto found = TRY(lab::compare_with(text, file, set));
    for (const auto* lines : {&found.notes, &found.worse})
        for (const std::string& line : *lines)
            say(line);
    say(fmt::format("compared with the baseline: {} of {} settings are worse", found.worse.size(),
                    found.compared));
    return found.worse.size();
}

Result<int> study(const StudyOptions& options) {
    lab::Study plan = TRY(plan_study(options));
    if (!(options.timing.budget > 0))
        return fail(ErrorCode::usage, "--budget: give a number of seconds above 0");
    Interrupt interrupt;
    const auto scene = TRY(load(options.scene));
    // Read before the report, which may replace it.
    const auto baseline =
        TRY(options.baseline.empty() ? Result<std::string>() : read_text_file(options.baseline));
    const OutputPath folder =
        OutputPath::typed_or(options.output, name_after_scene(options.scene.path, "-study"))
            .sparing(files_of_study(options, scene));
    TRY(prepare_report(folder));
    const auto context = TRY(host::HeadlessContext::create(options.device));
    TRY(choose_series(plan, scene, [&] { return !interrupt.requested(); }));
    StudyWatcher watcher(interrupt);
    auto findings = lab::conduct(scene, plan, options.timing, watcher.watch(), circumstances_of(scene));
    TRY(watcher.finish());
    if (!findings && interrupt.requested()) {
        say(findings.error());
        return Interrupt::k_exit_code;
    }
    if (!findings)
        return fail(std::move(findings.error()));
    say_findings(findings->set, TRY(write_findings(folder, *findings)));
    if (options.json)
        TRY(put(lab::to_json(findings->set)));
    if (interrupt.requested())
        return Interrupt::k_exit_code;
    if (options.baseline.empty())
        return 0;
    return hold_against_baseline(options.baseline, baseline, findings->set).map([](size_t worse) {
        return worse == 0 ? 0 : exit_code(ErrorCode::check_failed);
    });
}

} // namespace

void add_study(Command app, Action& chosen) {
    auto options = std::make_shared<StudyOptions>();
    Command command =
        app.add_subcommand("study", "Measures error against run time over settings, and writes a report");
    add_scene_options(command, options->scene);
    add_precision_options(command, options->scene);
    command.add_option("-o,--output", options->output, "Folder for the report [SCENE-study]")
        .type_name("FOLDER");
    command.add_option("--study", options->file, "File that describes the study [SCENE.study.json]")
        .type_name("FILE")
        .check(existing_file());
    command
        .add_option("--vary", options->vary,
                    "Values of a knob (#iUniform, #define or const), from the coarsest to the strictest "
                    "[knobs that are found in the text]")
        .type_name("NAME=a,b,c")
        .repeatable();
    command
        .add_option("--views", options->views,
                    "Views to measure: times, and mouse positions as parts of the picture, as in "
                    "0;10@0.75,0.4; or a file [1;10]")
        .type_name("LIST|FILE");
    command
        .add_option(
            "--reference", options->reference,
            "Settings of the reference [the strictest, made stricter until the picture no longer changes]")
        .type_name("NAME=V,...")
        .repeatable();
    command.add_option("--even", options->even, "A knob that takes even values only, as Simpson's rule does")
        .type_name("NAME")
        .repeatable();
    command.add_option("--size", options->size, "Resolution in pixels [320x180]").type_name("WxH");
    command
        .add_option("--budget", options->timing.budget,
                    "Seconds for the timing; fewer rounds if 40 take longer")
        .type_name("S")
        .capture_default_str();
    command
        .add_option("--baseline", options->baseline,
                    "An older study.json; exit code 1 if a setting is slower or less exact, beyond noise")
        .type_name("FILE");
    add_device_options(command, options->device);
    command.add_flag("--json", options->json, "Also prints study.json");
    command.on_call([options, &chosen] { chosen = [options] { return study(*options); }; });
}

} // namespace tidemark::cli
