// Varies a shader as other GPUs could compute it: the same text with sines, inputs or the results of its sums
// and products changed by as much as drivers differ. Text in, text out. A uniform selects the variation, so
// that one program serves them all.
#pragma once

#include "shader/parsed_text.hpp"
#include "shader/tree_facts.hpp"

#include <cstddef>
#include <set>
#include <string>

namespace tidemark::glsl {

struct Variation {
    std::string text;
    std::string mode_uniform; ///< int; 0: unchanged
    size_t places = 0;        ///< number of changed places
};

/// Modes of vary_sines.
enum class SineMode {
    as_is,
    unit_up, ///< each sine and cosine is one unit in the last place larger in magnitude
    unit_down,
    like_nvidia ///< sine of the fraction of x * (1 / 2 pi in binary32) turns; results on a grid of 2^-22
};

/// Varies `sin` and `cos` as other GPUs compute them. The model of NVIDIA's is its special function unit: the
/// argument is reduced with a rounded 1 / 2 pi, so that the error grows with the argument (2.4e-8 of it), and
/// the result has an absolute error, not a relative one.
Variation vary_sines(const ParsedText& text, const TreeFacts& facts);

/// Mode 1: iTime, iResolution and iMouse are one unit in the last place larger.
Variation vary_inputs(const ParsedText& text, const TreeFacts& facts);

/// Mode 1: about half of the quotients, roots, powers, exponentials and logarithms, chosen by their bits, are
/// one unit in the last place larger or smaller. GLSL allows errors of two units and more for those, and
/// rounds + - * correctly (4.50, 4.7.1).
Variation vary_rounding(const ParsedText& text, const TreeFacts& facts);

/// Mode 1: where an operand of + or -, or the value of += or -=, is a product of floats, the sum is rounded
/// only once, to 0.5 + 2^-30 units in the last place (the product is exact in double, the sum nearly so);
/// `dot` is a chain of such sums. GPUs do this with one instruction. Needs doubles, which GLSL ES lacks.
/// Products stored in variables, and products of matrices, are unchanged.
Variation vary_contraction(const ParsedText& text, const TreeFacts& facts);
/// Does the same in the functions of these names only.
Variation vary_contraction_in(const ParsedText& text, const TreeFacts& facts,
                              const std::set<std::string>& functions);

/// Adds sums of three and more terms, `a + b + c`, from the other end. It has no modes.
Variation vary_order(const ParsedText& text, const TreeFacts& facts);

/// Mode 1: rounds every result of + - * / to eleven significant bits, up to 65504, as phones compute
/// `mediump`. Has 0 places if the text uses neither mediump nor lowp.
Variation vary_halves(const ParsedText& text, const TreeFacts& facts);

/// Declares float variables `precise`: nothing is contracted or reordered. It has no modes.
Variation vary_precision(const ParsedText& text, const TreeFacts& facts);

} // namespace tidemark::glsl
