// The functions that GLSL has for floats only, for doubles, as GLSL text. Written from the mathematics: the
// polynomials are minimax fits of our own (Remez exchange in 200 bits, coefficients rounded one after the
// other), the schemes those of the classical libraries (Cody and Waite's reduction, rational and split
// kernels). Short and without branches, because Mesa inlines every call and llvmpipe takes both sides.
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::glsl {

/// Stands in front of every name of ours in a promoted text.
inline constexpr std::string_view k_ours = "tidemark_";

/// The text of one of GLSL's functions defines `double tidemark_double_NAME` of doubles, which its overloads
/// apply to each component; that of a helper defines what it likes.
struct DoubleFunction {
    std::string_view name; ///< GLSL's, or that of a helper
    double ulp; ///< largest error in units in the last place, measured against MPFR; 0: see the text
    std::vector<std::string_view> needs; ///< names of helpers
    std::string_view text;
};

/// Every one, each after those that it needs.
std::vector<DoubleFunction> all_double_functions();

/// Whether a promoted text must call our function instead of GLSL's.
bool is_replaced(std::string_view name);

/// Names and parameter types (`sinh`, `dvec2`; commas without blanks) that the author defines.
using Signatures = std::set<std::pair<std::string, std::string>>;

/// The text of the functions `used` (GLSL's names) and of all that they need; what the author defines with
/// the same parameters is left out.
std::string double_functions(const std::set<std::string_view>& used, const Signatures& own);

// The subjects; `all_double_functions` puts them together.
std::vector<DoubleFunction> double_trigonometry();
std::vector<DoubleFunction> double_exponentials();
std::vector<DoubleFunction> double_hyperbolics();
std::vector<DoubleFunction> double_derivatives();

} // namespace tidemark::glsl
