// Estimates from the text how much work it is for a driver to compile it. A conservative guess, since drivers
// differ. Runs no driver.
#pragma once

#include "base/mapped_text.hpp"
#include "scene/scene.hpp"
#include "shader/shader_source.hpp"

#include <cstddef>

namespace tidemark::glsl {

struct DriverLoad {
    bool followed = false; ///< false: the text was not understood and the numbers are meaningless
    size_t words = 0;      ///< after macro expansion
    int depth = 0;         ///< nesting of expressions and blocks; a sum of three has depth two
    double inlined = 0;    ///< words of the longest function after inlining all calls
    int loops = 0;         ///< nested loops, calls included; a driver may unroll all of them
    /// may contain -2147483648 / -1, which crashes some drivers when they fold constants
    bool edge_of_int = false;
    double elements = 0; ///< numbers in all arrays and large structures; infinite if a length is unknown

    /// Returns whether drivers compile the text in a second or two, as measured on llvmpipe with some margin.
    bool modest() const;
};

/// Measures a text; `followed` is false if its directives cannot be evaluated. Linear in its words.
DriverLoad driver_load(const text::MappedText& source);

/// Returns whether every pass of the scene is modest in its first dialect.
bool is_modest(const scene::Scene& scene, Precision precision);

} // namespace tidemark::glsl
