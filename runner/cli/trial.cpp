#include "cli/trial.hpp"

#include <fmt/format.h>

#include <GL/glcorearb.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>

namespace tidemark::cli {
namespace {

using render::Renderer;

bool in_doubt(const Renderer& renderer) {
    return std::ranges::any_of(renderer.plan().passes, [&](const render::PlannedPass& planned) {
        return renderer.left_out(planned.pass).in_doubt();
    });
}

/// From nothing drawn, or a frame that it has just drawn would be free.
double milliseconds_of(Renderer& renderer, const render::FrameInputs& inputs) {
    renderer.reset();
    glFinish();
    const auto start = std::chrono::steady_clock::now();
    renderer.draw(inputs);
    glFinish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// 0: the same bytes; infinite where one is a number and the other is none.
double difference_of(const image::Image& a, const image::Image& b) {
    if (a.bytes == b.bytes)
        return 0;
    double largest = 0;
    for (size_t at = 0; at + sizeof(float) <= a.bytes.size(); at += sizeof(float)) {
        float one = 0;
        float other = 0;
        std::memcpy(&one, a.bytes.data() + at, sizeof one);
        std::memcpy(&other, b.bytes.data() + at, sizeof other);
        if (std::memcmp(&one, &other, sizeof one) == 0)
            continue;
        const double difference = std::abs(double(one) - double(other));
        largest = std::isnan(difference)
                      ? std::numeric_limits<double>::infinity()
                      : std::max({largest, difference, std::numeric_limits<double>::denorm_min()});
    }
    return largest;
}

/// Of what all passes hold after a frame.
double difference_of(const Renderer& a, const Renderer& b) {
    double largest = 0;
    for (const render::PlannedPass& planned : a.plan().passes) {
        const bool cube = a.scene().passes[planned.pass].kind == scene::PassKind::cubemap;
        for (int face = 0; face < (cube ? 6 : 1); ++face)
            largest = std::max(
                largest, difference_of(a.read_floats(planned.pass, face), b.read_floats(planned.pass, face)));
    }
    return largest;
}

} // namespace

Result<Trial> choose_program(const scene::Scene& scene, const render::RenderOptions& options,
                             std::span<const render::FrameInputs> frames, std::optional<double> allowed) {
    auto special = Renderer::create(scene, options);
    if (!special)
        return fail(std::move(special.error()));
    if (!in_doubt(*special))
        return Trial{*std::move(special)};
    render::RenderOptions certain = options;
    certain.specialise = glsl::Specialise::unreachable;
    auto plain = Renderer::create(scene, certain);
    if (!plain)
        return fail(std::move(plain.error()));
    double difference = 0;
    for (const render::FrameInputs& inputs : frames) {
        special->draw(inputs);
        plain->draw(inputs);
        difference = std::max(difference, difference_of(*special, *plain));
    }
    const double plain_time = milliseconds_of(*plain, frames.back()); // neither compiles any more
    const double special_time = milliseconds_of(*special, frames.back());
    const bool taken = difference <= allowed.value_or(0) && special_time < plain_time;
    Trial trial{taken ? *std::move(special) : *std::move(plain)};
    trial.renderer.reset();
    if (difference > 0 && taken)
        trial.said = fmt::format("specialised: differs from the plain program by {:.3g} at most (in the frames "
                                 "tried), which --allow-difference allows",
                                 difference);
    else if (difference > allowed.value_or(0) && allowed)
        trial.said = fmt::format("not specialised: it would differ from the plain program by {:.3g}",
                                 difference);
    return trial;
}

} // namespace tidemark::cli
