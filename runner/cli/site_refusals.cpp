#include "cli/site_refusals.hpp"

#include "gl/program.hpp"
#include "glsl/assemble.hpp"
#include "glsl/driver_log.hpp"
#include "glsl/pass_reading.hpp"
#include "glsl/portability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tidemark::cli {

void add_site_refusals(const scene::Scene& scene, std::vector<Diagnostic>& found) {
    const auto is_known = [&found](const SourceLocation& where) {
        return std::ranges::any_of(found, [&](const Diagnostic& known) {
            return known.where.line > 0 && known.where.file == where.file && known.where.line == where.line;
        });
    };
    for (const scene::Pass& pass : scene.passes) {
        const glsl::PassReading reading(scene, pass);
        const text::MappedText source = reading.site_source();
        const auto linked = gl::Program::link(glsl::vertex_shader(glsl::Version::es_300), source.text());
        if (linked)
            continue;
        auto refusals = glsl::parse_driver_log(linked.error(), source);
        std::erase_if(refusals, [&](const glsl::DriverMessage& refusal) {
            return refusal.follows || glsl::is_taken_by_the_site(reading, refusal.diagnostic.message) ||
                   refusal.diagnostic.severity != Severity::error || is_known(refusal.diagnostic.where);
        });
        for (auto& [refusal, follows] : refusals) {
            if (refusal.where.file.empty())
                refusal.message = fmt::format("{}: {}", pass.name, refusal.message);
            found.push_back(std::move(refusal));
        }
    }
}

} // namespace tidemark::cli
