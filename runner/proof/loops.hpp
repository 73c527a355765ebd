// Loops of a Function: data dependence, iteration counts, marching loops, slices.
//
// Data dependence between instructions, and the blocks that belong to a loop. Input for program slicing;
// nothing is changed.
#pragma once

#include "proof/function.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace tidemark::proof {

bool overlap(const Access& a, const Access& b);

/// Returns the index of the block of each instruction; 0 for constants.
std::vector<uint32_t> blocks_of_instructions(const Function& function);

/// Returns, for each block, whether it lies on a path from the loop's header back to it.
std::vector<bool> natural_loop(const Function& function, uint32_t header);

/// Returns the natural loop and the blocks in the loop's source text that leave it, such as the one before a
/// `break`. Returns an empty vector if no block leads back to the header.
std::vector<bool> text_of_loop(const Function& function, uint32_t header);

/// The instructions of a loop that a value is computed from (backward slice within the loop).
class Cone {
public:
    /// `inside[i]` is true if instruction i is in the loop. The header's phis and the values in `stops` are
    /// in the cone, but nothing that they are computed from.
    Cone(const Function& function, const std::vector<bool>& inside, uint32_t header,
         std::vector<Value> stops = {});

    /// Returns the cone of `value`, sorted.
    std::vector<Value> of(Value value) const;
    /// Returns the direct sources of a value in the loop: its operands, and for a load also the stores in the
    /// loop that may write the same cells.
    std::vector<Value> sources(Value value) const;

private:
    const Function* function_;
    const std::vector<bool>* inside_;
    std::vector<Value> stores_; ///< stores in the loop
    uint32_t first_phi_, last_phi_;
    std::vector<Value> stops_;
};

// Idle iterations of a loop: a loop whose whole body is `if (distance > eps) { … }`, without a `break`, has
// ended once the condition fails, although it continues to iterate.

struct LoopBlocks {
    const Function& function;
    const std::vector<uint32_t>& block_of; ///< of instructions
    uint32_t header;
    size_t back_slot; ///< index of the phi operand that comes from the previous iteration

    bool is_header_phi(Value value) const {
        return function.instructions[value].op == Op::phi && block_of[value] == header;
    }
};

class IdleTurn {
public:
    /// Checks whether `block`, which branches within the loop, makes an iteration idle: the path to its
    /// successor `way`, and on to the header, changes no value that the branch depends on, so no later
    /// iteration does. Returns nullopt if it does not. `cone` is the loop's.
    static std::optional<IdleTurn> find(const LoopBlocks& loop, const Cone& cone, uint32_t block, size_t way);

    /// Returns the value that `value` has in an iteration that is not idle.
    Value busy(const LoopBlocks& loop, Value value) const;

private:
    struct Edge {
        uint32_t to, from;
    };
    std::optional<size_t> slot_of(const LoopBlocks& loop, Value phi) const;
    Value idle(const LoopBlocks& loop, Value value) const;

    std::vector<Edge> edges_;
};

// Iteration count of a counting loop: from one constant, by a second, up to a third.

/// A value that the loop carries; it ends the loop once `smaller` is below `larger`.
struct LoopCounter {
    Value phi, first, next;
    Value smaller, larger;
    bool at_equality; ///< also ends it if they are equal
};

/// Returns the number of full iterations before it ends the loop; nullopt if it counts otherwise, or for over
/// a million iterations.
std::optional<uint32_t> turns_of(const Function& function, const LoopCounter& counter);

// Finds marching loops in a Function: loops that carry a position along a ray and are left once a distance
// falls below a threshold. They are recognised by their data dependence, not by names.

/// A value that the loop advances along the ray: start + factors * s, where s is the ray's parameter; or that
/// parameter itself.
struct Carried {
    Value phi = k_no_value;
    Value update = k_no_value;    ///< its value in the next iteration
    std::vector<Value> factors{}; ///< constant in the loop
};

struct MarchingLoop {
    /// `sphere_tracing`: the distance determines the step. `fixed_step`: it does not; steps have one length,
    /// or grow with the distance travelled.
    enum class Kind { sphere_tracing, fixed_step } kind = Kind::sphere_tracing;
    uint32_t header = 0; ///< block
    uint32_t entry = 0;  ///< block from which the loop is entered
    uint32_t latch = 0;  ///< block that leads back to the header
    std::vector<Carried> carried;
    bool cut_at_update = false; ///< the distance is measured after the iteration's step
    bool in_next_turn = false;  ///< the test reads a distance from the previous iteration
    /// A hit is distance - threshold < 0. Both are operands of the comparison.
    Value distance = k_no_value;
    Value threshold = k_no_value;
    bool at_equality = false; ///< a difference of 0 is a hit, too
    bool at_nan = false;      ///< NaN is a hit, too
    bool at_hit = false;      ///< a hit always ends the loop
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
    /// The tests of counters that end the loop after a constant number of iterations, and the result with
    /// which it continues.
    struct CounterTest {
        Value comparison;
        bool continues;
    };
    std::vector<CounterTest> counter_tests{};
    /// The code after the loop may return from the last place to one between it and the place before: it
    /// subtracts a step, hands the place to another loop, or reads what the loop kept of the iteration
    /// before.
    bool goes_back = false;
    /// Another loop goes on along the ray from the last place, or from a place some way before or after it:
    /// the march is a bound for that loop, as for the density of clouds, and its end is no surface.
    bool hands_on = false;
    /// Each iteration also adds to another real what depends on the field, such as a glow or a density.
    bool accumulates = false;
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

/// Returns whether a loop after the one of those instructions begins at the last place of its marcher, `phi`
/// and `update`, perhaps after a sum (MarchingLoop::hands_on).
bool another_goes_on(const Function& function, const std::vector<uint32_t>& block_of,
                     const std::vector<bool>& inside, Value phi, Value update);

/// Returns at most one marching loop for each loop, in the order of the text after inlining.
std::vector<MarchingLoop> find_marching_loops(const Function& function);

// One iteration of a marching loop as a Function of its own: only the instructions that the tested distance
// depends on (program slicing: M. Weiser, IEEE Transactions on Software Engineering 10, 1984). Values that
// are constant along a ray are computed before it (loop-invariant code motion).

struct LoopSlice {
    MarchingLoop loop; ///< in the whole function
    /// Block 0 computes the values that are constant along a ray, then jumps to the header.
    Function function;
    MarchingLoop turn; ///< the loop in `function`, without factors and limit
    /// the values of the whole function that the first instructions of `function` stand for
    std::vector<Value> inputs;
    std::vector<uint32_t> cells; ///< the cells of the whole function that the cells of `function` stand for
    bool stores = false;         ///< an iteration writes to memory
};

/// End of a slice.
enum class SliceOf {
    distance, ///< up to the test
    step ///< and on to the step that is added to the ray's parameter; `advance` of the loop has to be known
};

LoopSlice slice_of(const Function& function, const MarchingLoop& loop, SliceOf what = SliceOf::distance);

} // namespace tidemark::proof
