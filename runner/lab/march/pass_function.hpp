// A pass of a scene as one function in SSA form, whose pixels are evaluated on the CPU with the device's
// uniforms.
#pragma once

#include "base/result.hpp"
#include "ir/march_slice.hpp"
#include "ir/spirv.hpp"
#include "render/renderer.hpp"
#include "text/mapped_text.hpp"

#include <glm/vec2.hpp>

#include <string>
#include <vector>

namespace tidemark::lab {

class PassFunction {
public:
    /// Compiles the pass. The error names the construct that is not supported, with the author's line.
    static Result<PassFunction> create(const scene::Scene& scene, const scene::Pass& pass,
                                       ir::Names names = ir::Names::drop);

    const ir::Function& function() const { return function_; }
    const std::vector<ir::MarchingLoop>& loops() const { return loops_; }
    /// By index of the loop.
    const std::vector<ir::LoopSlice>& slices() const { return slices_; }
    /// Converts a line of the compiled text to the author's file and line.
    SourceLocation locate(int line) const { return lines_.locate(line); }

    /// Returns an evaluator with the uniforms of a frame, for a pass in the renderer's plan.
    template <class Real = float>
    ir::PointEvaluator<Real> frame(const render::Renderer& renderer, size_t pass,
                                   const render::FrameInputs& inputs) const;
    /// Sets the frame's pixel, counted from the lower left.
    template <class Real>
    void move_to(ir::PointEvaluator<Real>& frame, glm::ivec2 at) const;

private:
    ir::Function function_;
    std::vector<ir::MarchingLoop> loops_;
    std::vector<ir::LoopSlice> slices_;
    text::LineMap lines_;
};

} // namespace tidemark::lab
