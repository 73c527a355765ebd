// Which program draws a sequence: the one that was specialised in ways that a driver may round differently, or
// the plain one. Both are tried on frames of the sequence, and the bytes decide.
#pragma once

#include "base/result.hpp"
#include "render/renderer.hpp"

#include <optional>
#include <span>
#include <string>

namespace tidemark::cli {

/// What a renderer may leave out, and what was found out about it.
struct Trial {
    render::Renderer renderer;
    std::string said{}; ///< for people: a difference that was allowed or that decided against it; else empty
};

/// `frames` are those that are looked at, as a plain program would draw them one after the other from zero.
/// `allowed`: the largest difference of a sample (0..1 in a picture) that is consented to; nothing: none. The
/// winner's buffers are zero.
Result<Trial> choose_program(const scene::Scene& scene, const render::RenderOptions& options,
                             std::span<const render::FrameInputs> frames, std::optional<double> allowed);

} // namespace tidemark::cli
