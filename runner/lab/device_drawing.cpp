#include "base/error.hpp"
#include "base/measurement.hpp"
#include "lab/device_check.hpp"
#include "lab/device_difference.hpp"
#include "lab/work_precision.hpp"
#include "media/comparison.hpp"
#include "render/exposure.hpp"
#include "render/gl_context.hpp"
#include "render/gl_sync.hpp"

#include <GL/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace tidemark::lab {

std::span<const DeviceCheck> device_checks() {
    static constexpr DeviceCheck k_checks[] = {
        {"read-back", ask_read_back},   {"read-ahead", ask_read_ahead},
        {"bytes", ask_bytes},           {"special-values", ask_special_values},
        {"arithmetic", ask_arithmetic}, {"contraction", ask_contraction},
        {"functions", ask_functions},   {"large-sines", ask_large_sines},
        {"doubles", ask_doubles},       {"repeatability", ask_repeatability},
        {"tiles", ask_tiles},           {"program-cache", ask_program_cache},
        {"reset", ask_reset},           {"loops", ask_loops},
        {"timer", ask_timer},           {"conformance", ask_conformance},
        {"weights", ask_weights},
    };
    return k_checks;
}

namespace {

/// Each pixel takes another path through functions, derivatives and branches, and keeps every bit.
constexpr std::string_view k_busy = R"(void mainImage(out vec4 c, in vec2 p) {
    vec2 z = p / iResolution.y + iTime;
    for (int i = 0; i < 40; ++i) {
        z = vec2(sin(3.1 * z.y) + 0.3 * z.x, cos(2.7 * z.x) * exp(-0.1 * z.y));
        if (z.x > 0.9) z = z.yx * 1.01;
    }
    c.rgb = vec3(z.x, dFdx(z.x), dFdy(z.y));
}
)";
constexpr Extent k_extent{250, 141};

bool same_bytes(const image::Image& a, const image::Image& b) {
    return std::ranges::equal(a.f32(), b.f32(), {}, std::bit_cast<uint32_t, float>,
                              std::bit_cast<uint32_t, float>);
}

render::RenderOptions options_of(Extent extent) {
    return {.extent = extent, .samples = image::SampleType::f32};
}

Result<image::Image> drawn(std::string_view text, const render::RenderOptions& options) {
    auto renderer = TRY(renderer_of(text, options));
    renderer.draw({});
    return renderer.read_back();
}

/// Computes the PCG hash, as the text in device_numbers.cpp does on the device.
uint32_t bits(uint32_t n) {
    n = n * 747796405U + 2891336453U;
    n = ((n >> ((n >> 28U) + 4U)) ^ n) * 277803737U;
    return (n >> 22U) ^ n;
}

/// Changes a bit pattern to a normal number if it is not one.
uint32_t normal(uint32_t pattern) {
    const uint32_t exponent = pattern & 0x7F800000U;
    return exponent == 0 || exponent == 0x7F800000U ? pattern ^ 0x40000000U : pattern;
}

} // namespace

Result<DeviceAnswer> ask_read_back() {
    const auto samples =
        TRY(samples_of("for (int k = 0; k < 3; ++k) {"
                       "  uint u = bits(3u * i + uint(k)), e = u & 0x7F800000u;"
                       "  c[k] = uintBitsToFloat(e == 0u || e == 0x7F800000u ? u ^ 0x40000000u : u);"
                       "}",
                       1 << 16));
    size_t wrong = 0;
    for (uint32_t i = 0; i < samples.size(); ++i)
        for (uint32_t k = 0; k < 3; ++k)
            wrong += std::bit_cast<uint32_t>(samples[i][k]) != normal(bits(3 * i + k));
    const size_t floats = 3 * samples.size();
    if (wrong > 0)
        return DeviceAnswer{Verdict::fail,
                            fmt::format("{} of {} floats are read back with other bits", wrong, floats)};
    return DeviceAnswer{Verdict::pass, fmt::format("{} floats are read back bit for bit", floats)};
}

Result<DeviceAnswer> ask_read_ahead() {
    constexpr int k_frames = 7;
    auto renderer = TRY(renderer_of(k_busy, options_of(k_extent)));
    std::vector<image::Image> at_once;
    for (int frame = 0; frame < k_frames; ++frame) {
        renderer.draw({.time = double(frame)});
        at_once.push_back(renderer.read_back());
    }
    gl::PixelRing ring(2);
    int taken = 0;
    int wrong = 0;
    const auto take = [&] { wrong += !same_bytes(renderer.take(ring), at_once[size_t(taken++)]); };
    for (int frame = 0; frame < k_frames; ++frame) {
        renderer.draw({.time = double(frame)});
        if (ring.full())
            take();
        if (!renderer.read_ahead(ring))
            return DeviceAnswer{Verdict::warn, "the driver has no memory for asynchronous read-back"};
    }
    while (!ring.empty())
        take();
    if (wrong > 0)
        return DeviceAnswer{
            Verdict::fail,
            fmt::format(
                "{} of {} pictures read back asynchronously have other bytes; set TIDEMARK_READ_BACK=at-once",
                wrong, k_frames)};
    return DeviceAnswer{
        Verdict::pass,
        fmt::format("{} pictures read back asynchronously have the same bytes as those read at once",
                    k_frames)};
}

/// Checks rounding to bytes. OpenGL allows either neighbour for a colour between two levels. NVIDIA's H100
/// keeps 12 bits before it rounds: a colour up to 0.06 of a level above the middle becomes the lower level.
Result<DeviceAnswer> ask_bytes() {
    auto renderer = TRY(renderer_of("void mainImage(out vec4 c, in vec2 p) {"
                                    "  float k = floor(p.x); c = vec4(k, k - 0.4, k + 0.4, k * 2.0) / 255.0;"
                                    "}",
                                    {.extent = {256, 1}}));
    renderer.draw({});
    const image::Image picture = renderer.read_back();
    for (int k = 0; k < 256; ++k)
        for (size_t channel = 0; channel < 3; ++channel)
            if (const int got = picture.u8()[size_t(4 * k) + channel]; got != k)
                return DeviceAnswer{Verdict::fail, fmt::format("{}/255 is stored as {}/255", k, got)};
    return DeviceAnswer{Verdict::pass,
                        "colours within 0.4 of an 8-bit level are stored as that level, without conversion"};
}

Result<DeviceAnswer> ask_repeatability() {
    std::vector<image::Image> pictures;
    for (int program = 0; program < 2; ++program) {
        auto renderer = TRY(renderer_of(k_busy, options_of(k_extent)));
        // Alternate, as an unchanged picture is not drawn again.
        for (const double time : {0.0, 1.0, 0.0, 1.0, 0.0}) {
            renderer.draw({.time = time});
            if (time == 0.0)
                pictures.push_back(renderer.read_back());
        }
    }
    const auto differs = [&](const image::Image& picture) { return !same_bytes(picture, pictures[0]); };
    if (const auto others = std::ranges::count_if(pictures, differs))
        return DeviceAnswer{Verdict::fail, fmt::format("{} of {} drawings of one frame have other bytes",
                                                       others, pictures.size())};
    return DeviceAnswer{
        Verdict::pass,
        fmt::format("{} drawings of one frame by two programs have the same bytes", pictures.size())};
}

Result<DeviceAnswer> ask_tiles() {
    const image::Image whole = TRY(drawn(k_busy, options_of(k_extent)));
    render::RenderOptions in_tiles = options_of(k_extent);
    in_tiles.tile = Extent{64, 64};
    auto renderer = TRY(renderer_of(k_busy, in_tiles));
    renderer.draw({});
    if (!same_bytes(whole, draw_in_tiles(renderer, {})))
        return DeviceAnswer{Verdict::fail,
                            "a frame drawn in tiles does not have the same bytes as one drawn whole"};
    return DeviceAnswer{Verdict::pass, "a frame drawn in tiles has the same bytes as one drawn whole"};
}

Result<Sample> counted_loop(int iterations) {
    return TRY(samples_of(fmt::format("uint s = i; int n = 0;"
                                      "for (; n < {} + int(iTime); ++n) s = s * 1664525u + 1013904223u;"
                                      "c.rg = vec2(float(n), float(s & 0xFFFFu));",
                                      iterations),
                          1))[0];
}

Result<DeviceAnswer> ask_loops() {
    constexpr int k_turns = 1'000'000;
    const Sample counted = TRY(counted_loop(k_turns));
    uint32_t state = 0;
    for (int n = 0; n < k_turns; ++n)
        state = state * 1664525U + 1013904223U;
    if (counted[0] < k_turns)
        return DeviceAnswer{Verdict::warn, fmt::format("loops are cut off: {:.0f} of {} iterations ran",
                                                       counted[0], k_turns)};
    if (counted[0] != k_turns || counted[1] != float(state & 0xFFFFU))
        return DeviceAnswer{Verdict::fail,
                            fmt::format("a loop of {} iterations counts {:.0f}", k_turns, counted[0])};
    return DeviceAnswer{Verdict::pass, fmt::format("a loop of {} iterations runs to its end", k_turns)};
}

Result<DeviceAnswer> ask_program_cache() {
    const auto renderer = TRY(renderer_of(
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(p, iTime, 1.0); }", {.extent = {8, 8}}));
    const gl::ProgramBinary binary = renderer.program(renderer.shown_index()).binary();
    if (binary.bytes.empty())
        return DeviceAnswer{Verdict::pass,
                            "the driver offers no program binaries: every start compiles again"};
    if (!gl::Program::load(binary))
        return DeviceAnswer{Verdict::warn, "a saved program binary does not load again"};
    return DeviceAnswer{Verdict::pass,
                        fmt::format("a saved program binary of {} bytes loads again", binary.bytes.size())};
}

Result<DeviceAnswer> ask_timer() {
    ClockComparison clocks;
    for (const int turns : {200, 2000}) {
        auto renderer = TRY(
            renderer_of(fmt::format("void mainImage(out vec4 c, in vec2 p) {{"
                                    "  float s = p.x; for (int i = 0; i < {}; ++i) s = sin(s + p.y + iTime);"
                                    "  c = vec4(s);"
                                    "}}",
                                    turns),
                        {.extent = {640, 360}}));
        for (int frame = 0; frame < 6; ++frame) {
            glFinish();
            const Stopwatch watch;
            gl::ElapsedTime timer;
            renderer.draw({.time = double(frame)});
            timer.stop();
            glFinish();
            const auto told = timer.milliseconds();
            if (!told)
                return DeviceAnswer{Verdict::warn, "the driver has no timer: times come from the wall clock"};
            if (frame > 0) // the first frame includes compilation
                clocks.add(*told, watch.elapsed().wall);
        }
    }
    return DeviceAnswer{
        clocks.agree() ? Verdict::pass : Verdict::warn,
        fmt::format("the driver's timer is {:.2f} to {:.2f} times the wall clock around glFinish{}",
                    clocks.least, clocks.most, clocks.agree() ? "" : ": times come from the wall clock")};
}

Result<DeviceAnswer> ask_reset() {
    if (gl::tells_resets())
        return DeviceAnswer{Verdict::pass,
                            "the driver reports resets, so pictures that a reset damaged are discarded"};
    if (gl::is_software_renderer(gl::query_capabilities().renderer))
        return DeviceAnswer{Verdict::pass, "the CPU draws: there is no GPU driver to be reset"};
    return DeviceAnswer{Verdict::warn,
                        "the driver does not report resets: pictures drawn after one may be wrong"};
}

// Models of devices, and pictures of two of them (lab/device_difference.hpp).

std::vector<Model> device_models(bool functions) {
    std::vector<Model> models;
    for (glsl::VariedArithmetic& formulas : glsl::varied_formulas())
        models.push_back({"rounding", std::move(formulas)});
    if (functions)
        models.push_back({"sine", glsl::varied_sines()});
    for (glsl::VariedArithmetic& operations : functions ? glsl::varied_operations() : glsl::varied_sums())
        models.push_back({"rounding", std::move(operations)});
    models.push_back(
        {"mipmaps",
         {glsl::vary_mipmaps, {{1, "a mipmap half a level coarser"}, {2, "a mipmap half a level finer"}}}});
    models.push_back(
        {"derivatives",
         {glsl::vary_derivatives,
          {{1, "derivatives of each pixel of a block of 2x2"}, {2, "one derivative for a block of 2x2"}}}});
    models.push_back({"mediump", {glsl::vary_halves, {{1, "`mediump` numbers in half floats"}}}});
    return models;
}

std::vector<Model> models_beside_swiftshader() {
    return {{"rounding", {glsl::vary_precision, {{0, "everything `precise`"}}}},
            {"rounding", {glsl::vary_order, {{0, "sums added in reverse order"}}}}};
}

std::vector<Model> last_bit_models() {
    return {
        {"rounding", {glsl::vary_last_bits, {{1, "the last bits of what it computes, which it amplifies"}}}},
        {"rounding", glsl::varied_inputs()}};
}

namespace {

/// Numbers of a buffer are the same within this part of their size: what the next pass makes of them is
/// unknown.
constexpr double k_same_number = 1e-6;

double shown_level(float sample) {
    return std::isnan(sample) ? 0.0 : std::clamp(double(sample), 0.0, 1.0);
}

bool differs(float left, float right, double limit, PictureKind kind) {
    if (kind == PictureKind::image)
        return std::isnan(left) != std::isnan(right) ||
               std::abs(shown_level(left) - shown_level(right)) > limit;
    if (!std::isfinite(left) || !std::isfinite(right))
        return std::isnan(left) != std::isnan(right) || (!std::isnan(left) && left != right);
    const double size = std::max({1.0, std::abs(double(left)), std::abs(double(right))});
    return std::abs(double(left) - double(right)) > limit * size;
}

/// Returns Image as a file of 8 bits has it.
image::Image as_bytes(const image::Image& image) {
    image::Image result(image.extent, 3, image::SampleType::u8);
    for (size_t pixel = 0; pixel < image.extent.pixels(); ++pixel)
        for (size_t channel = 0; channel < 3; ++channel)
            result.u8()[pixel * 3 + channel] = uint8_t(
                std::lround(255 * shown_level(image.f32()[pixel * size_t(image.channels) + channel])));
    return result;
}

/// Returns whether each colour could come from a file of 8 bits.
bool has_bytes_alone(const image::Image& image) {
    constexpr double k_exact = 1e-4;
    const auto samples = image.f32();
    for (size_t i = 0; i < samples.size(); ++i) {
        const double level = 255 * double(samples[i]);
        if (int(i % size_t(image.channels)) < 3 && !(std::abs(level - std::round(level)) < k_exact))
            return false;
    }
    return true;
}

/// Resamples one dimension from `from` to `to` numbers, `stride` apart, each interpolated between the two
/// nearest.
std::vector<double> halved(const std::vector<double>& values, size_t stride, size_t from, size_t to) {
    const size_t blocks = values.size() / (stride * from);
    std::vector<double> result(blocks * stride * to);
    for (size_t block = 0; block < blocks; ++block)
        for (size_t i = 0; i < to; ++i) {
            const double place = (double(i) + 0.5) * double(from) / double(to) - 0.5;
            const size_t low = size_t(std::max(place, 0.0)), high = std::min(low + 1, from - 1);
            const double part = std::max(place, 0.0) - double(low);
            for (size_t k = 0; k < stride; ++k)
                result[(block * to + i) * stride + k] =
                    (1 - part) * values[(block * from + low) * stride + k] +
                    part * values[(block * from + high) * stride + k];
        }
    return result;
}

/// Makes the levels of a texture of bytes, each from the one before, in RGBA.
void make_exact_levels(const gl::Texture& texture) {
    std::vector<double> level;
    for (const float sample : gl::read_level(texture, 0))
        level.push_back(std::round(255.0 * double(sample)));
    auto [width, height, layers] = gl::level_size(texture, 0);
    for (int number = 1; number < texture.levels; ++number) {
        const auto [w, h, d] = gl::level_size(texture, number);
        level = halved(level, 4, size_t(width), size_t(w));
        level = halved(level, 4 * size_t(w), size_t(height), size_t(h));
        if (texture.target == GL_TEXTURE_3D)
            level = halved(level, 4 * size_t(w) * size_t(h), size_t(layers), size_t(d));
        std::vector<uint8_t> bytes;
        for (double& sample : level)
            bytes.push_back(uint8_t(sample = std::nearbyint(sample)));
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        if (texture.target == GL_TEXTURE_2D)
            glTextureSubImage2D(texture.id(), number, 0, 0, w, h, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
        else
            glTextureSubImage3D(texture.id(), number, 0, 0, 0, w, h, d, GL_RGBA, GL_UNSIGNED_BYTE,
                                bytes.data());
        width = w, height = h, layers = d;
    }
}

} // namespace

double same_pixel(PictureKind kind) {
    return kind == PictureKind::image ? k_same_pixel : k_same_number;
}

Mask differing(const image::Image& left, const image::Image& right, double limit, PictureKind kind) {
    Mask mask(left.extent.pixels());
    const auto a = left.f32(), b = right.f32();
    const size_t channels = kind == PictureKind::image ? 3 : 4;
    for (size_t pixel = 0; pixel < mask.size(); ++pixel)
        for (size_t channel = 0; channel < channels && !mask[pixel]; ++channel)
            mask[pixel] = differs(a[pixel * size_t(left.channels) + channel],
                                  b[pixel * size_t(right.channels) + channel], limit, kind);
    return mask;
}

size_t count(const Mask& mask) {
    return size_t(std::ranges::count(mask, true));
}

Mask both(const Mask& left, const Mask& right) {
    Mask result(left.size());
    for (size_t i = 0; i < left.size(); ++i)
        result[i] = left[i] && right[i];
    return result;
}

Mask either(const Mask& left, const Mask& right) {
    Mask result(left.size());
    for (size_t i = 0; i < left.size(); ++i)
        result[i] = left[i] || right[i];
    return result;
}

Mask grown(const Mask& mask, Extent extent) {
    Mask result(mask.size());
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) {
            if (!mask[size_t(y) * size_t(extent.width) + size_t(x)])
                continue;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, extent.height - 1); ++v)
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, extent.width - 1); ++u)
                    result[size_t(v) * size_t(extent.width) + size_t(u)] = true;
        }
    return result;
}

image::Image comparable(const image::Image& here, const image::Image& there) {
    image::Image result = here;
    if (has_bytes_alone(there))
        for (float& sample : result.f32())
            sample = float(std::lround(255 * shown_level(sample))) / 255;
    return result;
}

const image::Image* picture_of(const std::vector<PassPicture>& passes, std::string_view name) {
    const auto found = std::ranges::find(passes, name, &PassPicture::pass);
    return found == passes.end() ? nullptr : &found->picture;
}

Result<FramePictures> draw_frame(ProbeBench& bench, const FrameState& state) {
    FramePictures frame;
    frame.passes = TRY(bench.passes(state, frame.before));
    return frame;
}

bool use_pictures(const render::Renderer& renderer, size_t pass, const FramePictures& there) {
    bool used = false;
    std::vector<size_t> drawn;
    for (const render::PlannedPass& planned : renderer.plan().passes) {
        if (planned.pass == pass)
            break;
        drawn.push_back(planned.pass);
    }
    for (int unit = 0; unit < scene::k_channel_count; ++unit) {
        const size_t* const source =
            scene::source_pass(renderer.scene().passes[pass].channels[size_t(unit)].input);
        const gl::Texture* const texture = source ? renderer.texture_at(pass, unit) : nullptr;
        if (!texture)
            continue;
        const bool is_drawn = std::ranges::find(drawn, *source) != drawn.end();
        const image::Image* const picture =
            picture_of(is_drawn ? there.passes : there.before, renderer.scene().passes[*source].name);
        if (!picture || picture->channels != 4 || picture->extent != texture->extent)
            continue;
        gl::upload(*texture, 0, GL_RGBA, GL_FLOAT, std::as_bytes(picture->f32()));
        gl::make_mipmaps(*texture);
        used = true;
    }
    return used;
}

int filters_of(const render::Renderer& renderer, const scene::Pass& pass, size_t number) {
    int filters = 0;
    for (int i = 0; i < scene::k_channel_count; ++i) {
        const auto& [input, sampling, where] = pass.channels[size_t(i)];
        if (input.index() != scene::k_kind<scene::Unbound> && sampling.minify == sampling.magnify)
            filters |= 1 << (i + (sampling.minify == scene::Filter::linear ? 16 : 0));
        if (const gl::Texture* const texture = renderer.texture_at(number, i))
            filters |= 1 << (i + (gl::holds_bytes(texture->internal_format) ? 4 : 20));
    }
    return filters;
}

ExactMipmaps::ExactMipmaps(const render::Renderer& renderer, size_t pass) {
    for (int unit = 0; unit < scene::k_channel_count; ++unit) {
        const gl::Texture* const texture = renderer.texture_at(pass, unit);
        if (!texture || texture->levels == 1)
            continue;
        any_levels_ = true;
        if (!texture->es && gl::holds_bytes(texture->internal_format))
            textures_.push_back(texture);
    }
}

void ExactMipmaps::use(bool exact) {
    if (exact == exact_)
        return;
    exact_ = exact;
    for (const gl::Texture* const texture : textures_)
        exact ? make_exact_levels(*texture) : gl::make_mipmaps(*texture);
}

Result<DeviceDifference> compare_devices(const image::Image& here, const image::Image& there) {
    DeviceDifference result;
    const image::PictureMetrics metrics = TRY(image::measure(as_bytes(here), as_bytes(there)));
    result.pixels = metrics.samples.pixels;
    result.largest = metrics.samples.largest;
    result.psnr = metrics.samples.psnr;
    result.flip = metrics.flip;
    result.equal = metrics.samples.equal();
    result.differing =
        std::ranges::count(differing(comparable(here, there), there, k_same_pixel, PictureKind::image), true);
    const auto a = here.f32(), b = there.f32();
    for (size_t pixel = 0; pixel < result.pixels; ++pixel) {
        bool left_finite = true, right_finite = true;
        for (size_t channel = 0; channel < 3; ++channel) {
            left_finite &= std::isfinite(a[pixel * size_t(here.channels) + channel]);
            right_finite &= std::isfinite(b[pixel * size_t(there.channels) + channel]);
        }
        result.not_finite_here += !left_finite && right_finite;
        result.not_finite_there += left_finite && !right_finite;
    }
    return result;
}

// At 1.3 SwiftShader's sine is 1.2e-4 off.
const std::string_view k_swiftshader_test = "void mainImage(out vec4 c, in vec2 p) { c = vec4(step(1e-5, "
                                            "abs(sin(1.3 + min(iTime, 0.0)) - 0.963558185))); }";

const std::string_view k_functions_test = R"(float number(vec2 p, uint seed) {
    uint n = (uint(p.x) * 7919u + uint(p.y) * 104729u + seed) * 747796405u + 2891336453u;
    n = ((n >> ((n >> 28u) + 4u)) ^ n) * 277803737u;
    return uintBitsToFloat(0x3F800000u | (n >> 9u)) * 9.0 - 8.75;
}
void mainImage(out vec4 c, in vec2 p) {
    float x = number(p, 1u), y = number(p, 2u);
    float values[10] = float[10](sin(9.0 * x), cos(9.0 * x), tan(x), atan(x - 4.0), exp(x - 4.0), log(x), pow(x, y),
                                 sqrt(x), inversesqrt(x), y / x);
    c = vec4(values[int(p.y)], 0.0, 0.0, 1.0);
}
)";

} // namespace tidemark::lab
