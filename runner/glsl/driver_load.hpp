// How much a text may ask of a driver that compiles it, counted from the text: an estimate to be careful by,
// for drivers differ in what they can bear. Runs no driver.
#pragma once

#include "glsl/dialect.hpp"
#include "scene/scene.hpp"
#include "text/mapped_text.hpp"

#include <cstddef>

namespace tidemark::glsl {

struct DriverLoad {
    bool followed = false;    ///< else the numbers say nothing
    size_t words = 0;         ///< with all macros expanded
    int depth = 0;            ///< of expressions and blocks in each other; a sum of three is two deep
    double inlined = 0;       ///< words of the longest function, where each call is its function's text
    int loops = 0;            ///< in each other, through calls too: a driver may write out the turns of all
    bool edge_of_int = false; ///< -2147483648 / -1 may be in it, which drivers that fold constants trip over
    double elements = 0;      ///< numbers in all arrays together; infinite where a length is not known

    /// Within what drivers compile in a second or two, as measured on llvmpipe with some room.
    bool modest() const;
};

/// Of a text without directives that nobody can evaluate; linear in its words.
DriverLoad driver_load(const text::MappedText& source);

/// Whether every pass of the scene is modest in the first dialect that it is offered in.
bool is_modest(const scene::Scene& scene, Precision precision);

} // namespace tidemark::glsl
