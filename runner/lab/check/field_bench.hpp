// Evaluates the distance field of a scene along its rays by replacing mainHit. Only for scenes with a mainHit
// whose field is the march_field of shaders/lib/march.glsl. A context must be current while a bench exists.
#pragma once

#include "lab/check/probe_bench.hpp"

#include <initializer_list>
#include <string_view>
#include <vector>

namespace tidemark::lab {

bool has_march_field(const scene::Scene& scene);

/// A GLSL function that is evaluated in each ray's pixel.
struct FieldQuestion {
    /// A mainHit in GLSL, placed after `#undef mainHit`. It may call the scene's own as tidemark_own_hit.
    std::string_view hit;
    std::vector<scene::Knob> knobs; ///< its parameters, added to the scene's knobs
};

class FieldBench {
public:
    /// Requires a scene with a mainHit. Fails if the scene with that function does not compile or cannot be
    /// promoted to double.
    static Result<FieldBench> create(const scene::Scene& scene, const FieldQuestion& question,
                                     glsl::Precision precision);

    /// Draws and returns the results, RGBA floats. `values` are those of the question's knobs, in their
    /// order.
    image::Image ask(std::initializer_list<scene::KnobValue> values, const FrameState& state);

private:
    FieldBench(render::Renderer renderer, std::vector<scene::Knob> knobs, size_t first)
        : renderer_(std::move(renderer)), knobs_(std::move(knobs)), first_(first) {}
    render::Renderer renderer_;
    std::vector<scene::Knob> knobs_;
    size_t first_; ///< index of the question's first knob
};

} // namespace tidemark::lab
