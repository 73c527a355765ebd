#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/options.hpp"
#include "cli/version.hpp"
#include "glsl/portability.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace tidemark::cli {
namespace {

struct CheckOptions {
    SceneRequest scene;
    bool portable = false;
    bool json = false;
};

nlohmann::ordered_json to_json(const Diagnostic& diagnostic) {
    return {
        {"file", diagnostic.where.file}, {"line", diagnostic.where.line}, {"message", diagnostic.message}};
}

/// One line for each place that ShaderToy's compiler will refuse; exit 1 when there is one.
Result<int> check_portable(const CheckOptions& options) {
    const auto scene = load(options.scene);
    if (!scene)
        return fail(scene.error());
    const std::vector<Diagnostic> found = glsl::portability_lint(*scene);
    std::string text;
    nlohmann::ordered_json json = {{"tidemark", k_version},
                                   {"scene", scene->file.string()},
                                   {"portable", found.empty()},
                                   {"findings", {}}};
    json["findings"] = nlohmann::ordered_json::array();
    for (const Diagnostic& diagnostic : found) {
        text += to_string(diagnostic) + '\n';
        json["findings"].push_back(to_json(diagnostic));
    }
    const int code = found.empty() ? 0 : exit_code(ErrorCode::check_failed);
    return put(options.json ? json.dump(2) + "\n" : text).map([code] { return code; });
}

} // namespace

void add_check(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<CheckOptions>();
    CLI::App* command = app.add_subcommand("check", "Tells what in a scene will not work elsewhere");
    add_scene_options(*command, options->scene);
    command->add_flag("--portable", options->portable, "What will not compile on ShaderToy's own site")
        ->required();
    command->add_flag("--json", options->json, "One JSON object on standard output");
    command->callback([options, &chosen] { chosen = [options] { return check_portable(*options); }; });
}

} // namespace tidemark::cli
