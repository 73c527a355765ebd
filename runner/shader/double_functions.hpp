// GLSL text of the functions that GLSL has for floats only, in double precision. Written from the
// mathematics: the polynomials are our own minimax fits (Remez exchange in 200 bits, coefficients rounded one
// after the other), and the schemes are those of the classical libraries (Cody and Waite's reduction,
// rational and split kernels). Short and without branches, because Mesa inlines every call and llvmpipe
// executes both sides.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::glsl {

/// Prefix of every generated name in a promoted text.
inline constexpr std::string_view k_ours = "tidemark_";

/// One function. The text of a GLSL function defines `double tidemark_double_NAME` of doubles, which the
/// generated overloads apply to each component; the text of a helper defines what its callers need.
struct DoubleFunction {
    std::string_view name; ///< GLSL's name, or that of a helper
    double ulp; ///< largest error in units in the last place, measured against MPFR; 0: see the text's
                ///< comment
    std::vector<std::string_view> needs; ///< names of helpers
    std::string_view text;
};

/// Returns all functions, each after those that it needs.
std::vector<DoubleFunction> all_double_functions();

/// Returns whether a promoted text must call our function instead of GLSL's.
bool is_replaced(std::string_view name);

/// Names and parameter types (`sinh`, `dvec2`; commas without blanks) that the author defines.
using Signatures = std::set<std::pair<std::string, std::string>>;

/// Returns the text of the functions `used` (GLSL's names) and of all that they need, without those that the
/// author defines with the same parameters.
std::string double_functions(const std::set<std::string_view>& used, const Signatures& own);

// The functions by subject; all_double_functions joins them.
std::vector<DoubleFunction> double_trigonometry();
std::vector<DoubleFunction> double_exponentials();
std::vector<DoubleFunction> double_hyperbolics();
std::vector<DoubleFunction> double_derivatives();

} // namespace tidemark::glsl
