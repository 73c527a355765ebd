#include "lab/pass_function.hpp"

#include "base/error.hpp"
#include "base/measurement.hpp"
#include "shader/driver_log.hpp"
#include "shader/shader_source.hpp"
#include "shader/uniform_expressions.hpp"

#include <GL/glcorearb.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace tidemark::lab {
namespace {

using proof::Scalar;
using proof::Variable;

/// Returns the GL type of a scalar, a vector or a 4 x 4 matrix, the types of the host's uniforms; else
/// GL_NONE.
GLenum gl_type(const Variable& variable) {
    if (variable.columns == 4 && variable.rows == 4)
        return GL_FLOAT_MAT4;
    static constexpr std::array k_reals{GL_FLOAT, GL_FLOAT_VEC2, GL_FLOAT_VEC3, GL_FLOAT_VEC4};
    static constexpr std::array k_ints{GL_INT, GL_INT_VEC2, GL_INT_VEC3, GL_INT_VEC4};
    const size_t size = variable.rows - 1;
    if (variable.columns != 1 || size >= k_reals.size())
        return GL_NONE;
    return GLenum(variable.type == Scalar::real ? k_reals[size] : k_ints[size]);
}

/// Locations are indices into the function's list of variables.
gl::Reflection uniforms_of(const proof::Function& function) {
    gl::Reflection reflection;
    for (size_t i = 0; i < function.variables.size(); ++i)
        if (const Variable& variable = function.variables[i]; variable.kind == Variable::Kind::uniform)
            reflection.uniforms.push_back(
                {variable.name, gl_type(variable), int(std::max(1u, variable.length)), GLint(i)});
    return reflection;
}

template <class Real>
void store(proof::PointEvaluator<Real>& evaluator, const Variable& variable, uint32_t index, double value) {
    if (index < variable.size)
        evaluator.memory()[variable.first + index] = variable.type == Scalar::real
                                                         ? proof::Point<Real>{Real(value), 0}
                                                         : proof::Point<Real>{0, uint32_t(int64_t(value))};
}

/// Macros of glslang that scenes test.
constexpr glsl::KnownMacro k_macros[] = {
    {"__VERSION__", 450}, {"GL_FRAGMENT_PRECISION_HIGH", 1}, {"GL_core_profile", 1}};

/// Returns glslang's first error, with the author's file and line instead of `0:LINE: `.
std::string first_error(const std::string& log, const text::LineMap& lines) {
    const size_t begin = log.find("ERROR: 0:");
    if (begin == std::string::npos)
        return log.substr(0, log.find('\n'));
    const char* number = log.data() + begin + 9;
    int line = 0;
    const auto read = std::from_chars(number, log.data() + log.size(), line);
    const std::string message(read.ptr, log.data() + std::min(log.find('\n', begin), log.size()));
    return to_string(Diagnostic{lines.locate(line), Severity::error,
                                message.substr(std::min(message.find_first_not_of(": "), message.size()))});
}

} // namespace

Result<PassFunction> PassFunction::create(const scene::Scene& scene, const scene::Pass& pass,
                                          proof::Names names) {
    const glsl::ShaderSource source = glsl::assemble(scene, pass);
    if (!glsl::driver_load(source).modest())
        return fail(ErrorCode::load, "its text is too large to analyse");
    std::string text = source.text();
    if (names == proof::Names::keep)
        text = glsl::assign_globals_in_main(*TRY(glsl::ParsedText::read(source, k_macros, false)));
    auto function = proof::compile(text, names);
    if (!function)
        return fail(ErrorCode::load, first_error(function.error().message, source.lines()));
    PassFunction result;
    result.function_ = *std::move(function);
    result.loops_ = proof::find_marching_loops(result.function_);
    for (const proof::MarchingLoop& loop : result.loops_)
        result.slices_.push_back(proof::slice_of(result.function_, loop));
    result.lines_ = source.lines();
    return result;
}

template <class Real>
proof::PointEvaluator<Real> PassFunction::frame(const render::Renderer& renderer, size_t pass,
                                                const render::FrameInputs& inputs) const {
    proof::PointEvaluator<Real> evaluator(function_);
    const render::UniformTable table(uniforms_of(function_), renderer.names_of(pass));
    table.hand_over(renderer.uniforms_of(pass, table, inputs, renderer.extent()),
                    [&](const gl::Uniform& uniform, std::span<const double> values, size_t) {
                        const Variable& variable = function_.variables[size_t(uniform.location)];
                        for (uint32_t i = 0; i < values.size(); ++i)
                            store(evaluator, variable, i, values[i]);
                    });
    return evaluator;
}
template proof::PointEvaluator<float> PassFunction::frame(const render::Renderer&, size_t,
                                                          const render::FrameInputs&) const;
template proof::PointEvaluator<double> PassFunction::frame(const render::Renderer&, size_t,
                                                           const render::FrameInputs&) const;

template <class Real>
void PassFunction::move_to(proof::PointEvaluator<Real>& frame, glm::ivec2 at) const {
    if (const Variable* place = function_.find("gl_FragCoord"))
        for (const auto& [i, value] : {std::pair{0u, at.x + 0.5}, {1u, at.y + 0.5}, {2u, 0.5}, {3u, 1.0}})
            store(frame, *place, i, value);
}
template void PassFunction::move_to(proof::PointEvaluator<float>&, glm::ivec2) const;
template void PassFunction::move_to(proof::PointEvaluator<double>&, glm::ivec2) const;

namespace {

using proof::Texels;

/// Limit for the base level. A texture of 4096 x 4096 exceeds it.
constexpr size_t k_most_texels = 8'000'000;

Texels::Kind kind_of(const gl::Texture& texture) {
    switch (texture.target) {
    case GL_TEXTURE_3D: return Texels::Kind::volume;
    case GL_TEXTURE_CUBE_MAP: return Texels::Kind::cube;
    default: return Texels::Kind::plane;
    }
}

Texels texels_of(const gl::Texture& texture, const scene::Sampling& sampling) {
    Texels texels;
    texels.kind = kind_of(texture);
    texels.wrap = Texels::Wrap(sampling.wrap);
    texels.mipmaps = Texels::Mipmaps(sampling.mipmaps);
    texels.magnify_linear = sampling.magnify == scene::Filter::linear;
    texels.minify_linear = sampling.minify == scene::Filter::linear;
    const int levels = sampling.mipmaps == scene::Mipmaps::none ? 1 : texture.levels;
    for (int level = 0; level < levels; ++level) {
        const auto [width, height, layers] = gl::level_size(texture, level);
        texels.levels.push_back({{width, height, layers}, gl::read_level(texture, level)});
    }
    return texels;
}

std::shared_ptr<const Texels> black() {
    Texels texels;
    texels.levels.push_back({{1, 1, 1}, {0, 0, 0, 1}});
    return std::make_shared<const Texels>(std::move(texels));
}

} // namespace

proof::TextureSet textures_of(const render::Renderer& renderer, size_t pass) {
    proof::TextureSet textures;
    const scene::Channels& channels = renderer.scene().passes[pass].channels;
    for (int unit = 0; unit < scene::k_channel_count; ++unit) {
        const scene::Channel& channel = channels[size_t(unit)];
        const std::string sampler = fmt::format("iChannel{}", unit);
        const size_t* source = scene::source_pass(channel.input);
        const bool gone = source && render::frame_ref(pass, *source) == render::FrameRef::previous;
        const gl::Texture* texture = renderer.texture_at(pass, unit);
        if (!texture) { // the linked program does not read it, so its value in the text does not matter
            textures.emplace(sampler, black());
            continue;
        }
        if (gone || texture->extent.pixels() * size_t(texture->depth) > k_most_texels)
            continue;
        textures.emplace(sampler, std::make_shared<const Texels>(texels_of(*texture, channel.sampling)));
    }
    return textures;
}

namespace {

constexpr int k_sampled_columns = 16, k_sampled_rows = 9;
constexpr double k_most_milliseconds = 1500;

/// Derivatives are not supported: they need the neighbouring pixels.
bool takes_derivatives(const proof::Function& function) {
    return std::ranges::any_of(function.instructions, [](const proof::Instruction& each) {
        return each.op == proof::Op::derivative_x || each.op == proof::Op::derivative_y;
    });
}

bool knows_all(const proof::Function& function, const proof::TextureSet& textures) {
    return std::ranges::all_of(function.lookups, [&](const proof::Lookup& lookup) {
        return lookup.form == proof::Lookup::Form::size || textures.contains(lookup.sampler);
    });
}

} // namespace

Result<PixelWork> count_work(const render::Renderer& renderer, size_t pass,
                             const render::FrameInputs& inputs) {
    const scene::Scene& scene = renderer.scene();
    if (scene.passes[pass].kind == scene::PassKind::cubemap)
        return fail(ErrorCode::load, "operations of a cubemap pass are not counted");
    const auto function = TRY(PassFunction::create(scene, scene.passes[pass]));
    const proof::TextureSet textures = textures_of(renderer, pass);
    if (takes_derivatives(function.function()) || !knows_all(function.function(), textures))
        return fail(ErrorCode::load, "it takes derivatives, or reads a texture that is not available");
    proof::FloatEvaluator start = function.frame(renderer, pass, inputs);
    start.textures = proof::textures_in<proof::Point<float>>(textures);
    const Extent extent = renderer.extent();
    const Stopwatch clock;
    PixelWork work;
    // Takes every seventh pixel of the grid, so that the pixels of a short run are spread over the picture.
    for (int i = 0; i < k_sampled_columns * k_sampled_rows && clock.elapsed().wall < k_most_milliseconds;
         ++i) {
        const int place = i * 7 % (k_sampled_columns * k_sampled_rows);
        proof::FloatEvaluator pixel = start;
        function.move_to(pixel,
                         {(2 * (place % k_sampled_columns) + 1) * extent.width / (2 * k_sampled_columns),
                          (2 * (place / k_sampled_columns) + 1) * extent.height / (2 * k_sampled_rows)});
        proof::Decisions decisions(0);
        pixel.run(decisions, [](uint32_t) { return true; });
        work.operations += double(pixel.steps());
        ++work.pixels;
    }
    work.operations /= double(std::max<size_t>(1, work.pixels));
    return work;
}

} // namespace tidemark::lab
