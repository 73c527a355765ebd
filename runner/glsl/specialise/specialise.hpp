// A text without what its program does not need: globals that `main` cannot reach, branches that the knobs
// close, and work in loops that has one value for the frame. Text in, text out; no line moves.
#pragma once

#include "scene/knob.hpp"
#include "text/mapped_text.hpp"

#include <span>
#include <string>

namespace tidemark::glsl {

/// How much is left out. Each does what those before it do.
enum class Specialise : unsigned char {
    nothing,
    unreachable,        ///< functions, variables and structures: the driver makes the same code of what stays
    invariant_uniforms, ///< knobs stand still: what they decide, and what loops work out in vain. The
                        ///< language promises the same values; a driver that rearranges sums may round them
                        ///< differently
    constants ///< and knobs are constants, which the driver folds into its arithmetic: other roundings
};

/// What was done to a text.
struct LeftOut {
    int lines = 0;                            ///< of the author's that are empty now
    int branches = 0;                         ///< closed by knobs or constants
    int loop_invariants = 0;                  ///< expressions out of loops
    int constants = 0;                        ///< knobs
    std::string kept_whole = "not asked for"; ///< why nothing was done; empty where something was

    bool anything() const { return kept_whole.empty(); }
    /// Whether a driver may round differently.
    bool in_doubt() const { return branches + loop_invariants + constants > 0; }
};

struct Specialised {
    text::MappedText source;
    LeftOut left_out{};
};

/// `source` is what a driver would get. A text that cannot be followed stays as it is.
Specialised specialise(const text::MappedText& source, std::span<const scene::Knob> knobs, Specialise how);

} // namespace tidemark::glsl
