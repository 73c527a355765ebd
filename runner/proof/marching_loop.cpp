#include "proof/loops.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace tidemark::proof {
namespace {

/// A comparison that ends the loop: it does so if `smaller` is below `larger`.
struct ExitTest {
    Value smaller, larger;
    bool at_equality; ///< also ends it if they are equal
    bool at_nan;      ///< also ends it if one of them is NaN
    bool alone;       ///< needs no other condition
    Value comparison;
    uint32_t block;
    int line;
};

/// A real value that the loop carries, and the amount that an iteration adds to it.
struct Step {
    Value phi, update, added;
    Value core; ///< the factor of `added` that changes in the loop; k_no_value: it does not change
    std::vector<Value> factors; ///< the other factors
    bool scales = false;        ///< `update` is `added` times `phi`, not a sum
};

class LoopReader {
public:
    using Kind = MarchingLoop::Kind;

    LoopReader(const Function& function, const std::vector<uint32_t>& block_of, uint32_t header)
        : function_(function), block_of_(block_of), header_(header), blocks_(natural_loop(function, header)),
          inside_(function.instructions.size()) {
        for (Value i = function.blocks[0].first; i < inside_.size(); ++i)
            inside_[i] = blocks_[block_of[i]];
        const auto& predecessors = function.blocks[header].predecessors;
        const auto back = std::ranges::find_if(predecessors, [&](uint32_t each) { return blocks_[each]; });
        if (back == predecessors.end() || predecessors.size() != 2)
            return;
        back_slot_ = size_t(back - predecessors.begin());
        read_tests();
        read_steps();
    }

    std::optional<MarchingLoop> find() const {
        std::optional<MarchingLoop> fixed;
        const std::vector<ExitTest> tests = nearness_first();
        for (const std::vector<Step>& group : groups())
            for (const bool at_update : {false, true})
                for (const ExitTest& test : tests) {
                    auto loop = march(group, at_update, test);
                    if (loop && loop->kind == MarchingLoop::Kind::sphere_tracing)
                        return loop;
                    if (loop && !fixed)
                        fixed = loop;
                }
        return fixed;
    }

    /// Returns whether the loop adds up reals and a comparison of reals ends it, as in a march whose form
    /// `find` does not support.
    bool may_march() const {
        return !steps_.empty() && std::ranges::any_of(tests_, [this](const ExitTest& test) {
            return at(test.smaller).type == Scalar::real && !count_of(test);
        });
    }
    /// Returns whether a loop, or what it reads from before it, depends on the reals that this one carries.
    bool leads_to(const MarchingLoop& later) const {
        if (blocks_[later.header])
            return false;
        std::vector<bool> depends(inside_.size());
        for (const Step& each : steps_)
            depends[each.phi] = true;
        const auto is_dependent = [&](Value value) -> bool { return depends[value]; };
        for (int pass = 0; pass < 2; ++pass) // the second one goes through the loop's phis
            for (Value value = function_.blocks[header_].first; value < depends.size(); ++value)
                depends[value] = depends[value] || std::ranges::any_of(operands(value), is_dependent);
        return std::ranges::any_of(later.carried,
                                   [&](const Carried& each) {
                                       return depends[each.phi] ||
                                              std::ranges::any_of(each.factors, is_dependent);
                                   }) ||
               depends[later.distance];
    }

private:
    const Instruction& at(Value value) const { return function_.instructions[value]; }
    std::span<const Value> operands(Value value) const { return function_.operands_of(at(value)); }
    Cone cone(std::vector<Value> stops = {}) const { return {function_, inside_, header_, std::move(stops)}; }
    LoopBlocks loop() const { return {function_, block_of_, header_, back_slot_}; }
    bool is_header_phi(Value value) const { return loop().is_header_phi(value); }

    /// Returns the tests, those of a value above a number that the loop does not change after the others: in
    /// `if (d > 10.0) return sky; if (d < 0.01) break;` the first one ends rays that are far from everything.
    std::vector<ExitTest> nearness_first() const {
        std::vector<ExitTest> tests = tests_;
        const auto nearness = [this](const ExitTest& test) { return inside_[test.smaller]; };
        std::stable_partition(tests.begin(), tests.end(), nearness);
        return tests;
    }

    void read_tests() {
        for (uint32_t block = header_; block < function_.blocks.size(); ++block) {
            const Block& here = function_.blocks[block];
            if (!blocks_[block] || here.end != Block::End::branch)
                continue;
            const bool first_leaves = !blocks_[here.successors[0]],
                       second_leaves = !blocks_[here.successors[1]];
            if (first_leaves != second_leaves)
                add_tests(here.condition, first_leaves, block);
            else if (!first_leaves && !idle_)
                for (const size_t way : {0, 1})
                    read_idle(block, way);
        }
    }

    /// An idle iteration, after which all iterations are idle, counts as the end of the loop.
    void read_idle(uint32_t block, size_t way) {
        if (idle_)
            return;
        idle_turn_ = IdleTurn::find(loop(), cone(), block, way);
        if (!idle_turn_)
            return;
        idle_ = MarchingLoop::Idle{block, way == 0};
        add_tests(function_.blocks[block].condition, way == 0, block);
    }

    /// Collects the comparisons of a condition that ends the loop if it equals `leaving`. `alone`: one of its
    /// parts is enough.
    void add_tests(Value condition, bool leaving, uint32_t block, bool alone = true, int depth = 0) {
        constexpr int k_deepest = 16;
        if (!inside_[condition] || depth > k_deepest)
            return;
        const auto parts = operands(condition);
        switch (at(condition).op) {
        case Op::logical_not: add_tests(parts[0], !leaving, block, alone, depth + 1); return;
        case Op::logical_or:
        case Op::logical_and:
        case Op::phi: // && and || with short-circuit evaluation
            for (const Value part : parts)
                add_tests(part, leaving, block, alone && is_either(condition, leaving), depth + 1);
            return;
        case Op::less:
        case Op::less_equal: {
            const bool or_equal = at(condition).op == Op::less_equal;
            const Value smaller = parts[leaving ? 0 : 1], larger = parts[leaving ? 1 : 0];
            tests_.push_back({smaller, larger, or_equal == leaving, !leaving, alone, condition,
                              block_of_[condition], at(condition).line});
            return;
        }
        default: return;
        }
    }

    /// Returns whether one part of a condition is enough to make it equal to `so`.
    bool is_either(Value condition, bool so) const {
        if (at(condition).op != Op::phi)
            return (at(condition).op == Op::logical_or) == so;
        const uint32_t merge = block_of_[condition];
        const auto& predecessors = function_.blocks[merge].predecessors;
        const auto parts = operands(condition);
        // the part that may decide alone jumps to the merge block directly
        for (size_t i = 0; i < parts.size(); ++i) {
            const Block& from = function_.blocks[predecessors[i]];
            if (parts.size() == 2 && from.end == Block::End::branch && from.condition == parts[i])
                return from.successors[so ? 0 : 1] == merge;
        }
        return false;
    }

    void read_steps() {
        const Block& here = function_.blocks[header_];
        for (Value phi = here.first; phi < here.last && at(phi).op == Op::phi; ++phi)
            if (at(phi).type == Scalar::real)
                if (const auto update = sum_with(phi, next_of(phi)))
                    steps_.push_back(step(phi, *update));
    }

    /// Finds the sum or product of `phi` and another value that `value` consists of, perhaps after a limit,
    /// perhaps on one path only.
    std::optional<Value> sum_with(Value phi, Value value, int depth = 0) const {
        constexpr int k_deepest = 6;
        if (value == phi || !inside_[value] || depth > k_deepest)
            return std::nullopt;
        const auto parts = operands(value);
        switch (at(value).op) {
        case Op::add:
        case Op::multiply:
            if (parts[0] == phi || parts[1] == phi)
                return value;
            return std::nullopt;
        case Op::phi:
        case Op::select:
        case Op::minimum:
        case Op::maximum:
            for (const Value part : parts)
                if (const auto found = sum_with(phi, part, depth + 1))
                    return found;
            return std::nullopt;
        default: return std::nullopt;
        }
    }

    Step step(Value phi, Value update) const {
        const auto parts = operands(update);
        Step result{phi, update, parts[parts[0] == phi ? 1 : 0], k_no_value, {}};
        Value core = result.added;
        if (at(update).op == Op::multiply) {
            result.scales = true;
            result.core = inside_[core] ? core : phi;
            return result;
        }
        while (inside_[core] && at(core).op == Op::multiply) {
            const auto factors = operands(core);
            const bool first = inside_[factors[0]], second = inside_[factors[1]];
            if (first == second)
                break;
            result.factors.push_back(factors[first ? 1 : 0]);
            core = factors[first ? 0 : 1];
        }
        if (inside_[core])
            result.core = core;
        else
            result.factors.push_back(core);
        return result;
    }

    /// Returns the candidates for the place on the ray: each value alone as the parameter, then the values
    /// that one step moves together.
    std::vector<std::vector<Step>> groups() const {
        std::vector<std::vector<Step>> result, together;
        for (const Step& each : steps_)
            result.push_back({each});
        for (const Step& each : steps_) {
            if (each.scales)
                continue;
            const auto same = std::ranges::find_if(
                together, [&](const std::vector<Step>& group) { return group.front().core == each.core; });
            if (same == together.end())
                together.push_back({each});
            else
                same->push_back(each);
        }
        for (const std::vector<Step>& group : together)
            if (group.size() > 1)
                result.push_back(group);
        return result;
    }

    std::optional<MarchingLoop> march(const std::vector<Step>& group, bool at_update,
                                      const ExitTest& test) const {
        std::vector<Value> cuts;
        for (const Step& each : group)
            cuts.push_back(at_update ? each.update : each.phi);
        const auto is_limit = [&](Value value, Value other) {
            return !inside_[other] && std::ranges::any_of(group, [&](const Step& each) {
                return value == each.phi || value == each.update;
            });
        };
        if (is_limit(test.smaller, test.larger) || is_limit(test.larger, test.smaller))
            return std::nullopt;
        const Cone to_cuts = cone(cuts);
        const std::vector<Value> measured = to_cuts.of(test.smaller), limit = to_cuts.of(test.larger);
        std::vector<Value> field = merged(measured, limit), others = carried_beside(field, cuts);
        std::erase_if(others, [&](Value other) {
            return !std::ranges::binary_search(measured, other) && counts_turns(other, cuts);
        });
        for (const Value other : others) {
            const std::vector<Value> before = to_cuts.of(next_of(other));
            if (!carried_beside(before, cuts).empty())
                return std::nullopt;
            field = merged(field, before);
        }
        if (tests_the_place(field, group, at_update))
            return std::nullopt;
        const std::vector<Value> moving = depending(field, cuts);
        const auto kind = computes(moving)                              ? kind_of(group.front(), field)
                          : steps_by(group.front(), test, moving, cuts) ? std::optional(Kind::sphere_tracing)
                                                                        : std::nullopt;
        if (!kind)
            return std::nullopt;
        MarchingLoop loop = loop_of(needed(group, at_update, field), at_update, test, *kind);
        loop.accumulates = std::ranges::any_of(steps_, [&](const Step& other) {
            return !other.scales && std::ranges::find(group, other.core, &Step::core) == group.end() &&
                   computes(depending(cone(cuts).of(other.added), cuts));
        });
        loop.in_next_turn = !others.empty();
        loop.threshold_by_turn = std::ranges::any_of(limit, [&](Value value) {
            return is_header_phi(value) && next_of(value) != value &&
                   std::ranges::find(cuts, value) == cuts.end() &&
                   !std::ranges::binary_search(measured, value) && counts_turns(value, cuts);
        });
        loop.stops_before = loop.kind == MarchingLoop::Kind::sphere_tracing && is_above_zero(test.larger) &&
                            !computes(depending(to_cuts.of(test.larger), cuts));
        return loop;
    }

    static std::vector<Value> merged(const std::vector<Value>& a, const std::vector<Value>& b) {
        std::vector<Value> result;
        std::ranges::set_union(a, b, std::back_inserter(result));
        return result;
    }

    /// Returns the value of a phi in the next iteration that is not idle.
    Value next_of(Value phi) const {
        const Value next = operands(phi)[back_slot_];
        return idle_turn_ ? idle_turn_->busy(loop(), next) : next;
    }

    /// Returns whether its next value consists of itself, of similar values and of the place, by sums and
    /// products only.
    bool counts_turns(Value phi, const std::vector<Value>& cuts) const {
        return !computes(made_of(phi, cuts));
    }

    /// Returns all values of the loop that `value` is computed from, in this iteration and earlier ones, up
    /// to `stops`.
    std::vector<Value> made_of(Value value, const std::vector<Value>& stops = {}) const {
        const Cone to_stops = cone(stops);
        std::vector<Value> all = to_stops.of(value);
        for (size_t before = 0; before != all.size();) {
            before = all.size();
            for (const Value each : std::vector(all))
                if (is_header_phi(each) && std::ranges::find(stops, each) == stops.end())
                    all = merged(all, to_stops.of(next_of(each)));
        }
        return all;
    }

    /// Returns the reals that the loop carries besides the place on the ray. A distance that is tested in the
    /// next iteration is one; if it also depends on itself, it is not a function of the place.
    std::vector<Value> carried_beside(const std::vector<Value>& values,
                                      const std::vector<Value>& cuts) const {
        std::vector<Value> result;
        for (const Value value : values)
            if (is_header_phi(value) && at(value).type == Scalar::real && next_of(value) != value &&
                std::ranges::find(cuts, value) == cuts.end())
                result.push_back(value);
        return result;
    }

    /// Returns whether the test compares the distance travelled, not a distance to a surface.
    static bool tests_the_place(const std::vector<Value>& field, const std::vector<Step>& group,
                                bool at_update) {
        return !at_update && std::ranges::any_of(group, [&](const Step& each) {
            return std::ranges::binary_search(field, each.update);
        });
    }

    /// Removes the carried values that the field does not read. A second counter of the distance travelled
    /// may be updated after the test, and then belongs to another iteration.
    static std::vector<Step> needed(std::vector<Step> group, bool at_update,
                                    const std::vector<Value>& field) {
        std::erase_if(group, [&](const Step& each) {
            return !std::ranges::binary_search(field, at_update ? each.update : each.phi);
        });
        return group;
    }

    /// Returns those of the values that change with the place.
    std::vector<Value> depending(const std::vector<Value>& values, const std::vector<Value>& cuts) const {
        const Cone loop = cone();
        std::vector<Value> result(cuts);
        std::ranges::sort(result);
        for (size_t before = 0; before != result.size();) {
            before = result.size();
            for (const Value value : values)
                if (!std::ranges::binary_search(result, value) &&
                    std::ranges::any_of(loop.sources(value), [&](Value source) {
                        return std::ranges::binary_search(result, source);
                    }))
                    result.insert(std::ranges::upper_bound(result, value), value);
        }
        return result;
    }

    /// Returns whether the operation is more than a sum or product, so that it may be part of a field.
    bool is_computed(Value value) const {
        switch (at(value).op) {
        case Op::add:
        case Op::subtract:
        case Op::multiply:
        case Op::negate:
        case Op::absolute:
        case Op::phi:
        case Op::load:
        case Op::store:
        case Op::constant: return false;
        default: return at(value).type == Scalar::real;
        }
    }
    bool computes(const std::vector<Value>& values) const {
        return std::ranges::any_of(values, [this](Value value) { return is_computed(value); });
    }

    /// Returns the kind of march: `sphere_tracing` if the step is computed from the field's values;
    /// `fixed_step` if it consists of sums and products of constants, the distance travelled and iteration
    /// counts.
    std::optional<MarchingLoop::Kind> kind_of(const Step& step, const std::vector<Value>& field) const {
        std::vector<Value> added = cone().of(step.added);
        for (const Value value : std::vector(added))
            if (is_header_phi(value) && value != step.phi)
                added = merged(added, cone().of(next_of(value)));
        std::vector<Value> shared;
        std::ranges::set_intersection(added, field, std::back_inserter(shared));
        if (computes(shared))
            return MarchingLoop::Kind::sphere_tracing;
        if (step.core == k_no_value || step.core == step.phi || !computes(made_of(step.added)))
            return MarchingLoop::Kind::fixed_step;
        return std::nullopt;
    }

    /// Returns whether the loop steps by the tested distance, perhaps scaled or limited, and the place comes
    /// into that distance through a direction. Such a field may consist of sums, products and absolute values
    /// only, as those of planes and octahedra do.
    bool steps_by(const Step& step, const ExitTest& test, const std::vector<Value>& moving,
                  const std::vector<Value>& cuts) const {
        const auto is_place = [&](Value value) { return std::ranges::find(cuts, value) != cuts.end(); };
        Value distance = test.smaller;
        if (inside_[distance] && at(distance).op == Op::absolute)
            distance = operands(distance)[0];
        if (inside_[distance] && is_header_phi(distance) && !is_place(distance)) // tested one iteration later
            distance = next_of(distance);
        if (step.scales || step.core == k_no_value || is_place(distance) ||
            !std::ranges::binary_search(moving, distance))
            return false;
        const std::vector<Value> added = cone({distance}).of(step.added);
        const auto is_limit = [this](Value value) {
            return at(value).op == Op::minimum || at(value).op == Op::maximum || !is_computed(value);
        };
        return std::ranges::binary_search(added, distance) && std::ranges::all_of(added, is_limit) &&
               (cuts.size() > 1 || std::ranges::any_of(moving, [&](Value value) {
                    return at(value).op == Op::multiply && is_product_with(value, moving);
                }));
    }
    /// Returns whether the value is a place times a number that is known before the loop but not constant.
    bool is_product_with(Value product, const std::vector<Value>& places) const {
        const auto parts = operands(product);
        return std::ranges::any_of(std::array{0, 1}, [&](int i) {
            const Value other = parts[size_t(1 - i)];
            return std::ranges::find(places, parts[size_t(i)]) != places.end() && !inside_[other] &&
                   at(other).op != Op::constant;
        });
    }

    /// Returns whether the code after the loop may return to a place between the last two
    /// (MarchingLoop::goes_back).
    bool goes_back(const std::vector<Step>& group) const {
        std::vector<Value> places;
        for (const Step& each : group)
            places.insert(places.end(), {each.phi, each.update});
        std::vector<Value> kept = kept_of_last(places);
        const auto is_in = [](const std::vector<Value>& values, Value value) {
            return std::ranges::find(values, value) != values.end();
        };
        for (Value value = function_.blocks[header_].last; value < inside_.size(); ++value) {
            if (inside_[value])
                continue;
            const auto parts = operands(value);
            if (std::ranges::any_of(parts, [&](Value part) { return is_in(kept, part); }))
                return true;
            if (at(value).op == Op::phi && at(value).type == Scalar::real &&
                std::ranges::any_of(parts, [&](Value part) { return is_in(places, part); })) {
                if (function_.blocks[block_of_[value]].loop)
                    return true;
                places.push_back(value);
            }
            if (at(value).op == Op::subtract && is_in(places, parts[0]) &&
                (at(parts[1]).op != Op::constant || parts[1] == group.front().added))
                return true;
        }
        return false;
    }
    /// Returns the reals that the loop carries from one iteration to the next without adding to them: what it
    /// keeps of the iteration before.
    std::vector<Value> kept_of_last(const std::vector<Value>& places) const {
        std::vector<Value> kept;
        const Block& here = function_.blocks[header_];
        for (Value phi = here.first; phi < here.last && at(phi).op == Op::phi; ++phi) {
            if (at(phi).type != Scalar::real || std::ranges::find(places, phi) != places.end())
                continue;
            const Value next = operands(phi)[back_slot_];
            const std::vector<Value> sources = cone(places).of(next);
            if (next != phi && inside_[next] && !std::ranges::binary_search(sources, phi))
                kept.push_back(phi);
        }
        return kept;
    }

    MarchingLoop loop_of(const std::vector<Step>& group, bool at_update, const ExitTest& test,
                         MarchingLoop::Kind kind) const {
        MarchingLoop loop;
        loop.kind = kind;
        loop.header = header_;
        loop.cut_at_update = at_update;
        loop.distance = test.smaller;
        loop.threshold = test.larger;
        loop.at_equality = test.at_equality;
        loop.at_nan = test.at_nan;
        loop.comparison = test.comparison;
        loop.at_hit = test.alone;
        loop.test = test.block;
        loop.line = test.line;
        place_in_line(loop);
        for (const uint32_t each : function_.blocks[header_].predecessors)
            (blocks_[each] ? loop.latch : loop.entry) = each;
        for (const Step& each : group)
            loop.carried.push_back({each.phi, each.update, each.factors});
        loop.idle = idle_;
        const Step& first = group.front();
        const bool plain = std::ranges::all_of(
            group, [&](const Step& each) { return !each.scales && next_of(each.phi) == each.update; });
        if (plain && !idle_)
            loop.advance = group.size() == 1 ? first.added : first.core;
        loop.step = block_of_[first.update];
        loop.goes_back = goes_back(group);
        loop.hands_on =
            group.size() == 1 && another_goes_on(function_, block_of_, inside_, first.phi, first.update);
        count_turns(loop);
        for (const ExitTest& other : tests_)
            for (const Step& each : group)
                if ((other.larger == each.phi || other.larger == each.update) && !inside_[other.smaller])
                    loop.far = other.smaller;
        return loop;
    }

    /// Finds the counters that end the loop, and the iteration count of the one that does so first.
    void count_turns(MarchingLoop& loop) const {
        for (const ExitTest& test : tests_)
            if (const auto number = count_of(test)) {
                loop.turns = std::min(loop.turns.value_or(*number), *number);
                loop.counter_tests.push_back({test.comparison, test.at_nan});
            }
    }

    /// Returns after how many iterations the test ends the loop, if it counts to a constant.
    std::optional<uint32_t> count_of(const ExitTest& test) const {
        const Block& here = function_.blocks[header_];
        for (Value phi = here.first; phi < here.last && at(phi).op == Op::phi; ++phi)
            if (const auto number = turns_of(function_, {phi, operands(phi)[1 - back_slot_], next_of(phi),
                                                         test.smaller, test.larger, test.at_equality}))
                return number;
        return std::nullopt;
    }

    /// Returns whether the value may be above zero, as far as that is known without a run.
    bool is_above_zero(Value value) const {
        return at(value).op != Op::constant || std::bit_cast<float>(at(value).immediate) > 0;
    }

    void place_in_line(MarchingLoop& loop) const {
        loop.comparisons = 0;
        for (Value value = function_.blocks[header_].first; value < inside_.size(); ++value) {
            const bool compares = at(value).op == Op::less || at(value).op == Op::less_equal;
            if (!inside_[value] || !compares || at(value).line != loop.line ||
                at(operands(value)[0]).type != Scalar::real)
                continue;
            if (value == loop.comparison)
                loop.which = loop.comparisons;
            ++loop.comparisons;
        }
    }

    const Function& function_;
    const std::vector<uint32_t>& block_of_;
    uint32_t header_;
    std::vector<bool> blocks_;
    std::vector<bool> inside_; ///< by instruction
    size_t back_slot_ = 0;     ///< index of the phi operand that comes from the previous iteration
    std::optional<MarchingLoop::Idle> idle_;
    std::optional<IdleTurn> idle_turn_;
    std::vector<ExitTest> tests_;
    std::vector<Step> steps_;
};

} // namespace

/// Leaves out a loop whose rays start where a march of an unknown form ends, such as one for shadows.
std::vector<MarchingLoop> find_marching_loops(const Function& function) {
    const std::vector<uint32_t> block_of = blocks_of_instructions(function);
    std::vector<MarchingLoop> loops;
    std::vector<LoopReader> unknown;
    for (uint32_t block = 0; block < function.blocks.size(); ++block) {
        if (!function.blocks[block].loop)
            continue;
        LoopReader reader(function, block_of, block);
        if (auto loop = reader.find()) {
            if (std::ranges::none_of(unknown, [&](const LoopReader& each) { return each.leads_to(*loop); }))
                loops.push_back(*std::move(loop));
        } else if (reader.may_march())
            unknown.push_back(std::move(reader));
    }
    return loops;
}

} // namespace tidemark::proof
