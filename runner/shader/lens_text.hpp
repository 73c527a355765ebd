// Instruments a text so that its mainHit returns numbers about the pixel instead of a distance, and the
// colour of mainImage beside them in the same drawing. Text in, text out: a text without #version, which is
// Common and the pass after macro expansion, one statement a line.
#pragma once

#include "shader/parsed_text.hpp"
#include "shader/tree_facts.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::glsl {

/// GLSL: `vec4 $lens(vec4 n, vec4 colour)` returns up to three numbers and, in w, the colour's bytes as one
/// whole number, 1 + 65536 r + 256 g + b; with TIDEMARK_ALL_BITS (of a buffer) a hash of its floats instead
/// of its bytes. The number is negative if n.w is 0: the pixel has no number. It is
/// 2^32 times as large if n.w is 2: the pixel is marked.
inline constexpr std::string_view k_lens_functions = R"(
float $byte(float x) { return x > 0.0 ? floor(min(x, 1.0) * 255.0 + 0.5) : 0.0; }
uint $mixed(uint h, float x) { return ((h ^ (isnan(x) ? 1u : floatBitsToUint(x))) * 0x9E3779B1u) ^ (h >> 15u); }
vec4 $lens(vec4 n, vec4 c) {
#ifdef TIDEMARK_ALL_BITS
    float bytes = 1.0 + float($mixed($mixed($mixed($mixed(1u, c.x), c.y), c.z), c.w) >> 8u);
#else
    float bytes = 1.0 + ($byte(c.x) * 256.0 + $byte(c.y)) * 256.0 + $byte(c.z);
#endif
    return vec4(n.xyz, n.w < 0.5 ? -bytes : n.w > 1.5 ? bytes * 4294967296.0 : bytes);
}
)";

/// The value of a line to show.
struct SeenValue {
    SourceLocation place;   ///< without a file: that of mainImage
    std::string variable{}; ///< a name, perhaps with members; empty: what the line sets or returns
    enum class Pick { last, least, most, number } pick = Pick::last; ///< of the values in a pixel
    uint32_t number = 1;                                             ///< of the value to show, from 1
};

struct ValueText {
    text::MappedText text;
    std::string name; ///< of the value: `p`, `return`
    SourceLocation place{};
    int components = 0;    ///< 0: not known
    std::string excerpt{}; ///< source of the expression or the condition
};

/// Fails (ErrorCode::usage) if the line has no such value; the message names what it has.
Result<ValueText> show_value(const ParsedText& text, const TreeFacts& facts, const SeenValue& request);

/// Shows which way a condition went: 0 false, 1 true, 2 both in one pixel. `which`: of the line's conditions,
/// from 1; 0: the only one. Fails (ErrorCode::usage) if it is not clear which condition is meant.
Result<ValueText> show_branch(const ParsedText& text, const TreeFacts& facts, const SourceLocation& place,
                              int which);

/// Counts the iterations of a loop, all entries together. `place` is a line of the loop's head.
Result<ValueText> count_iterations(const ParsedText& text, const TreeFacts& facts,
                                   const SourceLocation& place);

/// Returns where loops begin whose iterations can be counted, in order. A place in the file of mainImage has
/// no file.
std::vector<SourceLocation> countable_loops(const ParsedText& text);

/// Measures the cycles of the device's clock between the begin and the end of mainImage. Where the driver's
/// shaders have no clock all numbers are 0.
Result<text::MappedText> measure_clocks(const ParsedText& text, const TreeFacts& facts);

/// A kind of operation with a weight of its own.
enum class Operation {
    sum, ///< and products, comparisons, integers
    extremum,
    quotient,
    rounding, ///< floor and the like
    root,
    inverse_root,
    sine, ///< and cosine
    arc,
    exponential,
    logarithm,
    power,
    lookup, ///< `texture`, which chooses a mipmap
    lookup_level,
    fetch,
    iteration, ///< of a loop, without what it computes
    call,      ///< of an author's function
};
inline constexpr size_t k_operations = 16;
std::string_view to_string(Operation operation);

/// The weights of operations on one component. Those of the table are between those of a GPU, where a sine
/// takes as long as four sums, and those of a CPU, where it takes as long as eighty.
struct WorkWeights {
    std::array<double, k_operations> of{1, 1, 4, 1, 16, 16, 16, 16, 16, 16, 16, 64, 64, 64, 0, 1};
    std::string device{}; ///< on which they were measured; empty: they are those of the table
    int lanes = 1;        ///< number of pixels that the device runs together, until the last of them is done
    bool both_sides = false; ///< the device runs both sides of every branch

    double operator[](Operation operation) const { return of[size_t(operation)]; }
};

/// A run of statements without a branch: its work, by the author's lines.
struct WorkSite {
    std::vector<std::pair<SourceLocation, double>> lines;
    size_t block = 0;            ///< index in WorkText::blocks
    std::vector<NodeId> calls{}; ///< definitions of the functions that it calls
    double work() const;
};

/// The body of a function or of a loop. A device that runs both sides of branches runs all of its sites
/// equally often.
struct WorkBlock {
    NodeId function = k_no_node;    ///< its definition; k_no_node: the body of a loop
    std::optional<size_t> around{}; ///< index of the block around a loop
    size_t site = 0;                ///< of a loop: the site that counts how often the device runs the body
};

struct WorkText {
    text::MappedText text;
    std::vector<WorkSite> sites;
    std::vector<WorkBlock> blocks{}; ///< those of functions in the order of their definitions
    NodeId main_image = k_no_node;
    std::vector<double> own{};    ///< for each node: its work as counted, without the nodes inside it
    std::vector<bool> repeated{}; ///< for each node: its value was computed just before, so it counts nothing
};

enum class WorkAnswer {
    total, ///< a lens: the work of the pixel
    sites, ///< how often the pixel ran sites 4 n to 4 n + 3, for the value n of the knob k_sites_knob
};
inline constexpr std::string_view k_sites_knob = "tidemark_sites";

/// Counts the operations that a pixel executes, weighted. Leaves out what compilers leave out: constants, and
/// what the colour does not depend on.
Result<WorkText> count_operations(const ParsedText& text, const TreeFacts& facts, WorkAnswer answer,
                                  const WorkWeights& weights = {});

// Does the operations of one line a second time, so that the time of drawing shows what the line costs.

/// The second time has operands that are shifted by a zero that no compiler knows, and its result is added
/// times that zero: the picture keeps its bytes. Calls of the author's functions are not repeated.
struct LineTwice {
    std::string text;    ///< for the driver
    std::string control; ///< for the driver: it has the shifted operands without the operations
    double work = 0;     ///< of the line, as counted: of each operation once
    double repeated = 0; ///< counted work of the operations that `text` does a second time
};
/// Fails (ErrorCode::load) if less than half of the line's work can be repeated: heads of loops, calls and
/// changes of variables stay as they are. `counted` must belong to the same text.
Result<LineTwice> do_line_twice(const ParsedText& text, const TreeFacts& facts, const WorkText& counted,
                                const SourceLocation& place, const WorkWeights& weights = {});
/// Returns the same text with no line done twice, to compare with.
std::string do_no_line_twice(const ParsedText& text);

} // namespace tidemark::glsl
