#include "lab/instrumented_pass.hpp"

#include "base/error.hpp"
#include "lab/device_check.hpp"
#include "lab/probe_bench.hpp"
#include "lab/probe_inputs.hpp"
#include "render/gl_context.hpp"
#include "shader/loops.hpp"
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

Result<image::Image> draw_own(const PassPreview& preview, Extent extent) {
    const auto target = gl::make_render_target(gl::make_texture(extent, GL_RGBA32F, 1));
    if (!target)
        return fail(ErrorCode::no_memory, "the driver has no memory for a picture");
    preview.draw(preview.program(), *target);
    image::Image picture(extent, 4, image::SampleType::f32);
    gl::read_pixels(*target, GL_RGBA, GL_FLOAT, picture.bytes);
    return picture;
}

Result<VariedPictures> draw_varied(const PassPreview& preview, const glsl::Variation& varied,
                                   std::span<const glsl::VariationMode> modes) {
    auto stand_in = TRY(StandIn::link(preview, varied.text, "a variation of the text"));
    const auto drawn = [&](int mode) {
        stand_in.set(varied.mode_uniform, mode);
        stand_in.draw(preview);
        return stand_in.picture();
    };
    VariedPictures pictures;
    for (const glsl::VariationMode& mode : modes)
        pictures.others.push_back(drawn(mode.number));
    if (varied.mode_uniform.empty())
        stand_in.draw_own(preview);
    pictures.plain = varied.mode_uniform.empty() ? stand_in.picture() : drawn(0);
    return pictures;
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

namespace {

bool may_exceed(const scene::Scene& scene, const scene::Pass& pass, const glsl::Dialect& dialect) {
    const auto text = read_text(scene, pass, dialect, false);
    return !text || glsl::most_iterations(**text, glsl::find_facts(**text)) > k_safe_iterations;
}

constexpr int k_columns = 6, k_rows = 4, k_block = 8;

/// Calls `draw` for each block of the sample, with everything else cut off.
template <class Draw>
void for_each_block(Extent extent, Draw draw) {
    glEnable(GL_SCISSOR_TEST);
    for (int row = 0; row < k_rows; ++row)
        for (int column = 0; column < k_columns; ++column) {
            const auto first = [](int at, int count, int size) {
                return std::clamp((2 * at + 1) * size / (2 * count) - k_block / 2, 0,
                                  std::max(size - k_block, 0));
            };
            glScissor(first(column, k_columns, extent.width), first(row, k_rows, extent.height), k_block,
                      k_block);
            draw();
        }
    glDisable(GL_SCISSOR_TEST);
}

} // namespace

bool may_exceed_safe_iterations(const scene::Scene& scene, const render::Renderer& like) {
    return std::ranges::any_of(like.plan().passes, [&](const render::PlannedPass& planned) {
        return may_exceed(scene, scene.passes[planned.pass], like.dialect(planned.pass));
    });
}

bool may_exceed_safe_iterations(const render::Renderer& renderer) {
    return may_exceed_safe_iterations(renderer.scene(), renderer);
}

Result<std::optional<double>> loop_limit() {
    static std::optional<std::optional<double>> known; // a process draws with one device
    if (known)
        return *known;
    const double most = 2 * k_safe_iterations;
    const Sample counted = TRY(counted_loop(int(most)));
    known = counted[0] < most ? std::optional<double>(counted[0]) : std::nullopt;
    return *known;
}

Result<std::vector<LoopEnd>> loop_ends(const PassPreview& preview, bool sampled) {
    const auto text = TRY(read_text(preview.scene(), preview.pass(), preview.dialect(), false));
    const glsl::LoopEnds ends = glsl::record_loop_ends(*text, glsl::find_facts(*text));
    std::vector<LoopEnd> found;
    if (ends.loops.empty())
        return found;
    const auto stand_in = TRY(StandIn::link(preview, ends.text, "the text that records its loops"));
    const ShaderWords buffer(ends.words());
    const int faces = preview.pass().kind == scene::PassKind::cubemap ? 6 : 1;
    for (int face = 0; face < faces; ++face)
        if (sampled)
            for_each_block(preview.extent(), [&] { stand_in.draw(preview, face); });
        else
            stand_in.draw(preview, face);
    const std::vector<uint32_t> words = buffer.read();
    for (size_t i = 0; i < ends.loops.size(); ++i)
        found.push_back({text->spelled(text->tree()[ends.loops[i]].begin),
                         glsl::words_of(*text, ends.loops[i]), words[glsl::LoopEnds::cut(i)] != 0,
                         words[glsl::LoopEnds::counted_out(i)] != 0});
    return found;
}

Result<std::vector<SourceLocation>> cut_loops(render::Renderer& renderer, const render::FrameInputs& inputs,
                                              bool sampled) {
    std::vector<SourceLocation> cut;
    for (const render::PlannedPass& planned : renderer.plan().passes) {
        if (!may_exceed(renderer.scene(), renderer.scene().passes[planned.pass],
                        renderer.dialect(planned.pass)))
            continue;
        const PassPreview preview(renderer, planned.pass, inputs);
        for (LoopEnd& end : TRY(loop_ends(preview, sampled)))
            if (end.cut)
                cut.push_back(std::move(end.where));
    }
    return cut;
}

Result<Answer> ask_loop_ends(ProbeBench& bench) {
    const render::Renderer* const renderer = TRY(bench.compiled());
    if (!may_exceed_safe_iterations(*renderer))
        return Answer{Verdict::pass, fmt::format("the loops' heads allow a pixel at most {:.0f} iterations",
                                                 k_safe_iterations)};
    const auto limit = TRY(loop_limit());
    if (!limit)
        return Answer{Verdict::pass, "this driver lets loops run to their end"};
    const FrameState state = plain_state();
    std::vector<SourceLocation> cut;
    for (const render::PlannedPass& planned : renderer->plan().passes) {
        const auto preview = TRY(bench.preview(state, planned.pass));
        for (LoopEnd& end : TRY(loop_ends(preview, true)))
            if (end.cut)
                cut.push_back(std::move(end.where));
    }
    if (cut.empty())
        return Answer{Verdict::pass, "this driver ends no loop before it is done, in 1536 pixels"};
    Answer answer{Verdict::fail, to_string(cut, *limit) + ": other devices go on", state};
    for (SourceLocation& where : cut)
        add_place(answer, std::move(where));
    return answer;
}

std::string to_string(const std::vector<SourceLocation>& cut, double limit) {
    const std::string others =
        cut.size() > 1 ? fmt::format(" (and {} other{})", cut.size() - 1, cut.size() > 2 ? "s" : "") : "";
    return fmt::format(
        "the driver ends a pixel's loops after {:.0f} iterations together: the loop at {}:{}{} is cut", limit,
        cut.front().file, cut.front().line, others);
}

} // namespace tidemark::lab
