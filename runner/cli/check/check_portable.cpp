#include "cli/check/check_portable.hpp"

#include "base/try.hpp"
#include "cli/console.hpp"
#include "cli/json_dump.hpp"
#include "cli/version.hpp"
#include "gl/program.hpp"
#include "glsl/assemble.hpp"
#include "glsl/driver_log.hpp"
#include "glsl/pass_reading.hpp"
#include "glsl/portability.hpp"
#include "platform/headless_context.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace tidemark::cli {
namespace {

using Json = nlohmann::ordered_json;
using Diagnostics = std::vector<Diagnostic>;

Json to_json(const Diagnostic& diagnostic) {
    return {{"file", diagnostic.where.file},
            {"line", diagnostic.where.line},
            {"column", diagnostic.where.column},
            {"message", diagnostic.message}};
}

/// What the driver says of the texts as the site would compile them. One place is reported once: of Common,
/// that stands in front of every pass, and of what was `found` by reading.
void add_refusals(const scene::Scene& scene, Diagnostics& found) {
    const auto is_known = [&found](const SourceLocation& where) {
        return std::ranges::any_of(found, [&](const Diagnostic& known) {
            return known.where.line > 0 && known.where.file == where.file && known.where.line == where.line;
        });
    };
    for (const scene::Pass& pass : scene.passes) {
        const text::MappedText source = glsl::PassReading(scene, pass).site_source();
        const auto linked = gl::Program::link(glsl::vertex_shader(glsl::Version::es_300), source.text());
        if (linked)
            continue;
        auto refusals = glsl::parse_driver_log(linked.error(), source);
        std::erase_if(refusals, [&](const glsl::DriverMessage& refusal) {
            return refusal.follows || refusal.diagnostic.severity != Severity::error ||
                   is_known(refusal.diagnostic.where);
        });
        for (auto& [refusal, follows] : refusals) {
            if (refusal.where.file.empty())
                refusal.message = fmt::format("{}: {}", pass.name, refusal.message);
            found.push_back(std::move(refusal));
        }
    }
}

} // namespace

Result<int> check_portable(const SceneRequest& request, const std::string& device, bool as_json) {
    const auto scene = TRY(load(request));
    Diagnostics found = glsl::portability_lint(scene);
    const auto context = platform::HeadlessContext::create(device);
    if (context)
        add_refusals(scene, found);
    else
        say("only the texts were looked at, nothing was compiled: " + to_string(context.error()));

    Json json = {{"tidemark", k_version},
                 {"scene", scene.file.string()},
                 {"portable", found.empty()},
                 {"compiled", context.has_value()},
                 {"findings", Json::array()}};
    std::string text = found.empty() ? "nothing found\n" : "";
    for (const Diagnostic& diagnostic : found) {
        text += to_string(diagnostic) + '\n';
        json["findings"].push_back(to_json(diagnostic));
    }
    const int code = found.empty() ? 0 : exit_code(ErrorCode::check_failed);
    return put(as_json ? dump(json, 2) + "\n" : text).map([code] { return code; });
}

} // namespace tidemark::cli
