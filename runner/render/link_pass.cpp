#include "render/link_pass.hpp"

#include "glsl/assemble.hpp"
#include "glsl/driver_log.hpp"
#include "glsl/pass_reading.hpp"

#include <fmt/format.h>

#include <optional>

namespace tidemark::render {
namespace {

/// What the driver said of one attempt.
struct Refusal {
    glsl::ShaderSource source;
    std::string log;
};

class Linker {
public:
    Linker(const scene::Scene& scene, const scene::Pass& pass)
        : scene_(scene), pass_(pass), reading_(scene, pass) {}

    /// The first dialect that links. Channels that nobody specified may be other than pictures: when every
    /// dialect fails, the driver's words tell which kinds are worth trying.
    std::optional<LinkedPass> link() {
        const std::vector<glsl::Dialect> dialects = reading_.dialects();
        if (auto linked = first_that_links(dialects))
            return linked;
        for (const glsl::ChannelKinds& kinds :
             glsl::channel_kinds_to_try(scene_, pass_, first_->source, first_->log)) {
            glsl::Dialect dialect = dialects.front();
            dialect.channels = kinds;
            if (auto linked = first_that_links({dialect}))
                return linked;
        }
        return std::nullopt;
    }

    /// The likeliest dialect's messages are the ones that mean something to the author.
    Error error() const {
        Error error{ErrorCode::load, fmt::format("'{}' does not compile", scene_.file.string()), {}};
        error.diagnostics = reading_.entry_point_problems();
        if (error.diagnostics.empty())
            error.diagnostics = glsl::parse_driver_log(first_->log, first_->source.lines());
        for (Diagnostic& diagnostic : error.diagnostics)
            if (diagnostic.where.file.empty())
                diagnostic.message = fmt::format("{}: {}", pass_.name, diagnostic.message);
        return error;
    }

private:
    std::optional<LinkedPass> first_that_links(const std::vector<glsl::Dialect>& dialects) {
        for (const glsl::Dialect& dialect : dialects) {
            glsl::ShaderSource source = reading_.assemble(dialect);
            auto program = gl::Program::link(glsl::vertex_shader(dialect.version), source.text());
            if (program)
                return LinkedPass{*std::move(program), dialect};
            if (!first_)
                first_ = Refusal{std::move(source), std::move(program.error())};
        }
        return std::nullopt;
    }

    const scene::Scene& scene_;
    const scene::Pass& pass_;
    glsl::PassReading reading_; ///< once for all attempts
    std::optional<Refusal> first_;
};

} // namespace

Result<LinkedPass> link_pass(const scene::Scene& scene, const scene::Pass& pass) {
    Linker linker(scene, pass);
    auto linked = linker.link();
    if (!linked)
        return fail(linker.error());
    return *std::move(linked);
}

} // namespace tidemark::render
