#include "lab/trace/watched_run.hpp"

#include "base/try.hpp"
#include "gl/capabilities.hpp"
#include "glsl/assemble.hpp"
#include "lab/trace/shader_words.hpp"

#include <algorithm>
#include <cstring>

namespace tidemark::lab {
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
