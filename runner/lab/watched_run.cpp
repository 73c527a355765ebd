#include "lab/watched_run.hpp"

#include "gl/capabilities.hpp"
#include "gl/program.hpp"
#include "glsl/assemble.hpp"
#include "render/pass_target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace tidemark::lab {
namespace {

/// A buffer of zeros that the shader writes into.
gl::BufferHandle make_buffer(size_t words) {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    gl::BufferHandle buffer(id);
    const std::vector<uint32_t> zeros(words);
    glNamedBufferStorage(id, GLsizeiptr(words * sizeof(uint32_t)), zeros.data(), 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, glsl::k_watch_binding, id);
    return buffer;
}

std::vector<uint32_t> read_buffer(const gl::BufferHandle& buffer, size_t words) {
    std::vector<uint32_t> values(words);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer.id(), 0, GLsizeiptr(words * sizeof(uint32_t)), values.data());
    return values;
}

struct Drawn {
    gl::RenderTarget target;
    std::vector<uint32_t> words;
};

Result<Drawn> draw(const Moment& moment, const glsl::Watch& watch, size_t words, int face) {
    const auto version = moment.renderer.dialect(moment.pass).version;
    const auto program = gl::Program::link(glsl::vertex_shader(version), watch.text);
    if (!program)
        return fail(ErrorCode::load,
                    fmt::format("the driver refuses the watched text: {}", program.error().substr(0, 400)));
    auto target = gl::make_render_target(gl::make_texture(extent_of(moment), GL_RGBA32F, 1));
    if (!target)
        return fail(ErrorCode::load, "the driver has no memory for a watched picture");
    const gl::BufferHandle buffer = make_buffer(words);
    moment.renderer.draw_stand_in(moment.pass, *program, moment.inputs, *target, face);
    return Drawn{*std::move(target), read_buffer(buffer, words)};
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

Extent extent_of(const Moment& moment) {
    const bool cube = moment.renderer.scene().passes[moment.pass].kind == scene::PassKind::cubemap;
    return cube ? Extent{render::k_cube_side, render::k_cube_side} : moment.renderer.extent();
}

Result<std::unique_ptr<const glsl::ParsedText>> read_text(const render::Renderer& renderer, size_t pass) {
    const glsl::Dialect& dialect = renderer.dialect(pass);
    const bool es = dialect.version == glsl::Version::es_300;
    const std::vector<std::string> extensions = gl::query_extensions();
    std::vector<glsl::KnownMacro> known{{"__VERSION__", es                                           ? 300
                                                        : dialect.version == glsl::Version::core_450 ? 450
                                                                                                     : 330},
                                        {"GL_FRAGMENT_PRECISION_HIGH", 1},
                                        {es ? "GL_ES" : "GL_core_profile", 1}};
    for (const std::string& name : extensions)
        known.push_back({name, 1});
    return glsl::ParsedText::read(glsl::assemble(renderer.scene(), renderer.scene().passes[pass], dialect),
                                  known);
}

Result<WatchReading> read_pixel(const Moment& moment, const glsl::Watch& watch, PixelPlace pixel) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(pixel.x, pixel.y, 1, 1);
    auto drawn = draw(moment, watch, glsl::WatchLayout::k_words, pixel.face);
    glDisable(GL_SCISSOR_TEST);
    if (!drawn)
        return fail(std::move(drawn.error()));
    WatchReading reading;
    reading.words = std::move(drawn->words);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn->target.framebuffer.id());
    glReadPixels(pixel.x, pixel.y, 1, 1, GL_RGBA, GL_FLOAT, reading.colour.data());
    return reading;
}

Result<std::vector<glsl::NodeId>> read_map(const Moment& moment, const glsl::Watch& watch, int face) {
    auto drawn = draw(moment, watch, extent_of(moment).pixels(), face);
    if (!drawn)
        return fail(std::move(drawn.error()));
    return std::move(drawn->words);
}

} // namespace tidemark::lab
