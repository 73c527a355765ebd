// Marching loops in a Function: loops that carry a position along a ray and leave where a distance falls
// below a threshold. Found from how values depend on each other; names say nothing.
#pragma once

#include "ir/function.hpp"

#include <optional>
#include <vector>

namespace tidemark::ir {

/// A value that the loop carries forward along the ray: start + factors * s, where s is the ray's parameter;
/// or that parameter itself.
struct Carried {
    Value phi = k_no_value;
    Value update = k_no_value;    ///< what it becomes for the next turn
    std::vector<Value> factors{}; ///< do not change in the loop
};

struct MarchingLoop {
    /// The distance chooses the step; or it does not: steps of one length, or that grow with the way.
    enum class Kind { sphere_tracing, fixed_step } kind = Kind::sphere_tracing;
    uint32_t header = 0; ///< block
    uint32_t entry = 0;  ///< block that the loop is entered from
    uint32_t latch = 0;  ///< block that leads back to the header
    std::vector<Carried> carried;
    bool cut_at_update = false; ///< the distance is that of the position after the step of the turn
    bool in_next_turn = false;  ///< the test looks at a distance that the turn before has left
    /// A hit is where distance - threshold < 0; the comparison's operands.
    Value distance = k_no_value;
    Value threshold = k_no_value;
    bool at_equality = false; ///< and where it is 0
    bool at_nan = false;      ///< and where it is NaN
    bool at_hit = false;      ///< it is always left there
    /// It changes from turn to turn, too: a hit is below what it were in the first turn at that place.
    bool threshold_by_turn = false;
    Value comparison = k_no_value;
    uint32_t test = 0; ///< block of the comparison
    /// A hit is a small distance above 0: one below 0 lies past the surface. Else the march may wait for
    /// that, or what it tests is no distance.
    bool stops_before = false;
    /// Where a carried value exceeds it, the loop gives up; none: no such test.
    Value far = k_no_value;
    /// The turns behind a hit, or behind `far`, go on to do nothing: where the condition of that block is so.
    struct Idle {
        uint32_t block;
        bool when;
    };
    std::optional<Idle> idle{};
    /// What a turn adds to the ray's parameter; none: not known, or not the same on all ways.
    Value advance = k_no_value;
    uint32_t step = 0; ///< block of the update
    /// Turns that it makes at least where the distance and the place do not end it, if numbers of the text
    /// alone say so.
    std::optional<uint32_t> turns{};
    int line = 0; ///< of the comparison
    /// Comparisons of reals in that line of the loop, in the order of the text, and which of them it is.
    size_t comparisons = 1, which = 0;

    /// One value that is the ray's parameter itself.
    bool by_parameter() const { return carried.size() == 1; }
    /// It gives up where the ray's parameter exceeds `far`.
    bool limited() const { return far != k_no_value && by_parameter(); }
    Value cut(const Carried& each) const { return cut_at_update ? each.update : each.phi; }
};

/// At most one for each loop, in the order of the text after inlining.
std::vector<MarchingLoop> find_marching_loops(const Function& function);

} // namespace tidemark::ir
