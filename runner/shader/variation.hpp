// Varies a shader as other GPUs could compute it: the same text with sines, inputs or the results of its sums
// and products changed by as much as drivers differ. Text in, text out. A uniform selects the variation, so
// that one program serves them all.
#pragma once

#include "shader/parsed_text.hpp"
#include "shader/tree_facts.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

class SourceRewriter;

struct Variation {
    std::string text;
    std::string mode_uniform;   ///< int; 0: unchanged
    std::vector<NodeId> places; ///< the changed nodes
    /// int, of vary_like_swiftshader: bit N is set if iChannelN takes the nearest texel, bit 16 + N if it
    /// filters linearly; bit 4 + N if its texels are bytes, bit 20 + N if they are others.
    std::string filters_uniform{};
};

/// Returns whether a variation may change a node; empty: it may change all.
using MayVary = std::function<bool(NodeId)>;

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
Variation vary_sines(const ParsedText& text, const TreeFacts& facts, const MayVary& may = {});

/// Mode 1: iTime, iResolution and iMouse are one unit in the last place larger.
Variation vary_inputs(const ParsedText& text, const TreeFacts& facts, const MayVary& may = {});

/// Mode 1: about half of the quotients, roots, powers, exponentials and logarithms, chosen by their bits, are
/// one unit in the last place larger or smaller. GLSL allows errors of two units and more for those, and
/// rounds + - * correctly (4.50, 4.7.1).
Variation vary_rounding(const ParsedText& text, const TreeFacts& facts, const MayVary& may = {});

/// Mode 1: does the same with all results of + - * / and of functions, as if no operation were rounded as
/// GLSL requires: a text whose picture changes amplifies its roundings.
Variation vary_last_bits(const ParsedText& text, const TreeFacts& facts, const MayVary& may = {});

/// Mode 1: where an operand of + or -, or the value of += or -=, is a product of floats, the sum is rounded
/// only once, to 0.5 + 2^-30 units in the last place (the product is exact in double, the sum nearly so);
/// `dot` is a chain of such sums. GPUs do this with one instruction. Needs doubles, which GLSL ES lacks.
/// Products stored in variables, and products of matrices, are unchanged.
Variation vary_contraction(const ParsedText& text, const TreeFacts& facts, const MayVary& may = {});

/// Adds sums of three and more terms, `a + b + c`, from the other end. It has no modes.
Variation vary_order(const ParsedText& text, const TreeFacts& facts, const MayVary& may = {});

/// Mode 1: rounds every result of + - * / to eleven significant bits, up to 65504, as phones compute
/// `mediump`. Has 0 places if the text uses neither mediump nor lowp.
Variation vary_halves(const ParsedText& text, const TreeFacts& facts, const MayVary& may = {});

/// Mode 1: a look-up that chooses its mipmap itself chooses one half a level coarser; mode 2: finer. How
/// a device measures the distance of neighbouring pixels' coordinates is its own affair.
Variation vary_mipmaps(const ParsedText& text, const TreeFacts& facts, const MayVary& may = {});

/// Mode 1: derivatives are taken for each pixel of a block of 2x2; mode 2: once for the block.
Variation vary_derivatives(const ParsedText& text, const TreeFacts& facts, const MayVary& may = {});

/// Declares float variables `precise`: nothing is contracted or reordered. It has no modes.
Variation vary_precision(const ParsedText& text, const TreeFacts& facts, const MayVary& may = {});
/// Declares a float variable of a function `precise`. Returns whether the node declares one.
bool make_precise(const ParsedText& text, NodeId id, SourceRewriter& edits);

/// Formulas that a compiler chooses for built-in functions, as bits of a mode.
enum class FormulaPart {
    first_component = 1, ///< dot products of three and more components are summed from the first one on
    last_component = 2,  ///< or from the last one on
    root = 4,            ///< pow(x, 0.5) is a square root
};

/// Computes with the formulas whose bits the mode has. `length`, `distance`, `normalize`, `reflect`,
/// `refract` and a vector times a matrix are made of dot products.
Variation vary_formulas(const ParsedText& text, const TreeFacts& facts, const MayVary& may = {});
/// Does the same, and declares float variables `precise`.
Variation vary_precise_formulas(const ParsedText& text, const TreeFacts& facts, const MayVary& may = {});

/// Kinds of operations that SwiftShader computes in its own way, as bits.
enum class SwiftShaderPart {
    sines = 1,         ///< a polynomial of degree 5: up to 1.5e-4 off
    arcs = 2,          ///< atan, asin and acos, and functions of constants, which its compiler computes
    powers = 4,        ///< pow, exp, log and what is made of them
    products = 8,      ///< dot products, matrices, quotients, mix: the order of operations
    outside = 16,      ///< pow and log of negative numbers, clamp and min of NaN, %
    mipmaps = 32,      ///< the choice of the mipmap, and no shortcut between two
    weights = 64,      ///< of linear texture filters
    derivatives = 128, ///< one for a block of 2x2 pixels
    order = 256,       ///< an operator reads its variables before an expression to its right sets them
};
inline constexpr int k_swiftshader_parts = 9;
/// A further bit of a mode: quotients by zero have the opposite sign, and zero by zero is 0.5. A picture that
/// changes shows them.
inline constexpr int k_opposite_quotients = 0x40000;

/// The order of operations in a text of vary_like_swiftshader.
enum class SwiftOrder {
    driver,   ///< the driver chooses it, except within functions of SwiftShader's
    text,     ///< that of the text: float variables are `precise`
    compiler, ///< the driver merges only what SPIRV-Tools merges: a constant with that of an operand
};

/// Computes as SwiftShader does, bit for bit except for textures, the `parts` whose bits the mode has.
Variation vary_like_swiftshader(const ParsedText& text, const TreeFacts& facts, int parts,
                                SwiftOrder order = SwiftOrder::driver, const MayVary& may = {});
/// Returns the parts that each node of the text belongs to.
std::vector<int> swiftshader_parts(const ParsedText& text, const TreeFacts& facts);

/// Reads of variables, or of parts of variables, to the left of an expression that sets them, sorted.
struct ReadsBeforeSettings {
    /// An operator or a function reads them: `c` in `c * 2.0 + c++`. ANGLE reads them before; Mesa sets them
    /// before, because it puts off operators. Neither puts off calls of the author's functions.
    std::vector<NodeId> early;
    /// Names that are operands themselves: `c` in `c + c++`. Both read them last.
    std::vector<NodeId> late;
};
ReadsBeforeSettings reads_before_settings(const ParsedText& text, const TreeFacts& facts);

/// Returns whether SwiftShader's compiler computes the built-in function of values that it knows.
bool is_folded_by_swiftshader(std::string_view name);
/// Returns expressions, sorted, whose values SwiftShader's compiler does not know, although a driver's
/// compiler may: calls of functions that it does not compute, and variables that a loop sets, in the loop and
/// after it. `known`: find_known of the text.
std::vector<NodeId> find_unknown(const ParsedText& text, const TreeFacts& facts,
                                 const std::vector<bool>& known);

/// A mode of a variation, with its name for reports.
struct VariationMode {
    int number;
    const char* name;
    bool of_devices = true; ///< there are devices that compute so
};

/// A way to vary a text, with the modes that it offers.
struct VariedArithmetic {
    std::function<Variation(const ParsedText& text, const TreeFacts& facts, const MayVary& may)> vary;
    std::vector<VariationMode> modes;
};

/// Returns the sines of other GPUs.
VariedArithmetic varied_sines();
/// Returns the last bits of what the host gives to the text.
VariedArithmetic varied_inputs();
/// Returns the roundings of operations by other GPUs and drivers, except for sines and `mediump`.
std::vector<VariedArithmetic> varied_operations();
/// Returns those of sums and products only.
std::vector<VariedArithmetic> varied_sums();
/// Returns the formulas of other compilers.
std::vector<VariedArithmetic> varied_formulas();
/// Returns the inputs and the operations.
std::vector<VariedArithmetic> varied_roundings();

} // namespace tidemark::glsl
