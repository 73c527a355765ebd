#include "lab/simplify.hpp"

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
#include "lab/work_precision.hpp"
#include "scene/scene.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

namespace tidemark::cli {

using namespace host;
namespace fs = std::filesystem;
namespace {

struct SimplifyOptions : SearchOptions {
    bool exact = false;
};

Result<lab::Goal> goal_of(const SimplifyOptions& options) {
    if (options.exact)
        return lab::Goal{lab::Measure::rmse, 0, {}};
    const lab::Goal goal = TRY(lab::parse_goal(options.most_error));
    if (goal.measure == lab::Measure::wrong)
        return fail(ErrorCode::usage,
                    "--max-error: simplify compares pictures: give rmse=0.01, psnr=40dB or flip=0.02");
    return goal;
}

Result<lab::SimplifyRequest> request_of(const SimplifyOptions& options, const scene::Scene& scene) {
    lab::SimplifyRequest request{TRY(search_request(options, scene)), {}};
    request.goal = TRY(goal_of(options));
    return request;
}

/// A chosen cut and the change of the files that it makes.
struct OfferedCut {
    lab::ChosenCut cut;
    std::string difference;
};

struct Offer {
    std::vector<OfferedCut> cuts{};
    std::vector<ChangedFile> files{}; ///< changed by all cuts together
};

/// Merges changes of one file: `before` of the first and `after` of the last.
void add(std::vector<ChangedFile>& files, const ChangedFile& change) {
    const auto known = std::ranges::find(files, change.file, &ChangedFile::file);
    if (known == files.end())
        files.push_back(change);
    else
        known->after = change.after;
}

Result<Offer> offer_of(const std::vector<lab::ChosenCut>& chosen) {
    Offer offer;
    CuredFiles files;
    std::vector<glsl::Cure> changes;
    for (const lab::ChosenCut& cut : chosen) {
        changes.push_back(cut.change);
        OfferedCut& offered = offer.cuts.emplace_back(OfferedCut{cut, {}});
        for (const ChangedFile& file : TRY(files.with_last(changes))) {
            offered.difference += difference(file);
            add(offer.files, file);
        }
    }
    return offer;
}

std::string to_text(const OfferedCut& offered) {
    const std::string time =
        std::isnan(offered.cut.time) ? "not timed" : fmt::format("{:.3g} of the time", offered.cut.time);
    return fmt::format("{}\n  alone: {}, error {}\n{}", offered.cut.change.reason, time,
                       lab::figure(offered.cut.error), offered.difference);
}

/// Returns a sentence about inputs that the search saw in one state only; empty if there are none.
std::string unseen_inputs(const scene::Scene& scene) {
    std::vector<std::string> given;
    const auto add = [&](const char* state) {
        if (std::ranges::find(given, state) == given.end())
            given.emplace_back(state);
    };
    for (const scene::Pass& pass : scene.passes)
        for (const scene::Channel& channel : pass.channels) {
            const scene::InputTraits& traits = scene::traits_of(channel.input);
            if (traits.changes == scene::Changes::with_keys)
                add("no key pressed");
            else if (traits.changes == scene::Changes::with_clock &&
                     std::ranges::all_of(scene::input_files(channel.input), &fs::path::empty))
                add("silence");
        }
    return given.empty() ? ""
                         : fmt::format("judged with {}: the cuts may leave out what another input would show",
                                       fmt::join(given, " and "));
}

Result<void> put_json(const lab::Simplified& found, const Offer& offer, bool written) {
    Json cuts = Json::array();
    for (const OfferedCut& each : offer.cuts)
        cuts.push_back({{"cut", each.cut.change.reason},
                        {"error_alone", each.cut.error},
                        {"time_alone", each.cut.time},
                        {"difference", each.difference}});
    return put(dump(Json{{"schema", "tidemark simplify 1"},
                         {"cuts", std::move(cuts)},
                         {"sentences", found.sentences},
                         {"written", written},
                         {"study", parse_json(lab::to_json(found.findings.set))}}) +
               "\n");
}

Result<void> print_simplified(const SimplifyOptions& options, const lab::Simplified& found) {
    for (const std::string& sentence : found.sentences)
        say(sentence);
    const Offer offer = TRY(offer_of(found.chosen));
    if (!options.json)
        for (const OfferedCut& each : offer.cuts)
            TRY(put(to_text(each)));
    if (options.write)
        TRY(write_files(offer.files));
    return options.json ? put_json(found, offer, options.write && !offer.files.empty()) : Result<void>();
}

Result<int> simplify(SimplifyOptions options) {
    Interrupt interrupt;
    const scene::Scene scene = TRY(load_editable(options.scene));
    lab::SimplifyRequest request = TRY(request_of(options, scene));
    request.can_be_written = [files = CuredFiles()](const glsl::Cure& cure) mutable {
        return files.with_last(std::span(&cure, 1)).has_value();
    };
    const OutputPath folder =
        OutputPath::typed_or(options.output, name_after_scene(options.scene.path, "-simplify"))
            .sparing(files_read(scene));
    const auto context = TRY(host::HeadlessContext::create(options.device));
    TRY(prepare_report(folder));
    StudyWatcher watcher(interrupt);
    auto simplified = lab::simplify(scene, request, watcher.watch(), circumstances_of(scene));
    TRY(watcher.finish());
    if (!simplified && interrupt.requested())
        return Interrupt::k_exit_code;
    lab::Simplified found = TRY(std::move(simplified));
    if (std::string sentence = unseen_inputs(scene); !found.chosen.empty() && !sentence.empty())
        found.sentences.push_back(std::move(sentence));
    const fs::path report = TRY(write_findings(folder, found.findings));
    TRY(print_simplified(options, found));
    say_report(report);
    return interrupt.requested() ? Interrupt::k_exit_code : 0;
}

} // namespace

void add_simplify(Command app, Action& chosen) {
    auto options = std::make_shared<SimplifyOptions>();
    options->most_error = "flip=0.01";
    options->usual_views = "1;4.3;10;31";
    options->early_views = "0.2;0.5;1;2";
    Command command = app.add_subcommand(
        "simplify", "Finds code that a scene can do without, within a stated error of the picture");
    add_scene_options(command, options->scene);
    command
        .add_option(
            "--max-error", options->most_error,
            "Largest error against the unchanged scene, in every view: flip=0.02, rmse=0.01 or psnr=40dB")
        .type_name("MEASURE=V")
        .capture_default_str();
    command.add_flag("--exact", options->exact, "Only changes that leave every pixel unchanged")
        .excludes("--max-error");
    add_search_options(command, *options);
    command.on_call([options, &chosen] { chosen = [options] { return simplify(*options); }; });
}

} // namespace tidemark::cli
