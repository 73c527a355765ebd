#include "base/error.hpp"
#include "base/file.hpp"
#include "cli/commands.hpp"
#include "host/console.hpp"
#include "host/diagnostics.hpp"
#include "host/json.hpp"
#include "host/requests.hpp"
#include "scene/load_scene.hpp"
#include "scene/project_exchange.hpp"
#include "shader/pass_reading.hpp"
#include "web/page.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <utility>

namespace tidemark::cli {

using namespace host;
using host::resolve;
namespace fs = std::filesystem;
namespace {

struct ExportOptions {
    SceneRequest scene;
    FrameOptions frames{};
    std::string output = "-";
    std::string html{}; ///< output file of a page; empty: write ShaderToy's JSON
    bool embed = false;
    bool json = false;

    const std::string& target() const { return html.empty() ? output : html; }
};

/// Returns the folder that holds the scene's scene.json; empty if the scene has none.
fs::path project_folder(const fs::path& scene) {
    std::error_code ignored;
    if (fs::exists(scene / scene::k_project_file, ignored))
        return scene;
    const fs::path folder = scene.parent_path().empty() ? fs::path(".") : scene.parent_path();
    return scene.filename() == scene::k_project_file ? folder : fs::path();
}

/// Loads the scene. Fails as drawing it would if the text has characters that GLSL does not have, which some
/// compilers take for blanks.
Result<scene::Scene> load_plain(const SceneRequest& request) {
    scene::Scene scene = TRY(load(request));
    for (const scene::Pass& pass : scene.passes)
        if (const glsl::PassReading reading(scene, pass); reading.may_be_drawn_wrong())
            return fail(Error{ErrorCode::load, fmt::format("'{}' does not compile", scene.file.string()),
                              reading.problems()});
    return scene;
}

/// Returns a page, or a page's fragment. Sets `read` to the files it is made of.
Result<std::string> page_of(const ExportOptions& options, std::vector<fs::path>& read) {
    const auto scene = TRY(load_plain(options.scene));
    const auto frames = TRY(resolve(options.frames));
    read = files_read(scene);
    return web::make_page(scene, options.embed ? web::PageForm::fragment : web::PageForm::whole,
                          run_numbers(frames.state));
}

/// Returns ShaderToy's JSON. Sets `read` to the files it is made of.
Result<std::string> project_of(const ExportOptions& options, std::vector<fs::path>& read) {
    const SceneRequest& request = options.scene;
    if (const fs::path folder = project_folder(request.path); !folder.empty()) {
        if (!request.sets.empty())
            return fail(ErrorCode::usage, "--set: a scene folder with a scene.json is exported unchanged");
        read = scene::scene_files_in(folder);
        return scene::join_project(folder, scene::Bounds(folder, request.files.allow_outside));
    }
    if (request.path.extension() == ".json")
        return fail(ErrorCode::usage, fmt::format("'{}' is already ShaderToy's JSON", request.path.string()));
    const auto scene = load_plain(request);
    if (!scene)
        return fail(scene.error());
    read = files_read(*scene);
    std::vector<Diagnostic> warnings;
    auto project = scene::make_project(*scene, warnings);
    for (const Diagnostic& warning : warnings)
        say(finding_of(warning));
    return project;
}

Result<int> export_scene(const ExportOptions& options) {
    const std::string& target = options.target();
    if (options.json && target == "-")
        return fail(ErrorCode::usage,
                    fmt::format("--json and {} - both write to standard output: give one of them",
                                options.html.empty() ? "-o" : "--html"));
    if (options.html.empty())
        for (const auto& [given, option] : {std::pair(options.embed, "--embed"),
                                            {!options.scene.files.media.empty(), "--media"},
                                            {!options.frames.numbers.empty(), "--bpm"}})
            if (given)
                return fail(ErrorCode::usage, fmt::format("{} needs --html FILE", option));
    std::vector<fs::path> read;
    const auto text = TRY(options.html.empty() ? project_of(options, read) : page_of(options, read));
    if (target == "-")
        return put(text).map([] { return 0; });
    TRY(write_file(OutputPath::typed(target).sparing(read), text));
    say(fmt::format("wrote {}", target));
    if (!options.json)
        return 0;
    const nlohmann::ordered_json report = {
        {"tidemark", k_version}, {"scene", options.scene.path.string()}, {"file", target}};
    return put(dump(report, 2) + "\n").map([] { return 0; });
}

} // namespace

void add_export(Command app, Action& chosen) {
    auto options = std::make_shared<ExportOptions>();
    Command command = app.add_subcommand(
        "export", "Converts a scene to ShaderToy's JSON, or to a page that draws it in any browser");
    command.add_option("SCENE", options->scene.path, "A scene folder, or a file with mainImage").required();
    const Option output = command.add_option("-o,--output", options->output, "File; -: standard output")
                              .type_name("FILE")
                              .capture_default_str();
    command
        .add_option("--html", options->html,
                    "Writes a page that draws the scene in a browser, all in one file; -: standard output")
        .type_name("FILE")
        .excludes(output);
    command.add_flag("--embed", options->embed, "With --html: writes a <div> for a page of your own");
    command
        .add_option("--set", options->scene.sets,
                    "Value of a knob (#iUniform): a constant in JSON, the first value in a page")
        .repeatable()
        .type_name("NAME=VALUE");
    add_number_options(command, options->frames, "--bpm");
    add_file_options(command, options->scene);
    command.add_flag("--json", options->json, "Prints one JSON object");
    command.on_call([options, &chosen] { chosen = [options] { return export_scene(*options); }; });
}

} // namespace tidemark::cli
