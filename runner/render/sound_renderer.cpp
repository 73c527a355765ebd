#include "render/sound_renderer.hpp"

#include "glsl/assemble.hpp"
#include "render/link_pass.hpp"
#include "sound/sound_texels.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>

namespace tidemark::render {

int SoundRenderer::block_samples() {
    return glsl::k_sound_tile * glsl::k_sound_tile;
}

Result<SoundRenderer> SoundRenderer::create(const scene::Scene& scene) {
    const scene::Pass* pass = scene.find(scene::PassKind::sound);
    if (!pass)
        return fail(ErrorCode::usage, fmt::format("'{}' has no Sound pass", scene.file.string()));
    auto linked = link_pass(scene, *pass);
    if (!linked)
        return fail(std::move(linked.error()));
    auto target =
        gl::make_render_target(gl::make_texture({glsl::k_sound_tile, glsl::k_sound_tile}, GL_RGBA8, 1));
    if (!target)
        return fail(ErrorCode::load, "this driver has no memory for a block of sound");
    SoundRenderer renderer;
    renderer.program_ = std::move(linked->program);
    renderer.target_ = *std::move(target);
    GLuint vertex_array = 0;
    glCreateVertexArrays(1, &vertex_array);
    renderer.no_vertices_ = gl::VertexArrayHandle(vertex_array);
    for (int number = 0; number < scene::k_channel_count; ++number) {
        if (!renderer.program_.reflection().has(fmt::format("iChannel{}", number)))
            continue;
        scene::Channel channel = pass->channels[size_t(number)];
        if (std::holds_alternative<scene::PassOutput>(channel.input)) // pictures are not there to be heard
            channel.input = scene::Unbound{texture_kind(scene, channel.input)};
        auto bound = make_channel(renderer.program_, number, channel, renderer.textures_);
        if (!bound)
            return fail(std::move(bound.error()));
        renderer.channels_.push_back(*std::move(bound));
    }
    return renderer;
}

std::vector<int16_t> SoundRenderer::draw(int first, const Date& date) {
    const auto set = [&](std::string_view name, std::initializer_list<double> values) {
        if (const gl::Uniform* uniform = program_.reflection().find(name))
            gl::set_uniform(program_, *uniform, {values.begin(), values.size()});
    };
    set("iTimeOffset", {first / k_sample_rate});
    set("iSampleOffset", {double(first)});
    set("iSampleRate", {k_sample_rate});
    // Without milliseconds, as on the site.
    set("iDate", {double(date.year), double(date.month), double(date.day), std::floor(date.seconds)});
    for (const BoundChannel& channel : channels_)
        bind(channel, textures_.texture(std::get<ChannelTextures::Index>(channel.source)));
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target_.framebuffer.id());
    glViewport(0, 0, glsl::k_sound_tile, glsl::k_sound_tile);
    glUseProgram(program_.id());
    glBindVertexArray(no_vertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    std::vector<uint8_t> texels(size_t(block_samples()) * 4);
    gl::read_pixels(target_, GL_RGBA, GL_UNSIGNED_BYTE, std::as_writable_bytes(std::span(texels)));
    return sound::decode_sound_texels(texels);
}

} // namespace tidemark::render
