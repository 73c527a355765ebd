#include "render/compiled_scene.hpp"

#include "base/supervision.hpp"
#include "render/channel_textures.hpp"
#include "render/gl_context.hpp"
#include "shader/driver_log.hpp"
#include "shader/pass_reading.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

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
        std::vector<glsl::Dialect> dialects = reading_.dialects(options_.precision);
        if (gl::is_es()) {
            if (options_.precision != glsl::Precision::single)
                return fail(ErrorCode::usage, "OpenGL ES has no double precision; use OpenGL 4.5");
            for (glsl::Dialect each : std::exchange(dialects, {})) {
                each.version = glsl::Version::es_300;
                if (std::ranges::find(dialects, each) == dialects.end())
                    dialects.push_back(each);
            }
        }
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
                special.left_out = {.kept_whole = "the driver rejects the shorter text"};
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

using image::SampleType;
using scene::PassKind;

/// Supplies a cube or a volume to channels that the text samples as such and the scene leaves unspecified.
void supply_other_kinds(scene::Scene& scene, size_t pass, const glsl::ChannelKinds& kinds) {
    for (size_t i = 0; i < kinds.size(); ++i) {
        scene::Channel& channel = scene.passes[pass].channels[i];
        if (kinds[i] == texture_kind(scene, channel.input))
            continue;
        if (kinds[i] == scene::TextureKind::cube)
            channel = {
                scene::StandIn{scene::StandIn::Kind::cubemap, 256, 256, 4}, scene::k_cubemap_sampling, {}};
        else
            channel.input = scene::Noise{scene::NoiseKind::rgba_volume_32};
    }
}

bool reads(const scene::Pass& reader, size_t pass) {
    return std::ranges::any_of(reader.channels, [&](const scene::Channel& channel) {
        const size_t* source = source_pass(channel.input);
        return source && *source == pass;
    });
}

} // namespace

Result<LinkedPass> link_pass(const scene::Scene& scene, const scene::Pass& pass, const LinkOptions& options) {
    const Doing doing(fmt::format("compiling {} of '{}'", pass.name, scene.file.string()));
    return Linker(scene, pass, options).link();
}

Result<CompiledScene> CompiledScene::create(scene::Scene scene, const RenderOptions& options) {
    CompiledScene compiled(std::move(scene), options);
    for (const auto step : {&CompiledScene::choose_pass, &CompiledScene::compile})
        TRY((compiled.*step)());
    return compiled;
}

Result<void> CompiledScene::choose_pass() {
    const std::string& name = options_.pass;
    shown_ = scene_.image_index();
    if (name.empty())
        return {};
    std::vector<std::string> names;
    for (size_t i = 0; i < scene_.passes.size(); ++i) {
        if (scene_.passes[i].kind == PassKind::sound)
            continue;
        if (scene_.passes[i].name == name) {
            shown_ = i;
            return {};
        }
        names.push_back(scene_.passes[i].name);
    }
    return fail(ErrorCode::usage,
                fmt::format("--pass {}: no such pass; the scene has {}", name, fmt::join(names, ", ")));
}

/// Finds the passes that the shown one may need according to the scene; only these are compiled.
std::vector<bool> CompiledScene::reachable() const {
    std::vector<bool> found(scene_.passes.size(), false);
    std::vector<size_t> open{shown_};
    for (size_t pass = 0; options_.extras.passes && pass < scene_.passes.size(); ++pass)
        if (scene_.passes[pass].kind != PassKind::sound)
            open.push_back(pass);
    while (!open.empty()) {
        const size_t pass = open.back();
        open.pop_back();
        if (found[pass])
            continue;
        found[pass] = true;
        for (const scene::Channel& channel : scene_.passes[pass].channels)
            if (const size_t* source = source_pass(channel.input))
                open.push_back(*source);
    }
    return found;
}

/// A pass can be tiled if it is the last of a frame, no pass reads it, and it keeps nothing for the next
/// frame.
bool CompiledScene::can_be_tiled() const {
    const std::vector<bool> drawn = reachable();
    for (size_t i = 0; i < drawn.size(); ++i) {
        if (drawn[i] && (i > shown_ || reads(scene_.passes[i], shown_)))
            return false;
    }
    return scene_.passes[shown_].kind != PassKind::cubemap &&
           !glsl::PassReading(scene_, scene_.passes[shown_]).discards();
}

Result<void> CompiledScene::compile() {
    if (options_.tile && !can_be_tiled())
        options_.tile.reset();
    passes_.resize(scene_.passes.size());
    std::vector<std::optional<gl::Reflection>> reflections(scene_.passes.size());
    std::vector<size_t> discarding;
    const std::vector<bool> wanted = reachable();
    const bool marks =
        options_.marks_non_finite && format_of(shown_) == GL_RGBA8 &&
        std::ranges::none_of(scene_.passes, [&](const auto& pass) { return reads(pass, shown_); });
    for (size_t i = 0; i < scene_.passes.size(); ++i) {
        if (!wanted[i])
            continue;
        auto linked = TRY(link_pass(scene_, scene_.passes[i],
                                    {options_.precision, options_.specialise, options_.tile && i == shown_,
                                     marks && i == shown_, options_.keeps_alpha}));
        supply_other_kinds(scene_, i, linked.dialect.channels);
        reflections[i] = linked.program.reflection();
        if (linked.discards)
            discarding.push_back(i);
        UniformTable uniforms(linked.program.reflection(), names_of(i, linked.dialect),
                              options_.extras.uniforms);
        passes_[i] = CompiledPass{std::move(linked), std::move(uniforms)};
    }
    plan_ = plan_frame(scene_, reflections, shown_, options_.extras, discarding);
    return {};
}

/// Accepts the uniform names of other hosts for a file outside of a project or with its own `main`.
UniformTable::Names CompiledScene::names_of(size_t pass, const glsl::Dialect& dialect) const {
    return {scene_.knobs, scene_.passes[pass].bare_file || dialect.main == glsl::MainPlace::author};
}

GLenum CompiledScene::format_of(size_t pass) const {
    const scene::Pass& drawn = scene_.passes[pass];
    const bool bytes =
        drawn.stores_bytes || (drawn.kind == PassKind::image && options_.samples == SampleType::u8);
    return bytes ? GL_RGBA8 : GL_RGBA32F;
}

namespace {

/// Accepts any numeric type that an author declares, but a matrix only for a matrix, and never a sampler.
bool can_hold(GLenum type, const scene::HostUniform& row) {
    if (row.type == "mat4")
        return type == GL_FLOAT_MAT4 || type == GL_DOUBLE_MAT4;
    return gl::is_number(type);
}

} // namespace

UniformTable::UniformTable(const gl::Reflection& reflection, const Names& names, bool absent_too) {
    const std::vector<scene::Knob>& knobs = names.knobs;
    for (const gl::Uniform& uniform : reflection.uniforms) {
        const auto knob = std::ranges::find(knobs, uniform.name, &scene::Knob::name);
        const scene::HostUniform* row = scene::find_host_uniform(uniform.name, names.other_hosts);
        if (knob != knobs.end())
            entries_.push_back({uniform, Source::knob, size_t(knob - knobs.begin())});
        else if (row && row->image && can_hold(uniform.type, *row))
            entries_.push_back({uniform, Source::host, size_t(row->value)});
        for (size_t i = 0; i < size_t(scene::k_channel_count); ++i)
            if (const auto source = struct_member(uniform.name, i))
                entries_.push_back({uniform, *source, i});
    }
    if (!absent_too)
        return;
    const auto absent = [&](std::string_view name, GLenum type, Source source, size_t index) {
        if (!name.empty() && !reflection.has(name)) // GL ignores values for location -1
            entries_.push_back({{std::string(name), type, 1, -1}, source, index});
    };
    for (const scene::HostUniform& row : scene::k_host_uniforms) {
        const GLenum type = row.type == "mat4" ? GL_FLOAT_MAT4 : GL_FLOAT_VEC4;
        if (row.image)
            absent(row.name, type, Source::host, size_t(row.value));
        for (const std::string_view other : row.other_names)
            if (names.other_hosts)
                absent(other, type, Source::host, size_t(row.value));
    }
    for (size_t i = 0; i < knobs.size(); ++i)
        absent(knobs[i].name, GL_FLOAT_VEC4, Source::knob, i);
}

std::optional<UniformTable::Source> UniformTable::struct_member(std::string_view name, size_t channel) {
    std::string_view member;
    for (const std::string& structure :
         {fmt::format("iCh{}.", channel), fmt::format("iChannel[{}].", channel)})
        if (name.starts_with(structure))
            member = name.substr(structure.size());
    if (member == "size" || member == "resolution")
        return Source::struct_size;
    if (member == "time")
        return Source::struct_time;
    if (member == "loaded")
        return Source::struct_loaded;
    return std::nullopt;
}

UniformNumbers UniformTable::host_value(const Entry& entry, const FrameInputs& inputs, Extent resolution,
                                        const ChannelFacts& channels) {
    // In a scene promoted to double iTime is exact.
    if (entry.row().value == scene::HostValue::time_low && entry.uniform.type == GL_DOUBLE)
        return {0};
    return value_of(entry.row().value, inputs, resolution, channels);
}

UniformValues UniformTable::values(const FrameInputs& inputs, Extent resolution, const ChannelFacts& channels,
                                   const std::vector<scene::Knob>& knobs) const {
    const auto numbers_of = [&](const Entry& entry) -> UniformNumbers {
        switch (entry.source) {
        case Source::host: return host_value(entry, inputs, resolution, channels);
        case Source::struct_size: return UniformNumbers(channels[entry.index].resolution);
        case Source::struct_time: return {channels[entry.index].time};
        case Source::struct_loaded: return {channels[entry.index].loaded ? 1.0 : 0.0};
        case Source::knob: return UniformNumbers(value_after(knobs[entry.index], inputs.knobs));
        }
        return {};
    };
    UniformValues values;
    values.reserve(entries_.size());
    for (const Entry& entry : entries_) // uniforms that the program lacks must not cause a redraw
        values.push_back(entry.uniform.location < 0 ? UniformNumbers{0} : numbers_of(entry));
    return values;
}

void UniformTable::upload(const gl::Program& program, const UniformValues& values) const {
    hand_over(values, [&](const gl::Uniform& uniform, std::span<const double> all, size_t width) {
        gl::set_uniform(program, uniform, all, width);
    });
}

void UniformTable::hand_over(const UniformValues& values, const Take& take) const {
    // Element width as ShaderToy declares the array, whatever the author declares.
    const auto width_of = [](const Entry& entry, size_t all) -> size_t {
        const bool is_array = entry.source == Source::host && entry.row().length > 0;
        return is_array ? component_count(entry.row()) : all;
    };
    for (size_t i = 0; i < entries_.size(); ++i) {
        const std::span<const double> all = values[i];
        take(entries_[i].uniform, all, width_of(entries_[i], all.size()));
    }
}

bool UniformTable::follows_clock() const {
    return std::any_of(entries_.begin(), entries_.end(), [](const Entry& entry) {
        if (entry.uniform.location < 0)
            return false;
        return entry.source == Source::host ? entry.row().follows == scene::Follows::clock
                                            : entry.source == Source::struct_time;
    });
}

} // namespace tidemark::render
