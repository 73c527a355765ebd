#include "render/renderer.hpp"

#include "base/supervision.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::render {
namespace {

using image::Image;
using image::SampleType;

/// Directions at the corners (0,0) (1,0) (1,1) (0,1) of the faces +x -x +y -y +z -z.
constexpr double k_face_corners[6][12] = {
    {1, 1, 1, 1, 1, -1, 1, -1, -1, 1, -1, 1}, {-1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1},
    {-1, 1, -1, 1, 1, -1, 1, 1, 1, -1, 1, 1}, {-1, -1, 1, 1, -1, 1, 1, -1, -1, -1, -1, -1},
    {-1, 1, 1, 1, 1, 1, 1, -1, 1, -1, -1, 1}, {1, 1, -1, -1, 1, -1, -1, -1, -1, 1, -1, -1},
};

GLenum type_of(SampleType samples) {
    return samples == SampleType::u8 ? GL_UNSIGNED_BYTE : GL_FLOAT;
}

/// Also covers read-back, which waits for the drawing.
constexpr std::string_view k_drawing = "drawing a frame";

Doing doing(std::string_view what, const scene::Scene& scene) {
    return Doing(fmt::format("{} of '{}'", what, scene.file.string()));
}

/// Selects the face of a cube that a program draws.
void set_face(const gl::Program& program, int face) {
    if (const gl::Uniform* corners = program.reflection().find("tidemark_corners"))
        gl::set_uniform(program, *corners, k_face_corners[face]);
}

} // namespace

Renderer::Renderer(CompiledScene compiled)
    : compiled_(std::move(compiled)), extent_(compiled_.options().extent),
      no_vertices_(gl::make_vertex_array()), passes_(scene().passes.size()) {}

Result<Renderer> Renderer::create(scene::Scene scene, const RenderOptions& options) {
    auto compiled = TRY(CompiledScene::create(std::move(scene), options));
    Renderer renderer(std::move(compiled));
    for (const auto step : {&Renderer::make_targets, &Renderer::bind_channels})
        TRY((renderer.*step)());
    return renderer;
}

Result<PassTarget> Renderer::make_target(size_t pass) const {
    if (is_cube(pass))
        return PassTarget::create_cube(plan().targets[pass]);
    return PassTarget::create(is_tiled(pass) ? *compiled_.options().tile : extent_, compiled_.format_of(pass),
                              plan().targets[pass]);
}

Result<void> Renderer::make_targets() {
    for (const PlannedPass& planned : plan().passes) {
        auto target = make_target(planned.pass);
        if (!target) {
            if (planned.pass != compiled_.shown() || !compiled_.can_be_tiled())
                target.error().message += fmt::format(
                    "; {} cannot be drawn in tiles, because a pass reads it or it discards pixels",
                    scene().passes[planned.pass].name);
            return fail(std::move(target.error()));
        }
        passes_[planned.pass].target = *std::move(target);
    }
    return {};
}

Result<void> Renderer::bind_channels() {
    for (const PlannedPass& planned : plan().passes) {
        const auto add = [&](int unit, const scene::Channel& channel) -> Result<void> {
            passes_[planned.pass].channels.push_back(
                TRY(make_channel(program(planned.pass), unit, channel, textures_)));
            return {};
        };
        for (const int number : planned.channels)
            TRY(add(number, scene().passes[planned.pass].channels[size_t(number)]));
        if (planned.keyboard_helpers)
            TRY(add(k_keyboard_unit, {scene::Keyboard{4}, scene::k_keyboard_sampling, {}}));
    }
    return {};
}

bool Renderer::has_own_size(size_t pass) const {
    return is_cube(pass) || is_tiled(pass);
}

Result<void> Renderer::resize(Extent extent) {
    if (extent == extent_)
        return {};
    std::vector<PassTarget> fresh(passes_.size());
    for (const PlannedPass& planned : plan().passes) {
        if (has_own_size(planned.pass))
            continue;
        fresh[planned.pass] = TRY(passes_[planned.pass].target.resized(extent));
    }
    for (const PlannedPass& planned : plan().passes)
        if (!has_own_size(planned.pass))
            passes_[planned.pass].target = std::move(fresh[planned.pass]);
    extent_ = extent;
    ++changes_;
    return {};
}

void Renderer::reset() {
    ++changes_;
    for (const PlannedPass& planned : plan().passes)
        passes_[planned.pass].target.clear();
}

BufferState Renderer::buffer_state() const {
    BufferState state;
    for (const PlannedPass& planned : plan().passes)
        if (plan().targets[planned.pass].carried > 0)
            state.push_back({scene().passes[planned.pass].name, passes_[planned.pass].target.carried()});
    return state;
}

bool Renderer::restore(const BufferState& state) {
    std::vector<PassTarget*> targets;
    for (const PlannedPass& planned : plan().passes) {
        if (plan().targets[planned.pass].carried == 0)
            continue;
        PassTarget& target = passes_[planned.pass].target;
        if (targets.size() >= state.size() ||
            state[targets.size()].pass != scene().passes[planned.pass].name ||
            !target.can_restore(state[targets.size()].textures))
            return false;
        targets.push_back(&target);
    }
    if (targets.size() != state.size())
        return false;
    ++changes_;
    for (size_t i = 0; i < targets.size(); ++i)
        targets[i]->restore(state[i].textures);
    return true;
}

void Renderer::continue_from(const Renderer& before) {
    ++changes_;
    for (const PlannedPass& planned : plan().passes)
        for (const PlannedPass& known : before.plan().passes) {
            const scene::Pass& pass = scene().passes[planned.pass];
            const scene::Pass& old = before.scene().passes[known.pass];
            PassTarget& target = passes_[planned.pass].target;
            const PassTarget& from = before.passes_[known.pass].target;
            if (pass.kind == old.kind && pass.name == old.name &&
                target.internal_format() == from.internal_format())
                target.continue_from(from);
        }
}

void Renderer::warm_up(const FrameInputs& inputs) {
    const Doing preparing = doing("preparing the first frame", scene());
    // An empty scissor box rejects every pixel, but the driver must first compile its code.
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, 0, 0);
    draw(inputs);
    if (const auto& tile = compiled_.options().tile)
        draw_tile(inputs, {0, 0, *tile}, {});
    glFinish();
    glDisable(GL_SCISSOR_TEST);
    reset();
}

void Renderer::draw(const FrameInputs& inputs, std::vector<PassTimer>* timers) {
    const Doing drawing = doing(k_drawing, scene());
    draws_in_frame_ = 0;
    ++changes_;
    textures_.update(inputs);
    for (const PlannedPass& planned : plan().passes) {
        if (is_tiled(planned.pass))
            continue;
        std::optional<gl::ElapsedTime> timer;
        if (timers)
            timer.emplace();
        const size_t drawn_before = passes_drawn_;
        draw_pass(planned.pass, inputs);
        if (timer)
            timer->stop();
        if (timer && passes_drawn_ != drawn_before)
            timers->push_back({planned.pass, *std::move(timer)});
    }
}

std::optional<TileGrid> Renderer::tiles() const {
    const auto& tile = compiled_.options().tile;
    return tile ? std::optional(TileGrid(extent_, *tile)) : std::nullopt;
}

/// Prepares uniforms and textures of the shown pass; returns its program.
const gl::Program& Renderer::prepare_shown(const FrameInputs& inputs) const {
    const size_t shown = compiled_.shown();
    const auto& [linked, uniforms] = compiled_[shown];
    uniforms.upload(linked.program, uniforms_of(shown, uniforms, inputs, extent_));
    bind_textures(shown);
    return linked.program;
}

void Renderer::draw_tile(const FrameInputs& inputs, const Tile& tile, glm::dvec2 offset) const {
    const Doing drawing = doing(k_drawing, scene());
    const gl::Program& program = prepare_shown(inputs);
    if (const gl::Uniform* origin = program.reflection().find("tidemark_tile"))
        gl::set_uniform(program, *origin, std::array{tile.x + offset.x, tile.y + offset.y});
    draw_face(program, target(), tile.extent);
}

void Renderer::draw_again(const FrameInputs& inputs, const gl::RenderTarget& into) const {
    const Doing drawing = doing(k_drawing, scene());
    draw_face(prepare_shown(inputs), into, into.extent());
}

void Renderer::draw_tile(const FrameInputs& inputs, const Tile& tile, Image& band, glm::dvec2 offset) const {
    const Doing drawing = doing(k_drawing, scene());
    draw_tile(inputs, tile, offset);
    const size_t pixel = 4 * image::size_of(samples());
    gl::read_corner(target(), tile.extent, GL_RGBA, type_of(samples()), band.extent.width,
                    band.bytes.data() + size_t(tile.x) * pixel);
}

ChannelFacts Renderer::facts_of(size_t pass, const FrameInputs& inputs) const {
    ChannelFacts facts;
    const scene::Channels& channels = scene().passes[pass].channels;
    for (const BoundChannel& channel : passes_[pass].channels) {
        const auto* texture = std::get_if<ChannelTextures::Index>(&channel.source);
        if (channel.unit == k_keyboard_unit || !texture)
            continue;
        ChannelFact& fact = facts[size_t(channel.unit)];
        fact = textures_.fact(*texture, inputs);
        // ShaderToy reports no size for the keyboard in a cubemap pass; shaders may rely on it.
        if (is_cube(pass) &&
            traits_of(channels[size_t(channel.unit)].input).changes == scene::Changes::with_keys)
            fact.resolution = {};
    }
    for (size_t i = 0; i < channels.size(); ++i) // even if the pass is not drawn
        if (const size_t* source = source_pass(channels[i].input)) {
            const Extent size = is_cube(*source) ? Extent{k_cube_side, k_cube_side} : extent_;
            facts[i] = {{double(size.width), double(size.height), 1}, 0, true};
        }
    return facts;
}

const gl::Texture& Renderer::texture_of(const BoundChannel& channel) const {
    const auto* output = std::get_if<scene::PassOutput>(&channel.source);
    return output ? passes_[output->pass].target.latest().texture
                  : textures_.texture(std::get<ChannelTextures::Index>(channel.source));
}

const gl::Texture* Renderer::texture_at(size_t pass, int unit) const {
    const auto& channels = passes_[pass].channels;
    const auto found = std::ranges::find(channels, unit, &BoundChannel::unit);
    return found == channels.end() ? nullptr : &texture_of(*found);
}

/// Draws the passes before that one.
void Renderer::draw_before(size_t pass, const FrameInputs& inputs) {
    ++changes_;
    textures_.update(inputs);
    for (const PlannedPass& planned : plan().passes) {
        if (planned.pass == pass)
            return;
        draw_pass(planned.pass, inputs);
    }
}

Generation Renderer::edition_of(const BoundChannel& channel) const {
    const auto* output = std::get_if<scene::PassOutput>(&channel.source);
    return output ? passes_[output->pass].target.generation()
                  : textures_.generation(std::get<ChannelTextures::Index>(channel.source));
}

UniformValues Renderer::uniforms_of(size_t pass, const UniformTable& table, const FrameInputs& inputs,
                                    Extent extent) const {
    return table.values(inputs, extent, facts_of(pass, inputs), scene().knobs);
}

void Renderer::bind_textures(size_t pass) const {
    for (const BoundChannel& channel : passes_[pass].channels)
        render::bind(channel, texture_of(channel));
}

bool Renderer::follows_clock() const {
    return textures_.follow_clock() || std::ranges::any_of(plan().passes, [&](const PlannedPass& planned) {
               return compiled_[planned.pass].uniforms.follows_clock();
           });
}

/// Returns the inputs to draw the pass from; nothing if its target already holds the result.
std::optional<PassInputs> Renderer::changed_inputs(size_t index, const FrameInputs& inputs) const {
    const auto& [linked, uniforms] = compiled_[index];
    const DrawnPass& pass = passes_[index];
    const gl::RenderTarget& into = pass.target.next();
    PassInputs reads{uniforms_of(index, uniforms, inputs, into.extent()), {}};
    for (const BoundChannel& channel : pass.channels)
        reads.channels.push_back(edition_of(channel));
    if (linked.discards && &into != &pass.target.latest()) // discard keeps older pixels
        reads.channels.push_back(pass.target.generation());
    if (!compiled_.options().extras.unchanged && pass.drawn.holds(reads, pass.target.generation()))
        return std::nullopt;
    return reads;
}

/// Uploads the uniforms of a pass and binds its textures.
void Renderer::prepare(size_t index, const UniformValues& uniforms) const {
    compiled_[index].uniforms.upload(compiled_[index].linked.program, uniforms);
    bind_textures(index);
}

/// Draws a face of a prepared pass, within the scissor box.
void Renderer::draw_face(size_t index, int face, const gl::RenderTarget& into) const {
    if (is_cube(index))
        gl::select_face(into, face);
    set_face(program(index), face);
    draw_face(program(index), into, into.extent());
}

void Renderer::draw_pass(size_t index, const FrameInputs& inputs) {
    auto reads = changed_inputs(index, inputs);
    if (!reads)
        return;
    DrawnPass& pass = passes_[index];
    prepare(index, reads->uniforms);
    for (int face = 0; face < faces_of(index); ++face)
        draw_face(index, face, pass.target.next());
    pass.target.flip();
    pass.drawn.drew(*std::move(reads), pass.target.generation());
    ++passes_drawn_;
    draws_in_frame_ += size_t(faces_of(index));
}

void Renderer::draw_substitute(size_t pass, const gl::Program& program, const FrameInputs& inputs,
                               const gl::RenderTarget& into, int face) const {
    for (const BoundChannel& channel : passes_[pass].channels)
        point_samplers(program, channel.unit);
    set_face(program, face);
    const UniformTable table(program.reflection(), names_of(pass));
    table.upload(program, uniforms_of(pass, table, inputs, passes_[pass].target.latest().extent()));
    bind_textures(pass);
    draw_face(program, into, into.extent());
}

/// Draws into the bottom left corner of the target, of size `extent`.
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
    for (const PlannedPass& planned : plan().passes) {
        work.uniforms += compiled_[planned.pass].uniforms.size();
        work.channels += passes_[planned.pass].channels.size();
        work.texture_bytes += passes_[planned.pass].target.bytes();
        work.lines_removed += size_t(left_out(planned.pass).lines);
    }
    return work;
}

Image Renderer::read_back(size_t pass) const {
    const Doing drawing = doing(k_drawing, scene());
    const gl::RenderTarget& target = passes_[pass].target.latest();
    Image image(target.extent(), 4, samples());
    gl::read_pixels(target, GL_RGBA, type_of(samples()), image.bytes);
    return image;
}

bool Renderer::read_ahead(gl::PixelRing& ring) const {
    const Doing drawing = doing(k_drawing, scene());
    const Extent extent = target().extent();
    return ring.read(target(), extent, GL_RGBA, type_of(samples()),
                     extent.pixels() * 4 * image::size_of(samples()));
}

Image Renderer::take(gl::PixelRing& ring) const {
    const Doing drawing = doing(k_drawing, scene());
    const auto pixels = ring.take();
    return {target().extent(), 4, samples(), {pixels.begin(), pixels.end()}};
}

Image Renderer::read_floats(size_t pass, int face) const {
    const Doing drawing = doing(k_drawing, scene());
    const gl::RenderTarget& from = passes_[pass].target.latest();
    if (is_cube(pass))
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
