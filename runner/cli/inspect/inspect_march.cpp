#include "cli/inspect/inspect_march.hpp"

#include "lab/march/pass_function.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tidemark::cli {

std::string march_lines(const scene::Scene& scene, const scene::Pass& pass) {
    const auto function = lab::PassFunction::create(scene, pass);
    std::string text;
    if (!function)
        return text;
    for (const ir::MarchingLoop& loop : function->loops()) {
        const SourceLocation where = function->locate(loop.line);
        text += fmt::format(
            "  march     {}:{}: {}, leaves here where it is near the surface\n", where.file, where.line,
            loop.kind == ir::MarchingLoop::Kind::sphere_tracing ? "steps by the distance (sphere tracing)"
                                                                : "steps that the distance does not choose");
    }
    return text;
}

Json marches_of(const scene::Scene& scene, const scene::Pass& pass) {
    const auto function = lab::PassFunction::create(scene, pass);
    if (!function)
        return {{"not_followed", function.error().message}};
    Json loops = Json::array();
    for (const ir::MarchingLoop& loop : function->loops()) {
        const SourceLocation where = function->locate(loop.line);
        loops.push_back({{"file", where.file},
                         {"line", where.line},
                         {"kind", loop.kind == ir::MarchingLoop::Kind::sphere_tracing ? "sphere tracing"
                                                                                      : "fixed step"}});
    }
    return loops;
}

} // namespace tidemark::cli
