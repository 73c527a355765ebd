#include "render/renderer.hpp"

#include "base/doing.hpp"
#include "glsl/pass_reading.hpp"
#include "render/link_pass.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>

namespace tidemark::render {
namespace {

using image::Image;
using image::SampleType;
using scene::PassKind;

/// Directions at the corners (0,0) (1,0) (1,1) (0,1) of the faces +x -x +y -y +z -z.
constexpr double k_face_corners[6][12] = {
    {1, 1, 1, 1, 1, -1, 1, -1, -1, 1, -1, 1}, {-1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1},
    {-1, 1, -1, 1, 1, -1, 1, 1, 1, -1, 1, 1}, {-1, -1, 1, 1, -1, 1, 1, -1, -1, -1, -1, -1},
    {-1, 1, 1, 1, 1, 1, 1, -1, 1, -1, -1, 1}, {1, 1, -1, -1, 1, -1, -1, -1, -1, 1, -1, -1},
};

/// A text that takes a channel for a cube or a volume, where the scene says nothing, gets one.
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

GLenum type_of(SampleType samples) {
    return samples == SampleType::u8 ? GL_UNSIGNED_BYTE : GL_FLOAT;
}

/// Reading back, too: what was drawn is finished there.
constexpr std::string_view k_drawing = "drawing a frame";

Doing doing(std::string_view what, const scene::Scene& scene) {
    return Doing(fmt::format("{} of '{}'", what, scene.file.string()));
}

/// Which face of a cube a program draws.
void set_face(const gl::Program& program, int face) {
    if (const gl::Uniform* corners = program.reflection().find("tidemark_corners"))
        gl::set_uniform(program, *corners, k_face_corners[face]);
}

} // namespace

Result<Renderer> Renderer::create(scene::Scene scene, const RenderOptions& options) {
    Renderer renderer;
    renderer.scene_ = std::move(scene);
    renderer.samples_ = options.samples;
    renderer.extent_ = options.extent;
    renderer.precision_ = options.precision;
    renderer.extras_ = options.extras;
    renderer.specialise_ = options.specialise;
    renderer.tile_ = options.tile;
    renderer.marks_non_finite_ = options.marks_non_finite;
    GLuint vertex_array = 0;
    glCreateVertexArrays(1, &vertex_array);
    renderer.no_vertices_ = gl::VertexArrayHandle(vertex_array);
    if (auto chosen = renderer.choose_pass(options.pass); !chosen)
        return fail(std::move(chosen.error()));
    for (const auto step : {&Renderer::compile, &Renderer::make_targets, &Renderer::bind_channels})
        if (auto done = (renderer.*step)(); !done)
            return fail(std::move(done.error()));
    return renderer;
}

Result<void> Renderer::choose_pass(const std::string& name) {
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
    return fail(ErrorCode::usage, fmt::format("--pass {}: the scene has {}", name, fmt::join(names, ", ")));
}

/// The passes that the shown one may need, by what the scene says. What the others hold is not compiled.
std::vector<bool> Renderer::reachable() const {
    std::vector<bool> found(scene_.passes.size(), false);
    std::vector<size_t> open{shown_};
    for (size_t pass = 0; extras_.passes && pass < scene_.passes.size(); ++pass)
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

/// Its picture is for the eye alone, the last one that a frame makes, and keeps nothing for the next frame.
bool Renderer::can_be_tiled() const {
    const std::vector<bool> drawn = reachable();
    for (size_t i = 0; i < drawn.size(); ++i) {
        if (drawn[i] && (i > shown_ || reads(scene_.passes[i], shown_)))
            return false;
    }
    return scene_.passes[shown_].kind != PassKind::cubemap &&
           !glsl::PassReading(scene_, scene_.passes[shown_]).discards();
}

Result<void> Renderer::compile() {
    if (tile_ && !can_be_tiled())
        tile_.reset();
    passes_.resize(scene_.passes.size());
    std::vector<std::optional<gl::Reflection>> reflections(scene_.passes.size());
    std::vector<size_t> discarding;
    const std::vector<bool> wanted = reachable();
    const bool marks =
        marks_non_finite_ && format_of(shown_) == GL_RGBA8 &&
        std::ranges::none_of(scene_.passes, [&](const auto& pass) { return reads(pass, shown_); });
    for (size_t i = 0; i < scene_.passes.size(); ++i) {
        if (!wanted[i])
            continue;
        auto linked = link_pass(scene_, scene_.passes[i],
                                {precision_, specialise_, tile_ && i == shown_, marks && i == shown_});
        if (!linked)
            return fail(std::move(linked.error()));
        supply_other_kinds(scene_, i, linked->dialect.channels);
        passes_[i].dialect = linked->dialect;
        gl::Program& program = linked->program;
        reflections[i] = program.reflection();
        passes_[i].uniforms = UniformTable(program.reflection(), scene_.knobs, extras_.uniforms);
        passes_[i].program = std::move(program);
        passes_[i].hashes = std::move(linked->hashes);
        passes_[i].left_out = std::move(linked->left_out);
        passes_[i].discards = linked->discards;
        if (linked->discards)
            discarding.push_back(i);
    }
    plan_ = plan_frame(scene_, reflections, shown_, extras_, discarding);
    return {};
}

GLenum Renderer::format_of(size_t pass) const {
    return scene_.passes[pass].kind == PassKind::image && samples_ == SampleType::u8 ? GL_RGBA8 : GL_RGBA32F;
}

Result<PassTarget> Renderer::make_target(size_t pass) const {
    if (scene_.passes[pass].kind == PassKind::cubemap)
        return PassTarget::create_cube(plan_.targets[pass]);
    return PassTarget::create(tile_ && pass == shown_ ? *tile_ : extent_, format_of(pass),
                              plan_.targets[pass]);
}

Result<void> Renderer::make_targets() {
    targets_.resize(scene_.passes.size());
    for (const PlannedPass& planned : plan_.passes) {
        auto target = make_target(planned.pass);
        if (!target) {
            if (planned.pass != shown_ || !can_be_tiled())
                target.error().message += fmt::format(
                    "; {} cannot be drawn in tiles, because a pass reads it or it discards pixels",
                    scene_.passes[planned.pass].name);
            return fail(std::move(target.error()));
        }
        targets_[planned.pass] = *std::move(target);
    }
    return {};
}

Result<void> Renderer::bind_channels() {
    for (const PlannedPass& planned : plan_.passes) {
        CompiledPass& compiled = passes_[planned.pass];
        const auto add = [&](int unit, const scene::Channel& channel) -> Result<void> {
            auto bound = make_channel(*compiled.program, unit, channel, textures_);
            if (!bound)
                return fail(std::move(bound.error()));
            compiled.channels.push_back(*std::move(bound));
            return {};
        };
        for (const int number : planned.channels)
            if (auto added = add(number, scene_.passes[planned.pass].channels[size_t(number)]); !added)
                return added;
        if (planned.keyboard_helpers)
            if (auto added = add(k_keyboard_unit, {scene::Keyboard{4}, scene::k_keyboard_sampling, {}});
                !added)
                return added;
    }
    return {};
}

bool Renderer::has_own_size(size_t pass) const {
    return scene_.passes[pass].kind == PassKind::cubemap || (tile_ && pass == shown_);
}

Result<void> Renderer::resize(Extent extent) {
    if (extent == extent_)
        return {};
    std::vector<PassTarget> fresh(targets_.size());
    for (const PlannedPass& planned : plan_.passes) {
        if (has_own_size(planned.pass))
            continue;
        auto target = targets_[planned.pass].resized(extent);
        if (!target)
            return fail(std::move(target.error()));
        fresh[planned.pass] = *std::move(target);
    }
    for (const PlannedPass& planned : plan_.passes)
        if (!has_own_size(planned.pass))
            targets_[planned.pass] = std::move(fresh[planned.pass]);
    extent_ = extent;
    return {};
}

void Renderer::reset() {
    within_frame_ = false;
    for (const PlannedPass& planned : plan_.passes)
        targets_[planned.pass].clear();
}

void Renderer::continue_from(const Renderer& before) {
    for (const PlannedPass& planned : plan_.passes)
        for (const PlannedPass& known : before.plan_.passes) {
            const scene::Pass& pass = scene_.passes[planned.pass];
            const scene::Pass& old = before.scene_.passes[known.pass];
            PassTarget& target = targets_[planned.pass];
            const PassTarget& from = before.targets_[known.pass];
            if (pass.kind == old.kind && pass.name == old.name &&
                target.internal_format() == from.internal_format())
                target.continue_from(from);
        }
}

void Renderer::warm_up(const FrameInputs& inputs) {
    const Doing preparing = doing("preparing the first frame", scene_);
    // Nothing passes an empty scissor box, but the driver must have its code ready before it knows.
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, 0, 0);
    draw(inputs);
    if (tile_)
        draw_tile(inputs, {0, 0, *tile_});
    glFinish();
    glDisable(GL_SCISSOR_TEST);
    reset();
}

void Renderer::draw(const FrameInputs& inputs) {
    const Doing drawing = doing(k_drawing, scene_);
    assert(!within_frame_ || !plan_.feedback);
    draws_in_frame_ = 0;
    textures_.update(inputs);
    for (const PlannedPass& planned : plan_.passes)
        if (!tile_ || planned.pass != shown_)
            draw_pass(planned.pass, inputs);
}

std::optional<TileGrid> Renderer::tiles() const {
    return tile_ ? std::optional(TileGrid(extent_, *tile_)) : std::nullopt;
}

void Renderer::draw_tile(const FrameInputs& inputs, const Tile& tile) const {
    const Doing drawing = doing(k_drawing, scene_);
    const gl::Program& program = *passes_[shown_].program;
    const gl::RenderTarget& into = targets_[shown_].latest();
    const CompiledPass& pass = passes_[shown_];
    pass.uniforms.upload(program, uniforms_of(shown_, pass.uniforms, inputs, extent_));
    bind_textures(pass);
    if (const gl::Uniform* origin = program.reflection().find("tidemark_tile"))
        gl::set_uniform(program, *origin, std::array{double(tile.x), double(tile.y)});
    draw_face(program, into, tile.extent);
}

void Renderer::draw_tile(const FrameInputs& inputs, const Tile& tile, Image& band) const {
    const Doing drawing = doing(k_drawing, scene_);
    draw_tile(inputs, tile);
    const size_t pixel = 4 * image::size_of(samples_);
    gl::read_corner(targets_[shown_].latest(), tile.extent, GL_RGBA, type_of(samples_), band.extent.width,
                    band.bytes.data() + size_t(tile.x) * pixel);
}

ChannelFacts Renderer::facts_of(const CompiledPass& pass, PassKind kind, const FrameInputs& inputs) const {
    ChannelFacts facts;
    const scene::Channels& channels = scene_.passes[size_t(&pass - passes_.data())].channels;
    for (const BoundChannel& channel : pass.channels) {
        const auto* texture = std::get_if<ChannelTextures::Index>(&channel.source);
        if (channel.unit == k_keyboard_unit || !texture)
            continue;
        ChannelFact& fact = facts[size_t(channel.unit)];
        fact = textures_.fact(*texture, inputs);
        // A quirk of the site that shaders may rely on.
        if (kind == PassKind::cubemap &&
            traits_of(channels[size_t(channel.unit)].input).changes == scene::Changes::with_keys)
            fact.resolution = {};
    }
    for (size_t i = 0; i < channels.size(); ++i) // drawn or not
        if (const size_t* source = source_pass(channels[i].input)) {
            const bool cube = scene_.passes[*source].kind == PassKind::cubemap;
            const Extent size = cube ? Extent{k_cube_side, k_cube_side} : extent_;
            facts[i] = {{double(size.width), double(size.height), 1}, 0, true};
        }
    return facts;
}

const gl::Texture& Renderer::texture_of(const BoundChannel& channel) const {
    const auto* output = std::get_if<scene::PassOutput>(&channel.source);
    return output ? targets_[output->pass].latest().texture
                  : textures_.texture(std::get<ChannelTextures::Index>(channel.source));
}

void Renderer::advance_to(size_t pass, const FrameInputs& inputs) {
    within_frame_ = true;
    textures_.update(inputs);
    for (const PlannedPass& planned : plan_.passes) {
        if (planned.pass == pass)
            return;
        draw_pass(planned.pass, inputs);
    }
}

Edition Renderer::edition_of(const BoundChannel& channel) const {
    const auto* output = std::get_if<scene::PassOutput>(&channel.source);
    return output ? targets_[output->pass].edition()
                  : textures_.edition(std::get<ChannelTextures::Index>(channel.source));
}

UniformValues Renderer::uniforms_of(size_t index, const UniformTable& table, const FrameInputs& inputs,
                                    Extent extent) const {
    const ChannelFacts facts = facts_of(passes_[index], scene_.passes[index].kind, inputs);
    return table.values(inputs, extent, facts, scene_.knobs);
}

void Renderer::bind_textures(const CompiledPass& pass) const {
    for (const BoundChannel& channel : pass.channels)
        render::bind(channel, texture_of(channel));
}

bool Renderer::follows_clock() const {
    return textures_.follow_clock() || std::ranges::any_of(plan_.passes, [&](const PlannedPass& planned) {
               return passes_[planned.pass].uniforms.follows_clock();
           });
}

void Renderer::draw_pass(size_t index, const FrameInputs& inputs) {
    CompiledPass& pass = passes_[index];
    PassTarget& target = targets_[index];
    const gl::RenderTarget& into = target.next();
    PassInputs reads{uniforms_of(index, pass.uniforms, inputs, into.extent()), {}};
    for (const BoundChannel& channel : pass.channels)
        reads.channels.push_back(edition_of(channel));
    if (pass.discards && &into != &target.latest()) // else what is discarded stays as it is shown
        reads.channels.push_back(target.edition());
    if (!extras_.unchanged && pass.drawn.holds(reads, target.edition()))
        return;
    pass.uniforms.upload(*pass.program, reads.uniforms);
    bind_textures(pass);
    if (scene_.passes[index].kind != PassKind::cubemap) {
        draw_face(*pass.program, into, into.extent());
    } else {
        for (int face = 0; face < 6; ++face) {
            gl::select_face(into, face);
            set_face(*pass.program, face);
            draw_face(*pass.program, into, into.extent());
        }
    }
    target.flip();
    pass.drawn.drew(std::move(reads), target.edition());
    ++passes_drawn_;
    draws_in_frame_ += scene_.passes[index].kind == PassKind::cubemap ? 6 : 1;
}

void Renderer::draw_stand_in(size_t index, const gl::Program& program, const FrameInputs& inputs,
                             const gl::RenderTarget& into, int face) const {
    for (const BoundChannel& channel : passes_[index].channels)
        point_samplers(program, channel.unit);
    set_face(program, face);
    const UniformTable table(program.reflection(), scene_.knobs);
    table.upload(program, uniforms_of(index, table, inputs, targets_[index].latest().extent()));
    bind_textures(passes_[index]);
    draw_face(program, into, into.extent());
}

/// The target's bottom left corner, as far as `extent` reaches.
void Renderer::draw_face(const gl::Program& program, const gl::RenderTarget& into, Extent extent) const {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, into.framebuffer.id());
    glViewport(0, 0, extent.width, extent.height);
    glDisable(GL_DITHER);
    glUseProgram(program.id());
    glBindVertexArray(no_vertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

FrameWork Renderer::work() const {
    FrameWork work{draws_in_frame_, 0, 0, textures_.bytes(), 0};
    for (const PlannedPass& planned : plan_.passes) {
        work.uniforms += passes_[planned.pass].uniforms.size();
        work.channels += passes_[planned.pass].channels.size();
        work.texture_bytes += targets_[planned.pass].bytes();
        work.lines_removed += size_t(passes_[planned.pass].left_out.lines);
    }
    return work;
}

Image Renderer::read_back(size_t pass) const {
    const Doing drawing = doing(k_drawing, scene_);
    const gl::RenderTarget& target = targets_[pass].latest();
    Image image(target.extent(), 4, samples_);
    gl::read_pixels(target, GL_RGBA, type_of(samples_), image.bytes);
    return image;
}

Image Renderer::read_floats(size_t pass, int face) const {
    const Doing drawing = doing(k_drawing, scene_);
    const gl::RenderTarget& from = targets_[pass].latest();
    if (scene_.passes[pass].kind == PassKind::cubemap)
        gl::select_face(from, face);
    Image image(from.extent(), 4, SampleType::f32);
    gl::read_pixels(from, GL_RGBA, GL_FLOAT, image.bytes);
    return image;
}

std::array<Image, 6> Renderer::read_back_cube() const {
    std::array<Image, 6> faces;
    for (int face = 0; face < 6; ++face) {
        gl::select_face(target(), face);
        faces[size_t(face)] = read_back();
    }
    return faces;
}

} // namespace tidemark::render
