#include "lab/instrumented_pass.hpp"

#include "base/error.hpp"
#include "render/gl_context.hpp"
#include "shader/shader_source.hpp"
#include "shader/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace tidemark::lab {

ShaderWords::ShaderWords(size_t count) : count_(count) {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    buffer_ = gl::BufferHandle(id);
    const std::vector<uint32_t> zeros(count);
    glNamedBufferStorage(id, GLsizeiptr(count * sizeof(uint32_t)), zeros.data(), 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, glsl::k_watch_binding, id);
}

std::vector<uint32_t> ShaderWords::read() const {
    std::vector<uint32_t> words(count_);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer_.id(), 0, GLsizeiptr(count_ * sizeof(uint32_t)), words.data());
    return words;
}

Result<StandIn> StandIn::link(const PassPreview& preview, const std::string& text, std::string_view what,
                              std::optional<Extent> extent) {
    const auto version = preview.dialect().version;
    auto program = gl::Program::link(glsl::vertex_shader(version), text);
    if (!program)
        return fail(ErrorCode::load,
                    fmt::format("the driver refuses {}: {}", what, program.error().substr(0, 400)));
    auto target = gl::make_render_target(gl::make_texture(extent.value_or(preview.extent()), GL_RGBA32F, 1));
    if (!target)
        return fail(ErrorCode::load, fmt::format("the driver has no memory for the picture of {}", what));
    return StandIn(*std::move(program), *std::move(target));
}

void StandIn::set(const std::string& name, double value) {
    if (const gl::Uniform* uniform = program_.reflection().find(name))
        gl::set_uniform(program_, *uniform, std::span(&value, 1));
}

void StandIn::draw(const PassPreview& preview, int face) const {
    gl::clear(target_); // pixels that this draw discards would keep an earlier draw's values
    preview.draw(program_, target_, face);
}

void StandIn::draw_own(const PassPreview& preview) const {
    gl::clear(target_);
    preview.draw(preview.program(), target_);
}

image::Image StandIn::picture() const {
    image::Image image(target_.extent(), 4, image::SampleType::f32);
    gl::read_pixels(target_, GL_RGBA, GL_FLOAT, image.bytes);
    return image;
}

namespace {

struct Drawn {
    StandIn stand_in;
    std::vector<uint32_t> words;
};

Result<Drawn> draw(const PassPreview& preview, const glsl::Watch& watch, size_t words, int face) {
    auto stand_in = TRY(StandIn::link(preview, watch.text, "the instrumented text"));
    const ShaderWords buffer(words);
    stand_in.draw(preview, face);
    return Drawn{std::move(stand_in), buffer.read()};
}

} // namespace

bool is_finite(const PixelBits& bits) {
    return std::none_of(bits.begin(), bits.end(),
                        [](uint32_t word) { return (word & 0x7f800000u) == 0x7f800000u; });
}

PixelBits bits_at(const image::Image& image, PixelPlace pixel) {
    PixelBits bits{};
    const size_t index = size_t(pixel.y) * size_t(image.extent.width) + size_t(pixel.x);
    std::memcpy(bits.data(), image.bytes.data() + index * sizeof bits, sizeof bits);
    return bits;
}

Result<std::unique_ptr<const glsl::ParsedText>> read_text(const render::Renderer& renderer, size_t pass,
                                                          bool as_written) {
    return read_text(renderer.scene(), renderer.scene().passes[pass], renderer.dialect(pass), as_written);
}

Result<std::unique_ptr<const glsl::ParsedText>> read_text(const scene::Scene& scene, const scene::Pass& pass,
                                                          glsl::Dialect dialect, bool as_written) {
    dialect.initialise = dialect.initialise && !as_written;
    const bool es = dialect.version == glsl::Version::es_300;
    const std::vector<std::string> extensions = gl::query_extensions();
    std::vector<glsl::KnownMacro> known{{"__VERSION__", es                                           ? 300
                                                        : dialect.version == glsl::Version::core_450 ? 450
                                                                                                     : 330},
                                        {"GL_FRAGMENT_PRECISION_HIGH", 1},
                                        {es ? "GL_ES" : "GL_core_profile", 1}};
    for (const std::string& name : extensions)
        known.push_back({name, 1});
    return glsl::ParsedText::read(glsl::assemble(scene, pass, dialect), known);
}

Result<WatchReading> read_pixel(const PassPreview& preview, const glsl::Watch& watch, PixelPlace pixel) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(pixel.x, pixel.y, 1, 1);
    auto drawn = draw(preview, watch, glsl::WatchLayout::k_words, pixel.face);
    glDisable(GL_SCISSOR_TEST);
    if (!drawn)
        return fail(std::move(drawn.error()));
    WatchReading reading;
    reading.words = std::move(drawn->words);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn->stand_in.target().framebuffer.id());
    glReadPixels(pixel.x, pixel.y, 1, 1, GL_RGBA, GL_FLOAT, reading.colour.data());
    return reading;
}

Result<std::vector<glsl::NodeId>> read_map(const PassPreview& preview, const glsl::Watch& watch, int face) {
    auto drawn = TRY(draw(preview, watch, preview.extent().pixels(), face));
    return std::move(drawn.words);
}

} // namespace tidemark::lab
