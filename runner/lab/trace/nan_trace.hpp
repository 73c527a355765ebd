// Traces a NaN or an infinity in a picture to its origin: the operation that made it, with its operands and
// the loops and calls on the path, and whether fixing it fixes the pixel. A context must be current.
#pragma once

#include "base/result.hpp"
#include "lab/trace/operation.hpp"
#include "lab/trace/watched_run.hpp"
#include "render/frame_stepper.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

struct TracedOperand {
    std::string text; ///< as the author wrote it
    std::optional<ShaderValue> value{};
};

struct TracedCall {
    SourceLocation where;
    std::string function;
};

struct TracedLoop {
    SourceLocation where;
    unsigned iteration = 0; ///< from 1; 0: before the first
};

/// An operation and the value it gave.
struct NanOrigin {
    SourceLocation where;               ///< in the macro's body if a macro wrote the operation
    std::optional<SourceLocation> used; ///< the place where that macro is used
    std::string operation;              ///< source text
    std::string statement;              ///< the assignment, declaration or return that contains it
    std::string variable;               ///< the variable that receives the value; may be empty
    std::string function;
    std::optional<ShaderValue> value{}; ///< nothing: only the place is known
    std::vector<TracedOperand> operands{};
    Explanation why{};
    /// The input that a value came in through: "iChannel0 (Buffer A)", "the uniform iMouse".
    std::string source{};
    std::vector<TracedCall> calls{}; ///< outermost first
    std::vector<TracedLoop> loops{}; ///< innermost first
};

struct NanTrace {
    std::string pass;
    int frame = 0;
    PixelPlace pixel{};
    PixelBits colour{};  ///< as drawn
    bool masked = false; ///< the pixel is finite, since a clamp, a min or a condition masked the NaN
    std::optional<NanOrigin> first{};
    /// The first operation whose fix, with those before it, makes the pixel finite.
    std::optional<NanOrigin> fix{};
    bool fix_is_first = false;
    std::vector<std::string> notes{}; ///< what could not be done, and why
};

struct TraceRequest {
    render::FrameStates states;
    int frame = 0;
    int start = 0;                     ///< the frame from which a scene with feedback is drawn
    std::optional<PixelPlace> pixel{}; ///< of the shown pass; nothing: the first bad pixel of any pass
    bool hidden = false;               ///< if all pixels are finite, look for a masked NaN
    /// Called with each frame that is drawn before the result is known.
    std::function<void(int frame)> stepping{};
    /// Called with the results so far, whenever there are more.
    std::function<void(const NanTrace&)> progress{};
};

/// Returns nothing if all pixels of all passes are finite (and, with `hidden`, no operation gave NaN). The
/// renderer must draw in floats (RenderOptions::samples). Fails if the scene's text cannot be parsed.
Result<std::optional<NanTrace>> trace_nan(render::Renderer& renderer, const TraceRequest& request);

} // namespace tidemark::lab
