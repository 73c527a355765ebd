#include "render/link_pass.hpp"

#include "gl/program_cache.hpp"
#include "glsl/assemble.hpp"
#include "glsl/driver_log.hpp"
#include "glsl/pass_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
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
    Linker(const scene::Scene& scene, const scene::Pass& pass, glsl::Precision precision,
           glsl::Specialise specialise)
        : scene_(scene), pass_(pass), reading_(scene, pass), precision_(precision), specialise_(specialise) {}

    /// The first dialect that links. Channels that nobody specified may be other than pictures: when every
    /// dialect fails, the driver's words tell which kinds are worth trying.
    Result<LinkedPass> link() {
        const std::vector<glsl::Dialect> dialects = reading_.dialects(precision_);
        if (auto linked = first_that_links(dialects))
            return *std::move(linked);
        if (unpromotable_)
            return fail(*std::move(unpromotable_));
        for (const glsl::ChannelKinds& kinds :
             glsl::channel_kinds_to_try(scene_, pass_, first_->source, first_->log)) {
            glsl::Dialect dialect = dialects.front();
            dialect.channels = kinds;
            if (auto linked = first_that_links({dialect}))
                return *std::move(linked);
        }
        return fail(error());
    }

private:
    /// The likeliest dialect's messages are the ones that mean something to the author.
    Error error() const {
        const bool promoted = precision_ != glsl::Precision::single;
        Error error{ErrorCode::load,
                    fmt::format("'{}' does not compile{}", scene_.file.string(),
                                promoted ? " in double precision" : ""),
                    {}};
        error.diagnostics = reading_.entry_point_problems();
        if (error.diagnostics.empty())
            error.diagnostics = glsl::parse_driver_log(first_->log, first_->source.lines());
        for (Diagnostic& diagnostic : error.diagnostics)
            if (diagnostic.where.file.empty())
                diagnostic.message = fmt::format("{}: {}", pass_.name, diagnostic.message);
        return error;
    }

    std::optional<LinkedPass> first_that_links(const std::vector<glsl::Dialect>& dialects) {
        for (const glsl::Dialect& dialect : dialects) {
            auto assembly = reading_.assemble(dialect);
            if (!assembly) {
                unpromotable_ = std::move(assembly.error());
                return std::nullopt;
            }
            const char* const vertex = glsl::vertex_shader(dialect.version);
            glsl::Specialised special = specialise(assembly->source);
            if (special.left_out.anything()) {
                auto program = gl::link_or_recall(vertex, special.source.text());
                if (program)
                    return LinkedPass{*std::move(program), dialect, std::move(assembly->hashes),
                                      std::move(special.left_out)};
                special.left_out = {.kept_whole = "the driver does not take the shorter text"};
            }
            auto program = gl::link_or_recall(vertex, assembly->source.text());
            if (program)
                return LinkedPass{*std::move(program), dialect, std::move(assembly->hashes),
                                  std::move(special.left_out)};
            if (!first_)
                first_ = Refusal{std::move(assembly->source), std::move(program.error())};
        }
        return std::nullopt;
    }

    /// Knobs and rounding are those of floats: a text of doubles loses what it cannot reach, and no more.
    glsl::Specialised specialise(const glsl::ShaderSource& source) const {
        const bool single = precision_ == glsl::Precision::single;
        return glsl::specialise(source, scene_.knobs,
                                single ? specialise_ : std::min(specialise_, glsl::Specialise::unreachable));
    }

    const scene::Scene& scene_;
    const scene::Pass& pass_;
    glsl::PassReading reading_; ///< once for all attempts
    glsl::Precision precision_;
    glsl::Specialise specialise_;
    std::optional<Refusal> first_;
    std::optional<Error> unpromotable_; ///< something in the text has no double form
};

} // namespace

Result<LinkedPass> link_pass(const scene::Scene& scene, const scene::Pass& pass, glsl::Precision precision,
                             glsl::Specialise specialise) {
    return Linker(scene, pass, precision, specialise).link();
}

} // namespace tidemark::render
