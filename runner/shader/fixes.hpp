// Fixes of faults in a text, one function for each kind of fault.
//
// Fixes a texture look-up so that its mipmap level comes from the text, not from neighbouring pixels.
#pragma once

#include "shader/loops.hpp"
#include "shader/source_edits.hpp"
#include "shader/undefined_behaviour.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// Returns the tokens of a call of `texture` with a named sampler, as its author wrote them; nothing for
/// anything else.
std::optional<WrittenTokens> look_up_by_neighbours(const ParsedText& text, const TreeFacts& facts, NodeId id);

/// Sets the base level and drops a bias: a bias of -100 would also choose the base level, but it stays
/// undefined.
std::optional<Cure> base_level(const ParsedText& text, const TreeFacts& facts, const Divergent& fault);

/// Takes the mipmap's level from the derivatives of the coordinates without their jumps (textureGrad).
/// Returns nothing if the call comes from a macro.
std::optional<Cure> smooth_look_up(const ParsedText& text, const TreeFacts& facts,
                                   const JumpingLookUp& fault);

// Fixes calls whose edges are in the wrong order.

/// Writes what devices are known to compute: `min(max(x, low), high)`, and 1 minus the smooth step with the
/// edges exchanged; a step for equal edges.
std::optional<Cure> ordered_edges(const ParsedText& text, const TreeFacts& facts, const WrongEdges& fault);

// Fixes a derivative, or a look-up that chooses its mipmap, by moving it before the place where pixels
// diverge.

/// Stores its value in a variable before the body's statement in which neighbouring pixels diverge. Returns
/// nothing if the function is called where they already diverge, if a name in the expression is declared or
/// set in between, or if its type is unknown.
std::optional<Cure> hoisted_derivative(const ParsedText& text, const TreeFacts& facts,
                                       const Divergent& fault);

// Fixes reads of variables without a value by writing the zeros that ShaderToy's site uses.

/// Returns nothing for an array of unknown length or many numbers, and where the text cannot be changed.
std::optional<Cure> initial_value(const ParsedText& text, const TreeFacts& facts, const Unassigned& fault);

// Proposes guards for operations that can be outside of their domain, from one table row per function. A
// guard passes an operand that is inside the domain unchanged, bit by bit.

/// Returns the guards for a call or a quotient of floats, the simplest first. Empty if none is known or the
/// text cannot be changed there. The caller measures whether a guard helps.
std::vector<Cure> domain_guards(const ParsedText& text, const TreeFacts& facts, NodeId operation);

/// Divides the magnitude of a in `a % b` and `a / b`, where a may be negative, and gives the result the sign
/// of a: rounded towards 0. Returns nothing for `a %= b`.
std::optional<Cure> unsigned_dividend(const ParsedText& text, const TreeFacts& facts, NodeId operation);

/// Returns fixes for `mod(a, b)` and `floor(a / b)` of whole numbers, whose quotient a device with
/// reciprocals may miss: a half is added to a, so that no quotient is a whole number. Nothing if the text
/// does not show that a is whole.
std::optional<Cure> between_whole_quotients(const ParsedText& text, const TreeFacts& facts, NodeId operation);

// Proposes rewrites like those of tools for accurate expressions (P. Panchekha et al., Herbie, PLDI 2015):
// the new text is equal in real arithmetic and avoids a small difference of large numbers. The caller
// measures whether it brings the picture nearer to the one in double precision.

/// Returns one fix per place where a rule applies, in the order of the text.
std::vector<Cure> rewrites(const ParsedText& text, const TreeFacts& facts);

// Fixes phases that grow with the time by reducing them to fractions of a turn before anything is added:
// `sin(x + 50.0 * iTime)` has lost its digits after an hour, because a float's spacing grows with its size.

/// Covers sines, cosines, `fract` and `mod` by a number whose arguments have iTime times a number as a term.
/// Returns one fix per file, with a function that splits the product into exact ones and adds the part of the
/// time that the float iTime cannot hold (iTimeLow, in seconds; 0 on other hosts).
std::vector<Cure> reduced_times(const ParsedText& text, const TreeFacts& facts);

// Replaces hashes of large sines, `fract(sin(dot(p, k)) * c)` and similar, whose values differ between GPUs,
// by hashes of bits. Their values differ from the sines', too, but are the same on every GPU.

/// Returns one fix per file: a hash function before the first function that calls it, and the calls. Leaves
/// hashes whose argument is neither a float variable nor a dot product, nor a vector of dot products.
std::vector<Cure> whole_hashes(const ParsedText& text, const TreeFacts& facts);

// Changes the number of iterations of a loop whose text states it as a literal.

/// Replaces the number that `bound` counts to, so that the loop has `turns` iterations. Returns nothing if
/// there is no such number or if it cannot be changed in the text.
std::optional<Wrap> with_turns(const ParsedText& text, const LoopBound& bound, double turns);

// Fixes a loop with a float counter by counting in whole numbers and computing the float from them.

/// Writes `for (int x_turn = 0; x_turn < 100; ++x_turn) { float x = 0.0 + 0.01 * float(x_turn); … }`: as many
/// iterations as in real arithmetic, and no accumulated rounding. Returns nothing if the text is not the
/// author's own.
std::optional<Cure> whole_counter(const ParsedText& text, const FloatCounter& counter);

// Fixes marches that step over a surface or end before it: shorter steps, more of them, or a threshold that
// they can reach.

/// The place of a marching loop in its author's text.
struct MarchPlace {
    SourceLocation test;                 ///< the comparison that tests the distance
    std::vector<SourceLocation> updates; ///< the assignments that advance the position on the ray
};

/// Returns fixes with 2, 4 and 8 times the iterations; empty if the loop's head has no literal bound.
std::vector<Cure> more_turns(const ParsedText& text, MarchPlace place);

/// Returns fixes with steps of 0.8, 0.6, 0.4, 0.25 and 0.1 of the distance, without those above `longest`,
/// with as many more iterations where the bound is a literal; empty if the step is not certain.
std::vector<Cure> shorter_steps(const ParsedText& text, const MarchPlace& place, double longest);

/// Returns fixes with 4, 16, 64 and 256 times the threshold, up to 0.1; empty if the threshold is not a small
/// literal or a constant with such a value.
std::vector<Cure> larger_threshold(const ParsedText& text, const TreeFacts& facts, const MarchPlace& place);

// Builds fixes that call a function of their own, which is inserted before the first function that calls it:
// one fix per file.

class HelperFunction {
public:
    /// `name` gets a number if the text already uses it.
    HelperFunction(const ParsedText& text, std::string_view name) : text_(text), wanted_(name) {}

    /// Returns the text that replaces an expression, given the function's name; nothing: the expression
    /// stays.
    using Say = std::function<std::optional<std::string>(const std::string& name)>;
    void use(NodeId expression, const Say& say);

    /// `define` returns the function's definition for its name, on one line.
    std::vector<Cure> cures(const std::function<std::string(const std::string& name)>& define,
                            const std::string& reason) const;

private:
    struct Uses {
        std::string name;
        Wrap first; ///< token at the start of the first function that uses it
        std::vector<Wrap> wraps{};
    };

    const ParsedText& text_;
    std::string wanted_;
    std::map<std::string, Uses> files_{};
};

} // namespace tidemark::glsl
