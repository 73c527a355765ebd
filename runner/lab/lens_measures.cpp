// Reads the numbers of a lens from a drawn frame: from an instrumented text, from pictures with other
// arithmetic, and from proofs of rays.

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "lab/instrumented_pass.hpp"
#include "lab/lens.hpp"
#include "lab/march_hits.hpp"
#include "lab/pass_function.hpp"
#include "lab/probe_inputs.hpp"
#include "render/frame_stepper.hpp"
#include "shader/variation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <map>

namespace tidemark::lab {
namespace {

using Mark = LensNumbers::Mark;

float shown(float sample) {
    return sample > 0 ? std::min(sample, 1.0f) : 0;
}

constexpr float k_marked_factor = 4294967296.0f;

/// Splits what `$lens` returned (shader/lens_text.hpp).
struct LensPixel {
    Mark mark;
    uint32_t bytes;

    explicit LensPixel(float packed)
        : mark(packed < 0                  ? Mark::absent
               : packed >= k_marked_factor ? Mark::marked
                                           : Mark::number),
          bytes(uint32_t(std::abs(packed) / (mark == Mark::marked ? k_marked_factor : 1) - 1)) {}
};

/// A hash of all bits of a buffer's numbers, as an instrumented text computes it.
uint32_t bits_of_numbers(const float* numbers) {
    uint32_t hash = 1;
    for (int i = 0; i < 4; ++i) {
        const uint32_t bits = std::isnan(numbers[i]) ? 1 : std::bit_cast<uint32_t>(numbers[i]);
        hash = ((hash ^ bits) * 0x9E3779B1u) ^ (hash >> 15);
    }
    return hash >> 8;
}

/// Says that __LINE__ has other values in an instrumented text; begins with a semicolon. Empty: the text does
/// not use it.
std::string_view words_on_lines(const scene::Scene& scene, size_t pass) {
    const auto uses = [](const text::MappedText& text) {
        return text.text().find("__LINE__") != std::string::npos;
    };
    return uses(scene.common) || uses(scene.passes[pass].text)
               ? "; the text uses __LINE__, which has another value there: replace it by a number"
               : "";
}

Result<LensNumbers> read_instrumented(const LensPlan& plan, const LensFrame& frame) {
    const image::Image picture = frame.plain.read_floats(plan.pass);
    const bool all_bits = plan.of_buffer && !frame.plain.scene().passes[plan.pass].stores_bytes;
    const image::Image drawn = frame.drawn->read_floats(frame.drawn->shown_index());
    const auto colours = picture.f32(), packed = drawn.f32();
    LensNumbers numbers{.extent = drawn.extent, .components = plan.components};
    if (plan.components == 0) {
        numbers.components = 1;
        for (size_t i = 0; i < packed.size(); i += 4)
            if (packed[i + 1] != 0 || packed[i + 2] != 0)
                numbers.components = 3;
    }
    size_t others = 0;
    for (size_t i = 0; i < packed.size(); i += 4) {
        const LensPixel pixel(packed[i + 3]);
        others += pixel.bytes != (all_bits ? bits_of_numbers(&colours[i]) : bytes_of_colour(&colours[i]));
        numbers.marks.push_back(pixel.mark);
        for (int k = 0; k < numbers.components; ++k)
            numbers.values.push_back(pixel.mark == Mark::absent ? 0 : packed[i + size_t(k)]);
    }
    if (others > 0)
        return fail(ErrorCode::load,
                    fmt::format("the instrumented text draws another picture: {} of {} pixels differ, so its "
                                "numbers would not be those of the scene{}",
                                others, drawn.extent.pixels(),
                                words_on_lines(frame.plain.scene(), plan.pass)));
    return numbers;
}

/// Drawings of `clocks`: each pixel keeps its smallest number, since other work may come between.
constexpr int k_clock_drawings = 5;

Result<LensNumbers> read_clocks(const LensPlan& plan, const LensFrame& frame, const KeepGoing& keep_going) {
    LensNumbers numbers = TRY(read_instrumented(plan, frame));
    if (std::ranges::all_of(numbers.values, [](float cycles) { return cycles == 0; }))
        return fail(ErrorCode::load, "the driver's shaders have no clock (GL_ARB_shader_clock)");
    if (!frame.drawn->can_draw_again())
        return numbers;
    const PassPreview preview = PassPreview::again(*frame.drawn, frame.inputs);
    for (int i = 1; i < k_clock_drawings && keep_going(); ++i) {
        const image::Image drawn = TRY(draw_own(preview, numbers.extent));
        for (size_t pixel = 0; pixel < numbers.values.size(); ++pixel)
            numbers.values[pixel] = std::min(numbers.values[pixel], drawn.f32()[4 * pixel]);
    }
    return numbers;
}

/// Returns the largest difference of a pixel's colours as shown, in steps of 1/255; NaN if one of them alone
/// is NaN.
float move_of(const float* before, const float* after) {
    float most = 0;
    for (int i = 0; i < 3; ++i) {
        if (std::isnan(before[i]) != std::isnan(after[i]))
            return std::nanf("");
        most = std::max(most, 255 * std::abs(shown(before[i]) - shown(after[i])));
    }
    return most;
}

/// Returns the largest difference of a buffer's four numbers.
float move_of_numbers(const float* before, const float* after) {
    float most = 0;
    for (int i = 0; i < 4; ++i) {
        if (std::isnan(before[i]) != std::isnan(after[i]))
            return std::nanf("");
        if (before[i] != after[i] && !std::isnan(before[i]))
            most = std::max(most, std::abs(before[i] - after[i]));
    }
    return most;
}

LensNumbers moves(const LensPlan& plan, const image::Image& before, const image::Image& after) {
    LensNumbers numbers{.extent = before.extent};
    const auto move = plan.of_buffer ? move_of_numbers : move_of;
    for (size_t i = 0; i < before.f32().size(); i += 4)
        numbers.values.push_back(move(&before.f32()[i], &after.f32()[i]));
    numbers.marks.assign(numbers.values.size(), Mark::number);
    return numbers;
}

LensNumbers read_error(const LensPlan& plan, const LensFrame& frame) {
    return moves(plan, frame.plain.read_floats(plan.pass),
                 frame.drawn->read_floats(frame.drawn->shown_index()));
}

/// Keeps for each pixel the largest move; NaN is larger than any.
class WorstMoves {
public:
    explicit WorstMoves(Extent extent) {
        numbers_.extent = extent;
        numbers_.values.assign(extent.pixels(), 0);
        numbers_.marks.assign(extent.pixels(), Mark::number);
        which_.assign(extent.pixels(), 0);
    }

    void add(const std::string& name, const LensNumbers& moved) {
        names_.push_back(name);
        for (size_t i = 0; i < moved.values.size(); ++i)
            if (!(moved.values[i] <= numbers_.values[i]) && !std::isnan(numbers_.values[i])) {
                numbers_.values[i] = moved.values[i];
                which_[i] = names_.size();
            }
    }

    /// `left_out`: variants that the text or the driver does not allow.
    LensNumbers take(const std::vector<std::string>& left_out) {
        std::vector<size_t> pixels(names_.size() + 1);
        for (const size_t each : which_)
            ++pixels[each];
        pixels[0] = 0;
        const auto worst = size_t(std::ranges::max_element(pixels) - pixels.begin());
        numbers_.note = pixels[worst] == 0 ? fmt::format("no pixel moves under {} variants", names_.size())
                                           : fmt::format("largest most often: {}", names_[worst - 1]);
        if (!left_out.empty())
            numbers_.note += fmt::format("; not tried: {}", fmt::join(left_out, ", "));
        return std::move(numbers_);
    }

private:
    std::vector<std::string> names_;
    std::vector<size_t> which_; ///< number of the variant that moved the pixel most; 0: none
    LensNumbers numbers_;
};

Result<LensNumbers> read_rounding(const LensPlan& plan, const LensFrame& frame, const KeepGoing& keep_going) {
    render::Renderer& drawn = frame.drawn ? *frame.drawn : frame.plain;
    if (!drawn.can_draw_again() || (!plan.of_buffer && drawn.shown_index() != plan.pass))
        return fail(ErrorCode::load,
                    plan.of_buffer
                        ? "the buffer reads itself or a later pass, so it cannot be drawn again with "
                          "other arithmetic"
                        : "another pass reads Image, so it cannot be drawn again with other "
                          "arithmetic");
    const auto text = TRY(read_text(drawn, drawn.shown_index()));
    const glsl::TreeFacts facts = glsl::find_facts(*text);
    const PassPreview preview = PassPreview::again(drawn, frame.inputs);
    WorstMoves worst(frame.plain.extent());
    std::vector<std::string> left_out;
    std::vector<glsl::VariedArithmetic> all = glsl::varied_roundings();
    all.push_back(glsl::varied_sines());
    for (const glsl::VariedArithmetic& arithmetic : all) {
        if (!keep_going())
            break;
        const glsl::Variation varied = arithmetic.vary(*text, facts, {});
        if (varied.places.empty())
            continue;
        const auto pictures = draw_varied(preview, varied, arithmetic.modes);
        if (!pictures) {
            left_out.emplace_back(arithmetic.modes[0].name);
            continue;
        }
        for (size_t i = 0; i < arithmetic.modes.size(); ++i)
            worst.add(arithmetic.modes[i].name, moves(plan, pictures->plain, pictures->others[i]));
    }
    return worst.take(left_out);
}

/// Most evaluations for one ray.
constexpr uint64_t k_most_of_a_proof = 2000;

/// Returns all pixels, those of a coarse grid first.
std::vector<glm::ivec2> coarse_to_fine(Extent extent) {
    std::vector<glm::ivec2> pixels;
    for (int stride = k_coarsest_stride; stride > 0; stride /= 2)
        for (int y = 0; y < extent.height; y += stride)
            for (int x = 0; x < extent.width; x += stride)
                if (stride == k_coarsest_stride || x % (2 * stride) != 0 || y % (2 * stride) != 0)
                    pixels.emplace_back(x, y);
    return pixels;
}

/// Returns the index of the outcome in the lens's classes.
float class_of(const ProvedRay& ray) {
    switch (ray.outcome) {
    case ProvedRay::Outcome::agrees: return 0;
    case ProvedRay::Outcome::steps_over: return 1;
    case ProvedRay::Outcome::misses: return 2;
    default: return 3;
    }
}

Result<LensNumbers> read_proof(const LensPlan& plan, const LensFrame& frame, const KeepGoing& keep_going) {
    const size_t pass = plan.pass;
    const auto function = TRY(PassFunction::create(frame.plain.scene(), frame.plain.scene().passes[pass]));
    const proof::TextureSet textures = textures_of(frame.plain, pass);
    const proof::FloatEvaluator start = function.frame(frame.plain, pass, frame.inputs);
    const Extent extent = frame.plain.extent();
    const std::vector<glm::ivec2> pixels = coarse_to_fine(extent);
    std::vector<std::optional<ProvedRay>> rays(pixels.size());
    std::vector<uint8_t> known(pixels.size());
    LensNumbers numbers{.extent = extent};
    numbers.complete = on_all_cores(pixels.size(), keep_going, [&](size_t i) {
        proof::FloatEvaluator pixel = start;
        function.move_to(pixel, pixels[i]);
        rays[i] = prove_ray(function, pixel, textures, pixels[i], k_most_of_a_proof);
        known[i] = 1;
    });
    numbers.values.assign(extent.pixels(), 0);
    numbers.marks.assign(extent.pixels(), Mark::absent);
    RayCounts counts;
    for (size_t i = 0; i < pixels.size(); ++i) {
        if (!rays[i])
            continue;
        const size_t at = size_t(pixels[i].y) * size_t(extent.width) + size_t(pixels[i].x);
        numbers.marks[at] = Mark::number;
        numbers.values[at] = class_of(*rays[i]);
        counts.add(*rays[i]);
    }
    if (counts.undecided > 0)
        numbers.note = fmt::format("most undecided: {}", to_string(counts.commonest()));
    else if (counts.unknown_texture > 0)
        numbers.note = "undecided: the march reads a texture that is not available";
    else if (counts.unfaithful > 0)
        numbers.note = "undecided: the march keeps more than its place on the ray";
    return numbers;
}

} // namespace

uint32_t bytes_of_colour(const float* colour) {
    uint32_t bytes = 0;
    for (int i = 0; i < 3; ++i)
        bytes = 256 * bytes + uint32_t(std::floor(shown(colour[i]) * 255.0f + 0.5f));
    return bytes;
}

Result<LensNumbers> read_lens(const LensPlan& plan, const LensFrame& frame, const KeepGoing& keep_going) {
    switch (plan.lens.name) {
    case LensName::clocks: return read_clocks(plan, frame, keep_going);
    case LensName::error: return read_error(plan, frame);
    case LensName::rounding: return read_rounding(plan, frame, keep_going);
    case LensName::proof: return read_proof(plan, frame, keep_going);
    default: return read_instrumented(plan, frame);
    }
}

image::Image raw_numbers(const LensNumbers& numbers) {
    image::Image raw(numbers.extent, 4, image::SampleType::f32);
    const auto samples = raw.f32();
    for (size_t i = 0; i < numbers.marks.size(); ++i) {
        for (int k = 0; k < 3; ++k)
            samples[4 * i + size_t(k)] = k < numbers.components ? numbers.at(i, k) : 0;
        samples[4 * i + 3] = float(numbers.marks[i]);
    }
    return raw;
}

} // namespace tidemark::lab
