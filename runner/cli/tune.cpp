#include "lab/tune.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "cli/changed_files.hpp"
#include "cli/commands.hpp"
#include "host/console.hpp"
#include "host/frame_files.hpp"
#include "host/gl_context.hpp"
#include "host/json.hpp"
#include "host/requests.hpp"
#include "host/study_support.hpp"
#include "host/supervision.hpp"
#include "lab/study_data.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>

namespace tidemark::cli {

using namespace host;
namespace fs = std::filesystem;
namespace {

struct TuneOptions : SearchOptions {
    std::optional<double> most_milliseconds;
    std::vector<std::string> vary;
    std::vector<std::string> keep;
    bool as_it_is = false;
};

/// The default error limit of --as-it-is, an invisible difference from the scene's current picture.
constexpr const char* k_usual_likeness = "flip=0.01";

Result<lab::Goal> goal_of(const TuneOptions& options) {
    lab::Goal goal;
    const std::string most =
        options.as_it_is && options.most_error.empty() ? k_usual_likeness : options.most_error;
    if (!most.empty())
        goal = TRY(lab::parse_goal(most));
    if (options.as_it_is && goal.measure == lab::Measure::wrong)
        return fail(ErrorCode::usage,
                    "--as-it-is compares pictures: give --max-error flip=0.01, rmse=0.01 or "
                    "psnr=40dB");
    goal.most_milliseconds = options.most_milliseconds;
    if (goal.most_error && goal.most_milliseconds)
        return fail(ErrorCode::usage, "--max-error and --max-time: give one of them");
    if (goal.most_milliseconds && !(*goal.most_milliseconds > 0))
        return fail(ErrorCode::usage, "--max-time: give milliseconds above 0");
    return goal;
}

/// Returns the quality settings found in the scene's text, without those of --keep, with the values of --vary
/// instead of ours.
Result<std::vector<lab::QualitySetting>> settings_of(const TuneOptions& options, const scene::Scene& scene) {
    lab::QualitySettings settings = lab::quality_settings(scene, lab::march_places(scene));
    for (const std::string& text : options.vary) {
        const lab::Axis axis = TRY(lab::parse_axis(text, "--vary"));
        TRY(lab::with(scene, {{axis.name, axis.values.front()}}));
        std::erase_if(settings.found, [&](const auto& each) { return each.axis.name == axis.name; });
        settings.found.push_back(lab::quality_setting(scene, axis));
    }
    std::erase_if(settings.found, [&](const auto& each) {
        return std::ranges::find(options.keep, each.axis.name) != options.keep.end();
    });
    if (options.as_it_is)
        std::ranges::for_each(settings.found, lab::leave_out_stricter);
    for (const lab::QualitySetting& each : settings.found)
        say(fmt::format("varies {} ({}): {}", each.axis.name, each.why, fmt::join(each.axis.values, ", ")));
    for (const std::string& name : settings.left)
        say(fmt::format(
            "leaves {} unchanged, because it may be a part of the picture (--vary {}=… varies it)", name,
            name));
    if (settings.found.empty())
        return fail(ErrorCode::usage, "found no number in this scene that trades time for exactness: name "
                                      "one with --vary NAME=a,b,c, from the coarsest to the strictest");
    return std::move(settings.found);
}

Result<lab::TuneRequest> request_of(const TuneOptions& options, const scene::Scene& scene) {
    lab::TuneRequest request{TRY(search_request(options, scene)), {}};
    request.goal = TRY(goal_of(options));
    request.settings = TRY(settings_of(options, scene));
    request.as_it_is = options.as_it_is;
    return request;
}

/// Prints the change of the files, and writes it with --write. Returns the changed files.
Result<std::vector<ChangedFile>> offer(const TuneOptions& options, const scene::Scene& scene,
                                       const lab::Tuned& tuned) {
    if (tuned.chosen.empty())
        return std::vector<ChangedFile>{};
    auto files = TRY(with_settings(scene, tuned.chosen));
    for (const ChangedFile& file : files)
        say(difference(file));
    if (options.write)
        TRY(write_files(files));
    return files;
}

Result<void> put_json(const lab::Tuned& tuned, const std::vector<ChangedFile>& files) {
    Json chosen = Json::object(), diff = Json::array();
    for (const lab::Setting& setting : tuned.chosen)
        chosen[setting.name] = setting.value;
    for (const ChangedFile& file : files)
        diff.push_back(difference(file));
    return put(dump(Json{{"schema", "tidemark tune 1"},
                         {"chosen", std::move(chosen)},
                         {"sentences", tuned.sentences},
                         {"difference", std::move(diff)},
                         {"study", parse_json(lab::to_json(tuned.findings.set))}}) +
               "\n");
}

Result<int> tune(TuneOptions options) {
    Interrupt interrupt;
    const scene::Scene scene = TRY(load_editable(options.scene));
    const OutputPath folder =
        OutputPath::typed_or(options.output, name_after_scene(options.scene.path, "-tune"))
            .sparing(files_read(scene));
    const auto context = TRY(host::HeadlessContext::create(options.device));
    const lab::TuneRequest request = TRY(request_of(options, scene));
    TRY(prepare_report(folder));
    StudyWatcher watcher(interrupt);
    auto tuned = lab::tune(scene, request, watcher.watch(), circumstances_of(scene));
    TRY(watcher.finish());
    if (!tuned && interrupt.requested())
        return Interrupt::k_exit_code;
    lab::Tuned found = TRY(std::move(tuned));
    const fs::path report = TRY(write_findings(folder, found.findings));
    for (const std::string& sentence : found.sentences)
        say(sentence);
    const auto files = TRY(offer(options, scene, found));
    say_report(report);
    if (options.json)
        TRY(put_json(found, files));
    return interrupt.requested() ? Interrupt::k_exit_code : 0;
}

} // namespace

void add_tune(Command app, Action& chosen) {
    auto options = std::make_shared<TuneOptions>();
    options->usual_views = "1;10";
    options->early_views = "0.5;1.5";
    Command command = app.add_subcommand(
        "tune", "Finds the fastest settings within an error, or the most exact within a time");
    add_scene_options(command, options->scene);
    command
        .add_option("--max-error", options->most_error,
                    "Largest error: rmse=0.01, psnr=40dB, flip=0.02 or wrong=0.05% [the present error]")
        .type_name("MEASURE=V");
    command
        .add_option("--max-time", options->most_milliseconds,
                    "Finds the most exact settings within so many milliseconds per frame")
        .type_name("MS");
    command
        .add_flag(
            "--as-it-is", options->as_it_is,
            "Measures errors against the scene as it is now, not against a stricter reference [flip=0.01]")
        .excludes("--max-time");
    command
        .add_option("--vary", options->vary,
                    "Values of a knob (#iUniform, #define or const), from the coarsest to the strictest")
        .type_name("NAME=a,b,c")
        .repeatable();
    command.add_option("--keep", options->keep, "A number to leave unchanged").type_name("NAME").repeatable();
    add_search_options(command, *options);
    command.on_call([options, &chosen] { chosen = [options] { return tune(*options); }; });
}

} // namespace tidemark::cli
