// The field that a scene's rays follow, asked in the place of mainHit: of scenes whose field is the
// march_field of shaders/lib/march.glsl. A context must be current as long as a bench lives.
#pragma once

#include "lab/check/probe_bench.hpp"

#include <initializer_list>
#include <string_view>
#include <vector>

namespace tidemark::lab {

bool has_march_field(const scene::Scene& scene);

/// What is asked of the field at a ray's pixel.
struct FieldQuestion {
    /// A mainHit in GLSL, behind `#undef mainHit`, which may call the scene's own as tidemark_own_hit.
    std::string_view hit;
    std::vector<scene::Knob> knobs; ///< that it reads, on top of the scene's
};

class FieldBench {
public:
    /// The error of a scene that cannot be asked so, or not be promoted.
    static Result<FieldBench> create(const scene::Scene& scene, const FieldQuestion& question,
                                     glsl::Precision precision);

    /// The answers, RGBA in floats; `values` of the question's knobs, in their order.
    image::Image ask(std::initializer_list<scene::KnobValue> values, const FrameState& state);

private:
    FieldBench(render::Renderer renderer, std::vector<scene::Knob> knobs, size_t first)
        : renderer_(std::move(renderer)), knobs_(std::move(knobs)), first_(first) {}
    render::Renderer renderer_;
    std::vector<scene::Knob> knobs_;
    size_t first_; ///< of the question's knobs
};

} // namespace tidemark::lab
