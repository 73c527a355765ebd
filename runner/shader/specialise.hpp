// Removes code that a program does not need: globals that `main` cannot reach, and work in loops that has one
// value per frame. Text in, text out; every line keeps its number.
#pragma once

#include "base/mapped_text.hpp"
#include "scene/knob.hpp"

#include <span>
#include <string>

namespace tidemark::glsl {

/// The optimisation levels. Each includes those before it.
enum class Specialise : unsigned char {
    nothing,
    unreachable, ///< functions, variables and structures: the driver compiles the rest to the same code
    invariant_uniforms, ///< moves loop-invariant work out of loops. The language guarantees the same values;
                        ///< a driver that reorders sums may round them differently
    constants ///< makes knobs constants, which the driver folds into its arithmetic: rounding differs
};

/// The changes made to a text.
struct LeftOut {
    int lines = 0;                            ///< author's lines that are empty now
    int loop_invariants = 0;                  ///< expressions moved out of loops
    int constants = 0;                        ///< knobs made constant
    std::string kept_whole = "not asked for"; ///< the reason if nothing was done; otherwise empty

    bool anything() const { return kept_whole.empty(); }
    /// Returns whether a driver may round differently.
    bool in_doubt() const { return loop_invariants + constants > 0; }
};

struct Specialised {
    text::MappedText source;
    LeftOut left_out{};
};

/// Optimises `source`, the text that a driver would get. A text that cannot be parsed is returned unchanged.
Specialised specialise(const text::MappedText& source, std::span<const scene::Knob> knobs, Specialise how);

} // namespace tidemark::glsl
