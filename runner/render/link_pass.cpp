#include "render/link_pass.hpp"

#include "glsl/assemble.hpp"
#include "glsl/driver_log.hpp"

#include <fmt/format.h>

namespace tidemark::render {
namespace {

Error compile_error(const scene::Pass& pass, const scene::Scene& scene, std::string_view log,
                    const text::LineMap& lines) {
    Error error{ErrorCode::load, fmt::format("'{}' does not compile", scene.file.string()),
                glsl::parse_driver_log(log, lines)};
    for (Diagnostic& diagnostic : error.diagnostics)
        if (diagnostic.where.file.empty())
            diagnostic.message = fmt::format("{}: {}", pass.name, diagnostic.message);
    return error;
}

} // namespace

Result<gl::Program> link_pass(const scene::Scene& scene, const scene::Pass& pass) {
    const glsl::ShaderSource source = glsl::assemble(scene, pass);
    auto program = gl::Program::link(glsl::k_vertex_shader, source.text());
    if (!program)
        return fail(compile_error(pass, scene, program.error(), source.lines()));
    return *std::move(program);
}

} // namespace tidemark::render
