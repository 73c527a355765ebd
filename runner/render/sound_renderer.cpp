#include "render/sound_renderer.hpp"

#include "base/overloaded.hpp"
#include "base/supervision.hpp"
#include "media/sound_file.hpp"
#include "render/compiled_scene.hpp"
#include "render/frame_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace tidemark::render {

namespace {

/// Returns whether a Sound pass gets the input: on ShaderToy only inputs that never change, pictures and
/// volumes.
bool is_heard(const scene::ChannelInput& input) {
    return traits_of(input).changes == scene::Changes::never;
}

} // namespace

int SoundRenderer::samples_in(int rows) {
    return glsl::k_sound_tile * rows;
}

int SoundRenderer::block_samples() {
    return samples_in(glsl::k_sound_tile);
}

Result<SoundRenderer> SoundRenderer::create(const scene::Scene& scene, const Date& date,
                                            glsl::Precision precision) {
    const scene::Pass* pass = scene.find(scene::PassKind::sound);
    if (!pass)
        return fail(ErrorCode::usage, fmt::format("'{}' has no Sound pass", scene.file.string()));
    auto linked = TRY(link_pass(scene, *pass, {.precision = precision}));
    auto target =
        gl::make_render_target(gl::make_texture({glsl::k_sound_tile, glsl::k_sound_tile}, GL_RGBA8, 1));
    if (!target)
        return fail(ErrorCode::load, "this driver has no memory for a block of sound");
    SoundRenderer renderer;
    renderer.program_ = std::move(linked.program);
    renderer.target_ = *std::move(target);
    renderer.knobs_ = scene.knobs;
    renderer.inputs_.date = date;
    renderer.inputs_.date.seconds = std::floor(date.seconds);
    renderer.uniforms_ = UniformTable(renderer.program_.reflection(), {scene.knobs});
    renderer.no_vertices_ = gl::make_vertex_array();
    for (int number = 0; number < scene::k_channel_count; ++number) {
        scene::Channel channel = pass->channels[size_t(number)];
        if (!is_heard(channel.input))
            channel.input = scene::Unbound{texture_kind(scene, channel.input)};
        if (!needs_texture(channel.input, number, renderer.program_.reflection()))
            continue;
        renderer.channels_.push_back(
            TRY(make_channel(renderer.program_, number, channel, renderer.textures_)));
    }
    return renderer;
}

ChannelFacts SoundRenderer::facts() const {
    ChannelFacts facts;
    for (const BoundChannel& channel : channels_)
        facts[size_t(channel.unit)] =
            textures_.fact(std::get<ChannelTextures::Index>(channel.source), inputs_);
    return facts;
}

std::vector<int16_t> SoundRenderer::draw(int first) {
    return draw_rows(first, glsl::k_sound_tile);
}

std::vector<int16_t> SoundRenderer::draw_rows(int first, int rows) {
    const Doing drawing("drawing a block of the Sound pass");
    const int block = first - first % block_samples();
    const int row = (first - block) / glsl::k_sound_tile;
    uniforms_.upload(program_, uniforms_.values(inputs_, target_.extent(), facts(), knobs_));
    const auto set = [&](std::string_view name, double value) {
        if (const gl::Uniform* uniform = program_.reflection().find(name))
            gl::set_uniform(program_, *uniform, {&value, 1});
    };
    set("iTimeOffset", block / k_sample_rate);
    set("iSampleOffset", block);
    for (const BoundChannel& channel : channels_)
        bind(channel, textures_.texture(std::get<ChannelTextures::Index>(channel.source)));
    glBindFramebuffer(GL_FRAMEBUFFER, target_.framebuffer.id());
    glViewport(0, 0, glsl::k_sound_tile, glsl::k_sound_tile);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, row, glsl::k_sound_tile, rows);
    glUseProgram(program_.id());
    glBindVertexArray(no_vertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
    std::vector<uint8_t> texels(size_t(samples_in(rows)) * 4);
    glReadPixels(0, row, glsl::k_sound_tile, rows, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
    return sound::decode_sound_texels(texels);
}

std::vector<HeardChannel> heard_channels(const scene::Scene& scene) {
    std::vector<HeardChannel> heard;
    const auto add = [&](const scene::Pass& pass, size_t number, const std::filesystem::path& file,
                         bool video) {
        if (file.empty() || std::ranges::find(heard, file, &HeardChannel::file) != heard.end())
            return;
        const std::string name = fmt::format("iChannel{} {}", number, file.filename().string());
        heard.push_back({pass.kind == scene::PassKind::image ? name : pass.name + ' ' + name, file, video});
    };
    for (const scene::Pass& pass : scene.passes)
        for (size_t i = 0; pass.kind != scene::PassKind::sound && i < pass.channels.size(); ++i)
            std::visit(Overloaded{[&](const scene::Music& music) { add(pass, i, music.file, false); },
                                  [&](const scene::Video& video) { add(pass, i, video.file, true); },
                                  [](const auto&) {}},
                       pass.channels[i].input);
    return heard;
}

Result<std::optional<sound::InputSound>> read_sound_of(const HeardChannel& channel) {
    if (channel.video)
        return sound::read_video_sound(channel.file);
    return std::optional(TRY(sound::read_music(channel.file)));
}

} // namespace tidemark::render
