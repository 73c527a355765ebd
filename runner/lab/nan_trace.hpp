// The origin of a NaN or an infinity: explanation of an operation, trace of a pixel, description in the
// author's words.
//
// Explains on the CPU why a GLSL operation gave its result, from operand values that the shader recorded.
#pragma once

#include "base/error.hpp"
#include "lab/instrumented_pass.hpp"
#include "render/frame_stepper.hpp"
#include "scene/scene.hpp"
#include "shader/watch.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

/// A scalar, vector or matrix of a shader, as bits; matrices column by column.
struct ShaderValue {
    glsl::ValueType type;
    std::array<uint32_t, 16> bits{};

    size_t size() const { return size_t(type.columns * type.rows); }
    /// Returns component i as a number, whatever its type.
    double number(size_t i) const;
    bool finite() const;
};

/// Reads a slot of glsl::WatchLayout; returns nothing if it was not written.
std::optional<ShaderValue> read_slot(std::span<const uint32_t> words, size_t slot);
/// Returns the fewest digits that identify this float, or "NaN", "+Inf" or "-Inf".
std::string to_shortest(float number);
/// Returns, for example, `0.31`, `vec2(0, -1)` or `70000 (0x11170)`.
std::string to_string(const ShaderValue& value);
/// Returns "NaN", or the first "+Inf" or "-Inf", of the components; empty if all are finite.
std::string_view worst_of(const ShaderValue& value);

enum class OriginCause {
    operation, ///< the operands are finite; `reason` says what is wrong, if known
    carried,   ///< an operand was not finite already
    undefined, ///< the operands as recorded give a finite result, so the shader used an undefined value
};

struct Explanation {
    OriginCause cause = OriginCause::operation;
    std::string reason{}; ///< "division by zero"; may be empty
    size_t operand = 0;   ///< index of the operand that was not finite
};

/// Explains the result of an operator or built-in function. Unknown operands are ignored; with one of them
/// the cause is never `undefined`.
Explanation explain(std::string_view name, const std::vector<std::optional<ShaderValue>>& operands,
                    const ShaderValue& result);

// Traces a NaN or an infinity in a picture to its origin: the operation that made it, with its operands and
// the loops and calls on the path, and whether fixing it fixes the pixel. A context must be current.

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

// Describes an operation of a syntax tree as its author wrote it: text, place, context, and the values it
// computed with.

/// An instrumented text and its facts.
struct WatchedText {
    const glsl::ParsedText& text;
    const glsl::TreeFacts& facts;
};

/// Returns what the text alone says about the operation: place, text, statement, variable and function.
NanOrigin describe(const WatchedText& watched, glsl::NodeId operation);

/// Adds what the shader recorded (values, loops and calls) and the explanation.
void add_reading(NanOrigin& origin, const WatchedText& watched, glsl::NodeId operation,
                 const glsl::Watch& watch, const WatchReading& reading, const scene::Scene& scene,
                 const scene::Pass& pass);

/// Shortens an excerpt to at most 80 bytes, with an ellipsis at the end if it was cut.
std::string shortened(std::string text);

/// Returns the variable's name in `a`, `a.xy`, `a[i]` and `(a)`; empty for other expressions.
std::string_view base_name(const WatchedText& watched, glsl::NodeId expression);

/// Returns the operands of an operation, including those without a slot.
std::vector<glsl::NodeId> operands(const WatchedText& watched, glsl::NodeId operation);

} // namespace tidemark::lab
