// Where a NaN or an infinity in a picture comes from: the operation that gave origin to it, with its
// operands, the loops and the calls on the way, and whether fixing it fixes the pixel. A context must be
// current.
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

/// One operation and the value it gave.
struct NanOrigin {
    SourceLocation where;               ///< in a macro's body for what a macro stands for
    std::optional<SourceLocation> used; ///< where that macro is used
    std::string operation;              ///< its text
    std::string statement;              ///< the assignment, declaration or return around it
    std::string variable;               ///< that gets the value; may be empty
    std::string function;
    std::optional<ShaderValue> value{}; ///< nothing: only the place is known
    std::vector<TracedOperand> operands{};
    Explanation why{};
    std::string source{}; ///< of what came in from outside: "iChannel0 (Buffer A)", "the uniform iMouse"
    std::vector<TracedCall> calls{}; ///< outermost first
    std::vector<TracedLoop> loops{}; ///< innermost first
};

struct NanTrace {
    std::string pass;
    int frame = 0;
    PixelPlace pixel{};
    PixelBits colour{};  ///< as drawn
    bool masked = false; ///< the pixel is finite: a clamp, a min or a condition masked the NaN
    std::optional<NanOrigin> first{};
    std::optional<NanOrigin> fix{}; ///< the first whose fix, with those before it, makes the pixel finite
    bool fix_is_first = false;
    std::vector<std::string> notes{}; ///< what could not be done, and why
};

struct TraceRequest {
    render::FrameStates states;
    int frame = 0;
    int start = 0;                     ///< the frame from which a scene with feedback is drawn
    std::optional<PixelPlace> pixel{}; ///< of the shown pass; nothing: the first bad one of any pass
    bool hidden = false;               ///< where all pixels are finite: look for a NaN that something masked
    /// Called with each frame that is drawn on the way.
    std::function<void(int frame)> stepping{};
    /// Called with what is known so far, whenever more is.
    std::function<void(const NanTrace&)> progress{};
};

/// Nothing when all pixels of all passes are finite (and, with `hidden`, no operation gave NaN on the way).
/// The renderer draws in floats (RenderOptions::samples). Fails where the scene's text cannot be followed.
Result<std::optional<NanTrace>> trace_nan(render::Renderer& renderer, const TraceRequest& request);

} // namespace tidemark::lab
