// The values that lines of a text computed for one pixel, as plain data.
#pragma once

#include "base/error.hpp"
#include "proof/number_systems.hpp"
#include "render/renderer.hpp"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::lab {

/// A line of the author's text.
struct AuthorLine {
    SourceLocation where;
    std::string text{}; ///< without surrounding blanks
};

/// Iteration numbers of the loops around a place, outermost first, from 1; empty outside of loops.
using Turns = std::vector<uint32_t>;
/// First and last iteration of the innermost loop.
using TurnRange = std::pair<uint32_t, uint32_t>;

/// One value that was assigned to a variable, or computed on a line without one.
struct TracedValue {
    enum class Kind { real, whole, condition } kind = Kind::real;
    std::string name{};             ///< for example `p`, `hit.normal`, `heights[3]`
    bool carried = false;           ///< from one iteration of the loop to the next
    Turns turns{};                  ///< iterations in which it was computed
    uint32_t rows = 1;              ///< of a vector or a matrix
    std::vector<double> in_float{}; ///< column by column; a condition is 1 or 0
    std::vector<double> in_double{};
    double digits = 0;     ///< that rounding leaves correct; of a vector relative to its length
    bool unstable = false; ///< a condition or a whole number that depends on rounding
    uint64_t order = 0;    ///< position among all values of the pixel
    uint64_t number = 0;   ///< position among the values of the same place, from 1

    /// Returns whether all components are finite in float.
    bool finite() const;
    /// Returns whether a condition or a whole number differs in double.
    bool mismatch() const;
};

/// The values of a line in one call of its function.
struct LineInCall {
    std::string function{};
    std::vector<SourceLocation> callers{}; ///< places of the enclosing calls, innermost first
    std::vector<TracedValue> values{};     ///< in order of execution
};

/// An event on a line: how often it happened, and the iterations of the first time.
struct Occurrence {
    uint64_t times = 0;
    Turns first{};
};

/// The summary of one line.
struct TracedLine {
    AuthorLine line{};
    uint64_t values = 0;                  ///< number of named values computed
    double digits = proof::k_most_digits; ///< of the value with the fewest
    std::string fewest{};                 ///< name of that value
    Turns fewest_turns{};
    double lost = 0; ///< digits lost by one operation: how many fewer its result has than its operands
    Turns lost_turns{};
    double dropped =
        0; ///< most digits of the smaller operand of a sum that its float result has no place for
    std::optional<TracedValue> not_finite{}; ///< the first such value
    Occurrence mismatch{};                   ///< a condition whose value in double differs
    bool float_holds = false;                ///< that condition in float
    Occurrence unstable{};                   ///< a condition that depends on rounding
};

// Traces the values of a pass for one pixel, line by line: the pass as a function in SSA form, evaluated on
// the CPU in float, in double along the same path, and in stochastic arithmetic, which gives the digits of
// each value that rounding leaves correct. The device's colour of the same pixel is included.

using Colour = std::array<double, 4>;

struct PixelTrace {
    enum class End { complete, discarded, too_long } end = End::complete;
    Colour in_float{}, in_double{}, digits{}; ///< of the pass's output
    Colour on_device{};
    /// a texture was read at its base level, although the device chooses the mipmap level
    bool at_base_level = false;
    uint64_t operations = 0;
    std::vector<TracedLine> lines{};   ///< lines that ran, in the order of the compiled text
    std::optional<AuthorLine> asked{}; ///< the requested line
    std::vector<LineInCall> calls{};   ///< values of the requested line, in order of execution
};

struct PixelRequest {
    glm::ivec2 pixel{0}; ///< from the bottom left
    /// keeps the values of this line; without a file name, of mainImage's file
    std::optional<SourceLocation> line{};
    /// nullopt: keeps the first and last few iterations, and those with an event
    std::optional<TurnRange> turns{};
    uint64_t seed = 1; ///< of the stochastic arithmetic
};

/// Traces a pixel of the shown pass, in the frame that the renderer has drawn (in floats) from those inputs.
/// Fails if the text, or an operation that the pixel reaches, is not supported, and if the line has no code.
Result<PixelTrace> trace_pixel(const render::Renderer& renderer, const render::FrameInputs& inputs,
                               const PixelRequest& request);

/// Returns the line of a pixel whose digits rounding loses most at once; nothing if no line loses two or
/// more.
const TracedLine* most_lossy(const PixelTrace& trace);

/// Returns whether the colour in float equals the device's, up to rounding.
bool is_as_drawn(const PixelTrace& trace);

} // namespace tidemark::lab
