#include "render/link_pass.hpp"

#include "base/doing.hpp"
#include "gl/program_cache.hpp"
#include "glsl/assemble.hpp"
#include "glsl/driver_log.hpp"
#include "glsl/pass_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace tidemark::render {
namespace {

/// A rejected source and the driver's log.
struct Refusal {
    glsl::ShaderSource source;
    std::string log;
};

/// Returns the name that a message quotes, as in 'main' or `sdf(vec3)'; empty: none.
std::string_view named_in(std::string_view message) {
    const size_t quote = message.find_first_of("`'");
    if (quote == message.npos)
        return {};
    message.remove_prefix(quote + 1);
    return message.substr(0, std::min(message.find_first_of("'("), message.size()));
}

class Linker {
public:
    Linker(const scene::Scene& scene, const scene::Pass& pass, const LinkOptions& options)
        : scene_(scene), pass_(pass), reading_(scene, pass), options_(options) {}

    /// Links the first dialect that the driver accepts. If all fail, unspecified channels may be other than
    /// 2-D textures; the driver's log then shows which kinds are worth trying.
    Result<LinkedPass> link() {
        if (reading_.may_be_drawn_wrong())
            return fail(error());
        const std::vector<glsl::Dialect> dialects = reading_.dialects(options_.precision);
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
    /// Builds the error from the messages of the likeliest dialect, because they are the most useful to the
    /// author.
    Error error() const {
        const bool promoted = options_.precision != glsl::Precision::single;
        Error error{ErrorCode::load,
                    fmt::format("'{}' does not compile{}", scene_.file.string(),
                                promoted ? " in double precision" : ""),
                    {}};
        error.diagnostics = reading_.problems();
        if (error.diagnostics.empty())
            error.diagnostics = glsl::for_people(glsl::parse_driver_log(first_->log, first_->source));
        for (Diagnostic& diagnostic : error.diagnostics) {
            if (diagnostic.where.file.empty())
                diagnostic.where = reading_.place_of(named_in(diagnostic.message)).value_or(SourceLocation());
            if (diagnostic.where.file.empty())
                diagnostic.message = fmt::format("{}: {}", pass_.name, diagnostic.message);
        }
        return error;
    }

    std::optional<LinkedPass> first_that_links(const std::vector<glsl::Dialect>& dialects) {
        for (glsl::Dialect dialect : dialects) {
            dialect.tiled = options_.tiled;
            dialect.marks_non_finite = options_.marks_non_finite;
            dialect.keeps_alpha = options_.keeps_alpha;
            auto assembly = reading_.assemble(dialect);
            if (!assembly) {
                unpromotable_ = std::move(assembly.error());
                return std::nullopt;
            }
            glsl::Specialised special = specialise(assembly->source);
            if (special.left_out.anything()) {
                if (auto program = link(dialect, special.source))
                    return LinkedPass{*std::move(program), dialect, std::move(assembly->hashes),
                                      std::move(special.left_out), reading_.discards()};
                special.left_out = {.kept_whole = "the driver does not take the shorter text"};
            }
            auto program = link(dialect, assembly->source);
            if (program)
                return LinkedPass{*std::move(program), dialect, std::move(assembly->hashes),
                                  std::move(special.left_out), reading_.discards()};
            if (!first_)
                first_ = Refusal{std::move(assembly->source), std::move(program.error())};
        }
        return std::nullopt;
    }

    static tl::expected<gl::Program, std::string> link(const glsl::Dialect& dialect,
                                                       const glsl::ShaderSource& source) {
        return gl::link_or_recall(glsl::vertex_shader(dialect.version), source.text());
    }

    /// Specialises a text. Knob folding and its rounding assume floats: of a text in doubles only unreachable
    /// code is removed.
    glsl::Specialised specialise(const glsl::ShaderSource& source) const {
        const bool single = options_.precision == glsl::Precision::single;
        return glsl::specialise(source, scene_.knobs,
                                single ? options_.specialise
                                       : std::min(options_.specialise, glsl::Specialise::unreachable));
    }

    const scene::Scene& scene_;
    const scene::Pass& pass_;
    glsl::PassReading reading_; ///< shared by all attempts
    LinkOptions options_;
    std::optional<Refusal> first_;
    std::optional<Error> unpromotable_; ///< set if a construct has no double form
};

} // namespace

Result<LinkedPass> link_pass(const scene::Scene& scene, const scene::Pass& pass, const LinkOptions& options) {
    const Doing doing(fmt::format("compiling {} of '{}'", pass.name, scene.file.string()));
    return Linker(scene, pass, options).link();
}

} // namespace tidemark::render
