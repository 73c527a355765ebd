// Finds marching loops in a Function: loops that carry a position along a ray and are left once a distance
// falls below a threshold. They are recognised by their data dependence, not by names.
#pragma once

#include "ir/function.hpp"

#include <optional>
#include <vector>

namespace tidemark::ir {

/// A value that the loop advances along the ray: start + factors * s, where s is the ray's parameter; or that
/// parameter itself.
struct Carried {
    Value phi = k_no_value;
    Value update = k_no_value; ///< its value in the next iteration
    std::vector<Value> factors{}; ///< constant in the loop
};

struct MarchingLoop {
    /// `sphere_tracing`: the distance determines the step. `fixed_step`: it does not; steps have one length,
    /// or grow with the distance travelled.
    enum class Kind { sphere_tracing, fixed_step } kind = Kind::sphere_tracing;
    uint32_t header = 0; ///< block
    uint32_t entry = 0; ///< block from which the loop is entered
    uint32_t latch = 0; ///< block that leads back to the header
    std::vector<Carried> carried;
    bool cut_at_update = false; ///< the distance is measured after the iteration's step
    bool in_next_turn = false; ///< the test reads a distance from the previous iteration
    /// A hit is distance - threshold < 0. Both are operands of the comparison.
    Value distance = k_no_value;
    Value threshold = k_no_value;
    bool at_equality = false; ///< a difference of 0 is a hit, too
    bool at_nan = false; ///< NaN is a hit, too
    bool at_hit = false; ///< a hit always ends the loop
    /// The threshold changes with the iterations, too: a hit is below its value in the first iteration at
    /// that place.
    bool threshold_by_turn = false;
    Value comparison = k_no_value;
    uint32_t test = 0; ///< block of the comparison
    /// The march ends at a small positive distance, so a negative one lies past the surface. Otherwise the
    /// march may end only below 0, or the tested value is not a distance.
    bool stops_before = false;
    /// If a carried value exceeds this, the loop ends without a hit; k_no_value if the loop has no such test.
    Value far = k_no_value;
    /// Iterations after a hit, or after `far`, do nothing: they are those in which the condition of `block`
    /// equals `when`.
    struct Idle {
        uint32_t block;
        bool when;
    };
    std::optional<Idle> idle{};
    /// Amount that an iteration adds to the ray's parameter; k_no_value if it is not known or differs between
    /// paths.
    Value advance = k_no_value;
    uint32_t step = 0; ///< block of the update
    /// Number of iterations of the counter that ends the loop first, if constants alone decide it; the
    /// distance or the place may end the loop earlier.
    std::optional<uint32_t> turns{};
    int line = 0; ///< of the comparison
    /// Number of comparisons of reals in that line of the loop, and the index of this one, in the order of
    /// the text.
    size_t comparisons = 1, which = 0;

    /// Returns whether the only carried value is the ray's parameter itself.
    bool by_parameter() const { return carried.size() == 1; }
    /// Returns whether the loop ends without a hit once the ray's parameter exceeds `far`.
    bool limited() const { return far != k_no_value && by_parameter(); }
    Value cut(const Carried& each) const { return cut_at_update ? each.update : each.phi; }
};

/// Returns at most one marching loop for each loop, in the order of the text after inlining.
std::vector<MarchingLoop> find_marching_loops(const Function& function);

} // namespace tidemark::ir
