#include "cli/lsp/compile_check.hpp"

#include "base/try.hpp"
#include "cli/error_json.hpp"
#include "cli/json_dump.hpp"
#include "cli/lsp/hints.hpp"
#include "cli/supervisor.hpp"
#include "platform/driver_cache.hpp"
#include "platform/headless_context.hpp"
#include "render/link_pass.hpp"
#include "scene/load_scene.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace tidemark::cli {
namespace {

namespace fs = std::filesystem;

using Diagnostics = std::vector<Diagnostic>;

/// Adds diagnostics that are not in the list yet: Common is compiled with every pass, so its errors repeat.
void add(Diagnostics& all, Diagnostics more) {
    for (Diagnostic& each : more)
        if (std::ranges::find(all, each) == all.end())
            all.push_back(std::move(each));
}

Diagnostics diagnostics_of(const Error& error) {
    if (!error.diagnostics.empty())
        return error.diagnostics;
    return {{{}, Severity::error, error.message}};
}

/// Formats a line for the parent: the diagnostics in the JSON form of an Error.
std::string line_of(std::string_view kind, const Diagnostics& diagnostics) {
    return dump(Json{{"kind", kind}, {"found", to_json(Error{.message = {}, .diagnostics = diagnostics})}});
}

/// Runs in the child process. Compiles every pass, even after one that fails, and even if no other pass reads
/// it; removes uncalled functions first, as capture does. Errors in uncalled functions are hints instead,
/// because ShaderToy's site compiles them.
Result<void> examine(const fs::path& path, const scene::UnsavedTexts& texts,
                     const platform::DeviceChoice& device, const Tell& tell) {
    const scene::Scene scene = TRY(scene::load_scene(path, {.media = {}, .unsaved = texts}));
    Diagnostics problems = scene.warnings;
    const auto context = platform::HeadlessContext::create(device);
    if (!context)
        add(problems, {{{}, Severity::warning, "nothing is compiled: " + to_string(context.error())}});
    Hints hints(scene);
    for (const scene::Pass& pass : scene.passes) {
        if (!context)
            continue;
        const auto linked = render::link_pass(scene, pass, {.specialise = glsl::Specialise::unreachable});
        if (linked)
            hints.read(pass, linked->dialect);
        else
            add(problems, diagnostics_of(linked.error()));
    }
    tell(line_of("problems", problems));
    tell(line_of("hints", hints.take(problems, context.has_value())));
    return {};
}

Diagnostics left_by(const ForkedResult& result, const ForkedLimits& limits) {
    if (!result.crash.empty())
        return {{{}, Severity::error, result.crash}};
    const std::string what = result.doing.empty() ? "the scene" : result.doing;
    if (result.timed_out)
        return {{{}, Severity::error, fmt::format("{} takes more than {:.3g} s", what, limits.seconds)}};
    return {{{}, Severity::error, fmt::format("{} takes too much memory (--memory)", what)}};
}

} // namespace

Result<CompileCheck> CompileCheck::start(const fs::path& scene, const lsp::Documents& documents,
                                         const platform::DeviceChoice& device, const ForkedLimits& limits) {
    auto helper = TRY(ForkedHelper::start([&](const std::string&, const Tell& tell) {
        platform::do_without_full_driver_cache();
        if (const auto done = examine(scene, documents.texts(), device, tell); !done)
            tell(line_of("problems", diagnostics_of(done.error())));
    }));
    helper.begin({}, limits);
    return CompileCheck(scene, std::move(helper), limits);
}

std::vector<lsp::Verdict> CompileCheck::look() {
    std::vector<lsp::Verdict> verdicts;
    const auto hear = [&](std::string_view line) {
        const Json json = parse_json(line);
        Diagnostics found = error_of(json.at("found"))->diagnostics;
        const bool problems = json.at("kind") == "problems";
        answered_ |= problems;
        (problems ? found_.problems : found_.hints) = std::move(found);
        verdicts.push_back(found_);
    };
    const auto result = helper_.look(hear, std::chrono::milliseconds(0));
    ended_ = result.has_value();
    if (ended_ && !answered_) {
        found_.problems = left_by(*result, limits_);
        verdicts.push_back(found_);
    }
    return verdicts;
}

} // namespace tidemark::cli
