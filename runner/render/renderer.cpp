#include "render/renderer.hpp"

#include "gl/capabilities.hpp"
#include "glsl/assemble.hpp"
#include "glsl/driver_log.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::render {
namespace {

using image::SampleType;

Result<gl::RenderTarget> make_target(Extent extent, SampleType samples) {
    const int limit = gl::query_capabilities().largest_target;
    if (std::max(extent.width, extent.height) > limit)
        return fail(ErrorCode::usage,
                    fmt::format("--size {}x{}: this driver draws at most {} pixels on a side", extent.width,
                                extent.height, limit));
    auto target = gl::make_render_target(extent, samples == SampleType::u8 ? GL_RGBA8 : GL_RGBA32F);
    if (!target)
        return fail(
            ErrorCode::usage,
            fmt::format("--size {}x{}: this driver has no memory for such a picture; give a smaller one",
                        extent.width, extent.height));
    return *std::move(target);
}

/// The driver's words about one pass. Its first error leads, so that a title bar can show it.
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

Result<Renderer> Renderer::create(scene::Scene scene, const RenderOptions& options) {
    Renderer renderer;
    renderer.scene_ = std::move(scene);
    renderer.samples_ = options.samples;
    GLuint vertex_array = 0;
    glCreateVertexArrays(1, &vertex_array);
    renderer.no_vertices_ = gl::VertexArrayHandle(vertex_array);
    if (auto resized = renderer.resize(options.extent); !resized)
        return fail(std::move(resized.error()));
    if (auto compiled = renderer.compile(); !compiled)
        return fail(std::move(compiled.error()));
    if (auto bound = renderer.bind_channels(); !bound)
        return fail(std::move(bound.error()));
    return renderer;
}

Result<void> Renderer::compile() {
    std::vector<gl::Reflection> reflections;
    for (const scene::Pass& pass : scene_.passes) {
        const glsl::ShaderSource source = glsl::assemble(scene_, pass);
        auto program = gl::Program::link(glsl::k_vertex_shader, source.text());
        if (!program)
            return fail(compile_error(pass, scene_, program.error(), source.lines()));
        reflections.push_back(program->reflection());
        UniformTable uniforms(program->reflection(), scene_.knobs);
        passes_.push_back({*std::move(program), std::move(uniforms), {}, {}});
    }
    plan_ = plan_frame(scene_, reflections);
    return {};
}

Result<void> Renderer::measure_channels(const scene::Pass& pass, CompiledPass& compiled) {
    for (size_t number = 0; number < pass.channels.size(); ++number) {
        const auto size = textures_.size_of(pass.channels[number]);
        if (!size)
            return fail(size.error());
        compiled.channel_sizes[number] = *size;
    }
    return {};
}

Result<void> Renderer::bind_channels() {
    for (const PlannedPass& planned : plan_.passes) {
        CompiledPass& compiled = passes_[planned.pass];
        if (compiled.program.reflection().has("iChannelResolution"))
            if (auto measured = measure_channels(scene_.passes[planned.pass], compiled); !measured)
                return measured;
        for (const int number : planned.channels) {
            const scene::Channel& channel = scene_.passes[planned.pass].channels[size_t(number)];
            const auto texture = textures_.require(channel);
            if (!texture)
                return fail(texture.error());
            compiled.channels.push_back({number, *texture, make_sampler(channel.sampling)});
            if (!std::holds_alternative<scene::Unbound>(channel.input))
                compiled.channel_sizes[size_t(number)] = textures_[*texture].extent;
            const gl::Uniform* sampler =
                compiled.program.reflection().find(fmt::format("iChannel{}", number));
            const double unit[] = {double(number)};
            gl::set_uniform(compiled.program, *sampler, unit);
        }
    }
    return {};
}

Result<void> Renderer::resize(Extent extent) {
    auto target = make_target(extent, samples_);
    if (!target)
        return fail(std::move(target.error()));
    target_ = *std::move(target);
    return {};
}

void Renderer::draw(const FrameInputs& inputs) {
    for (const PlannedPass& planned : plan_.passes)
        draw_pass(passes_[planned.pass], inputs);
}

void Renderer::draw_pass(const CompiledPass& pass, const FrameInputs& inputs) const {
    pass.uniforms.upload(pass.program, inputs, extent(), pass.channel_sizes, scene_.knobs);
    for (const BoundChannel& channel : pass.channels) {
        glBindTextureUnit(GLuint(channel.unit), textures_[channel.texture].id());
        glBindSampler(GLuint(channel.unit), channel.sampler.id());
    }
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target_.framebuffer.id());
    glViewport(0, 0, extent().width, extent().height);
    glDisable(GL_DITHER);
    glUseProgram(pass.program.id());
    glBindVertexArray(no_vertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

image::Image Renderer::read_back() const {
    image::Image image(extent(), 4, samples_);
    gl::read_pixels(target_, GL_RGBA, samples_ == SampleType::u8 ? GL_UNSIGNED_BYTE : GL_FLOAT, image.bytes);
    return image;
}

} // namespace tidemark::render
