#include "cli/check/check_portable.hpp"

#include "base/try.hpp"
#include "cli/console.hpp"
#include "cli/diagnostics.hpp"
#include "cli/json_dump.hpp"
#include "cli/site_refusals.hpp"
#include "cli/version.hpp"
#include "glsl/portability.hpp"
#include "platform/headless_context.hpp"

#include <nlohmann/json.hpp>

namespace tidemark::cli {
namespace {

Json json_of(const Diagnostic& diagnostic) {
    return {{"file", diagnostic.where.file},
            {"line", diagnostic.where.line},
            {"column", diagnostic.where.column},
            {"message", diagnostic.message}};
}

} // namespace

Result<int> check_portable(const SceneRequest& request, const platform::DeviceChoice& device, bool as_json) {
    const auto scene = TRY(load(request));
    std::vector<Diagnostic> found = glsl::portability_lint(scene);
    const auto context = platform::HeadlessContext::create(device);
    if (context)
        add_site_refusals(scene, found);
    else
        say("only the texts were looked at, nothing was compiled: " + to_string(context.error()));

    Json json = {{"tidemark", k_version},
                 {"scene", scene.file.string()},
                 {"portable", found.empty()},
                 {"compiled", context.has_value()},
                 {"findings", Json::array()}};
    std::string text = found.empty() ? "nothing found\n" : "";
    for (const Diagnostic& diagnostic : found) {
        if (findings_are_diagnostics())
            say(finding_of(diagnostic, {"portable", "The texts compile on ShaderToy's own site"}));
        else
            text += to_string(diagnostic) + '\n';
        json["findings"].push_back(json_of(diagnostic));
    }
    const int code = found.empty() ? 0 : exit_code(ErrorCode::check_failed);
    return put(as_json ? dump(json, 2) + "\n" : text).map([code] { return code; });
}

} // namespace tidemark::cli
