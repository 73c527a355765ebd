// A shader as it could come out on another GPU: the same text with sines, inputs or the results of its sums
// and products off by what drivers differ in. Text in, text out. Which of a text's variations is drawn is
// said by a uniform, so that one program serves them all.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <cstddef>
#include <string>

namespace tidemark::glsl {

struct Variation {
    std::string text;
    std::string mode_uniform; ///< int; 0: as it is
    size_t places = 0;        ///< that are varied
};

/// Of vary_sines.
enum class SineMode {
    as_is,
    unit_up, ///< each sine and cosine a unit in the last place larger in magnitude
    unit_down,
    like_nvidia ///< fract(x * (1 / 2 pi in binary32)) of a turn, results on a grid of 2^-22
};

/// `sin` and `cos` as other GPUs have them. The model of NVIDIA's is that of its special function unit: the
/// argument is reduced with a rounded 1 / 2 pi, so that its error grows with the argument (2.4e-8 of it), and
/// the result has an absolute error, not a relative one.
Variation vary_sines(const ParsedText& text, const TreeFacts& facts);

/// Mode 1: iTime, iResolution and iMouse a unit in the last place larger.
Variation vary_inputs(const ParsedText& text, const TreeFacts& facts);

/// Mode 1: every second quotient, root, power, exponential and logarithm, by lot, a unit in the last place up
/// or down. GLSL lets those be off by two units and more, and rounds + - * correctly (4.50, 4.7.1).
Variation vary_rounding(const ParsedText& text, const TreeFacts& facts);

/// Mode 1: where an operand of + or -, or the value of += or -=, is a product of floats, its sum is rounded
/// only once, to 0.5 + 2^-30 units in the last place (the product is exact in double, the sum in double
/// nearly so); `dot` is a chain of such sums. As GPUs do with one instruction. Needs doubles, which GLSL ES
/// has not. Products that come in variables, and those of matrices, are as they were.
Variation vary_contraction(const ParsedText& text, const TreeFacts& facts);

/// Sums of three and more, `a + b + c`, added up from their other end. It has no modes.
Variation vary_order(const ParsedText& text, const TreeFacts& facts);

/// Mode 1: every result of + - * / in ten bits behind the first and up to 65504, as phones compute `mediump`.
/// 0 places where the text asks for no such thing.
Variation vary_halves(const ParsedText& text, const TreeFacts& facts);

/// Variables of floats `precise`: nothing is contracted or reordered. It has no modes.
Variation vary_precision(const ParsedText& text, const TreeFacts& facts);

} // namespace tidemark::glsl
