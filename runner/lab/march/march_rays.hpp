// The rays of a picture up to where they enter their marching loop: in float as the text has it, and in
// double as what proofs begin with.
#pragma once

#include "ir/texels.hpp"
#include "lab/march/pass_function.hpp"

#include <optional>

namespace tidemark::lab {

/// A pass as its text and a frame have it.
struct DrawnPass {
    const PassFunction& function;
    const render::Renderer& renderer; ///< has drawn the frame
    size_t pass = 0;
    render::FrameInputs inputs;
};

/// A ray in front of the loop that marches along it.
struct MarchRay {
    size_t loop = 0; ///< in PassFunction::loops
    ir::March march; ///< in float
    /// Nothing where the loop carries more than the place on the ray,
    /// or is another one in double.
    std::optional<ir::MarchSlice> slice;
    /// The distance as the text has it in float, likewise.
    std::optional<ir::FloatField> in_float;
};

class MarchRays {
public:
    explicit MarchRays(DrawnPass drawn);
    MarchRays(const MarchRays&) = delete;
    MarchRays& operator=(const MarchRays&) = delete;

    Extent extent() const { return drawn_.renderer.extent(); }
    const PassFunction& function() const { return drawn_.function; }

    /// Nothing where it enters no loop. Any number of threads may ask.
    std::optional<MarchRay> enter(glm::ivec2 pixel, ir::Surface surface) const;

private:
    DrawnPass drawn_;
    ir::TextureSet textures_;
    ir::FloatEvaluator floats_;
    ir::PointEvaluator<double> doubles_;
};

} // namespace tidemark::lab
