// A pass evaluated on the CPU: the function, its textures, and its cost in operations.
//
// A pass of a scene as one function in SSA form, whose pixels are evaluated on the CPU with the device's
// uniforms.
#pragma once

#include "base/error.hpp"
#include "base/mapped_text.hpp"
#include "proof/march_slice.hpp"
#include "proof/spirv.hpp"
#include "proof/texels.hpp"
#include "render/renderer.hpp"

#include <glm/vec2.hpp>

#include <vector>

namespace tidemark::lab {

class PassFunction {
public:
    /// Compiles the pass. The error names the construct that is not supported, with the author's line.
    static Result<PassFunction> create(const scene::Scene& scene, const scene::Pass& pass,
                                       proof::Names names = proof::Names::drop);

    const proof::Function& function() const { return function_; }
    const std::vector<proof::MarchingLoop>& loops() const { return loops_; }
    /// By index of the loop.
    const std::vector<proof::LoopSlice>& slices() const { return slices_; }
    /// Converts a line of the compiled text to the author's file and line.
    SourceLocation locate(int line) const { return lines_.locate(line); }

    /// Returns an evaluator with the uniforms of a frame, for a pass in the renderer's plan.
    template <class Real = float>
    proof::PointEvaluator<Real> frame(const render::Renderer& renderer, size_t pass,
                                      const render::FrameInputs& inputs) const;
    /// Sets the frame's pixel, counted from the lower left.
    template <class Real>
    void move_to(proof::PointEvaluator<Real>& frame, glm::ivec2 at) const;

private:
    proof::Function function_;
    std::vector<proof::MarchingLoop> loops_;
    std::vector<proof::LoopSlice> slices_;
    text::LineMap lines_;
};

// A pass as a function, with the frame that its uniforms come from.

struct DrawnPass {
    const PassFunction& function;
    const render::Renderer& renderer; ///< has drawn the frame
    size_t pass = 0;
    render::FrameInputs inputs;
};

// Reads back the textures of a pass from the device.

/// Returns the textures as the last frame left them, by sampler name. Those of the previous frame (no longer
/// available) and those of over 8 million texels are left out, so their values are unknown.
proof::TextureSet textures_of(const render::Renderer& renderer, size_t pass);

// Measures how much a pass computes: the operations that its text executes, counted on the CPU. The result
// does not depend on the machine or its driver.

struct PixelWork {
    double operations = 0; ///< scalar operations per pixel: the mean
    size_t pixels = 0;     ///< number of pixels counted, on a grid
};

/// Counts for a pass in the frame that the renderer has drawn from those inputs, for up to 1.5 seconds. Fails
/// if the text is not supported.
Result<PixelWork> count_work(const render::Renderer& renderer, size_t pass,
                             const render::FrameInputs& inputs);

} // namespace tidemark::lab
