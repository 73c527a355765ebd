#include "host/study_support.hpp"

#include "base/encoding.hpp"
#include "host/console.hpp"
#include "lab/outcome.hpp"
#include "lab/study_report.hpp"
#include "lab/work_precision.hpp"
#include "render/frame_plan.hpp"
#include "render/gl_context.hpp"
#include "scene/json_text.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <ctime>
#include <span>
#include <thread>

namespace tidemark::host {
namespace {

OutputPath report_folder(const OutputPath& folder, bool complete) {
    const auto there = read_file((folder / "study.json").path(), size_t{1} << 30);
    const auto old = there ? scene::parse_json(*there, "study.json") : Result<scene::Json>();
    const bool finished =
        there && old && old->is_object() && old->contains("complete") && (*old)["complete"] == true;
    return complete || !finished ? folder : folder.beside("-interrupted");
}

} // namespace

lab::Circumstances circumstances_now() {
    lab::Circumstances facts;
    facts.tidemark = k_version;
    facts.started = fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::localtime(std::time(nullptr)));
    facts.cores = int(std::thread::hardware_concurrency());
    return facts;
}

lab::Watch StudyWatcher::watch() {
    return {[this](const std::string& what, size_t total) {
                progress_ = std::make_unique<Progress>(what, total);
            },
            [this] { progress_->advance(); }, [this] { return goes_on(); }};
}

bool StudyWatcher::goes_on() {
    if (driver_)
        driver_ = gl::check_work("measuring");
    return driver_ && !interrupt_.requested();
}

Result<void> StudyWatcher::finish() {
    progress_.reset();
    goes_on();
    return driver_.map_error([](Error error) {
        error.message += "; the measurement was discarded, try a smaller --size";
        return error;
    });
}

lab::Circumstances circumstances_of(const scene::Scene& scene) {
    const gl::Capabilities driver = gl::query_capabilities();
    lab::Circumstances facts = circumstances_now();
    facts.scene = scene.file.string();
    std::string text = scene.common.text();
    for (const scene::Pass& pass : scene.passes)
        text += pass.text.text();
    facts.scene_sha256 = sha256(std::as_bytes(std::span(text)));
    facts.renderer = driver.renderer;
    facts.driver = driver.version;
    return facts;
}

Result<void> prepare_report(const OutputPath& folder) {
    TRY(make_folder(folder));
    return check_writable(folder / "study.json");
}

Result<std::filesystem::path> write_findings(const OutputPath& folder, const lab::Findings& findings) {
    const OutputPath place = report_folder(folder, findings.set.circumstances.complete);
    TRY(make_folder(place));
    TRY(lab::write_report(place, findings));
    return place.path();
}

void say_report(const std::filesystem::path& folder) {
    say(fmt::format("wrote {}", (folder / "report.html").string()));
}

void say_findings(const lab::WorkPrecisionSet& set, const std::filesystem::path& folder) {
    for (const std::string& sentence : lab::sentences(set))
        say(sentence);
    for (const lab::ObservedOrder& order : set.orders)
        if (order.order)
            say(lab::to_string(order));
    if (const std::string held = lab::held_sentence(set); !held.empty())
        say(held);
    for (const std::string& remark : set.circumstances.remarks)
        say(remark);
    say_report(folder);
}

void add_search_options(Command command, SearchOptions& options) {
    command
        .add_option(
            "--views", options.views,
            "Views to measure: times, and mouse positions as parts of the picture, as in 0;10@0.75,0.4")
        .type_name("LIST")
        .default_str(options.usual_views);
    command.add_option("--size", options.size, "Resolution in pixels [320x180]").type_name("WxH");
    command
        .add_option("--budget", options.seconds, "Seconds for searching and timing, not counting compilation")
        .type_name("S")
        .capture_default_str();
    command.add_option("--for", options.seconds, "The name of --budget in version 0.1").group("");
    command
        .add_option("-o,--output", options.output,
                    fmt::format("Folder for the report [SCENE-{}]", command.name()))
        .type_name("FOLDER");
    command.add_flag("--write", options.write, "Writes the result into the scene's files");
    add_device_options(command, options.device);
    command.add_flag("--json", options.json, "Prints the result and its study as one JSON object");
}

Result<lab::SearchRequest> search_request(const SearchOptions& options, const scene::Scene& scene) {
    lab::SearchRequest request;
    const std::string& unasked = render::may_have_feedback(scene) ? options.early_views : options.usual_views;
    request.views = TRY(lab::parse_views(options.views.empty() ? unasked : options.views));
    if (!options.size.empty())
        request.extent = TRY(parse_size(options.size));
    if (!(options.seconds > 0))
        return fail(ErrorCode::usage, "--budget: give a number of seconds above 0");
    request.seconds = options.seconds;
    return request;
}

} // namespace tidemark::host
