#include "proof/loops.hpp"

#include <algorithm>
#include <bit>
#include <iterator>

namespace tidemark::proof {

bool overlap(const Access& a, const Access& b) {
    return a.first < b.first + b.size && b.first < a.first + a.size;
}

std::vector<uint32_t> blocks_of_instructions(const Function& function) {
    std::vector<uint32_t> blocks(function.instructions.size());
    for (uint32_t block = 0; block < function.blocks.size(); ++block)
        std::fill(blocks.begin() + function.blocks[block].first, blocks.begin() + function.blocks[block].last,
                  block);
    return blocks;
}

std::vector<bool> natural_loop(const Function& function, uint32_t header) {
    std::vector<bool> inside(function.blocks.size());
    inside[header] = true;
    std::vector<uint32_t> open;
    for (const uint32_t predecessor : function.blocks[header].predecessors)
        if (predecessor >= header) // a back edge: blocks come after those that dominate them
            open.push_back(predecessor);
    while (!open.empty()) {
        const uint32_t block = open.back();
        open.pop_back();
        if (inside[block])
            continue;
        inside[block] = true;
        std::ranges::copy(function.blocks[block].predecessors, std::back_inserter(open));
    }
    return inside;
}

std::vector<bool> text_of_loop(const Function& function, uint32_t header) {
    const Block& first = function.blocks[header];
    if (std::ranges::none_of(first.predecessors, [&](uint32_t from) { return from >= header; }))
        return {};
    std::vector<bool> inside = natural_loop(function, header);
    for (uint32_t block = header + 1; block < inside.size(); ++block)
        if (!inside[block] && block != first.behind_loop)
            inside[block] = std::ranges::all_of(function.blocks[block].predecessors,
                                                [&](uint32_t from) { return inside[from]; });
    return inside;
}

Cone::Cone(const Function& function, const std::vector<bool>& inside, uint32_t header,
           std::vector<Value> stops)
    : function_(&function), inside_(&inside), first_phi_(function.blocks[header].first),
      last_phi_(first_phi_), stops_(std::move(stops)) {
    while (last_phi_ < function.blocks[header].last && function.instructions[last_phi_].op == Op::phi)
        ++last_phi_;
    for (Value value = first_phi_; value < inside.size(); ++value)
        if (inside[value] && function.instructions[value].op == Op::store)
            stores_.push_back(value);
}

std::vector<Value> Cone::sources(Value value) const {
    const Instruction& instruction = function_->instructions[value];
    const auto operands = function_->operands_of(instruction);
    std::vector<Value> sources(operands.begin(), operands.end());
    if (instruction.op == Op::load)
        std::ranges::copy_if(stores_, std::back_inserter(sources), [&](Value store) {
            return overlap(function_->accesses[function_->instructions[store].immediate],
                           function_->accesses[instruction.immediate]);
        });
    return sources;
}

std::vector<Value> Cone::of(Value value) const {
    std::vector<bool> seen(function_->instructions.size());
    std::vector<Value> open{value}, cone;
    while (!open.empty()) {
        const Value each = open.back();
        open.pop_back();
        if (!(*inside_)[each] || seen[each])
            continue;
        seen[each] = true;
        cone.push_back(each);
        const bool carried = each >= first_phi_ && each < last_phi_;
        if (!carried && std::ranges::find(stops_, each) == stops_.end())
            std::ranges::copy(sources(each), std::back_inserter(open));
    }
    std::ranges::sort(cone);
    return cone;
}

namespace {

bool stores(const Function& function, const Block& block) {
    const auto first = function.instructions.begin();
    return std::any_of(first + block.first, first + block.last,
                       [](const Instruction& each) { return each.op == Op::store; });
}

} // namespace

std::optional<IdleTurn> IdleTurn::find(const LoopBlocks& loop, const Cone& cone, uint32_t block, size_t way) {
    const Function& function = loop.function;
    IdleTurn turn;
    uint32_t at = function.blocks[block].successors[way];
    turn.edges_.push_back({at, block});
    while (at != loop.header) {
        const Block& here = function.blocks[at];
        if (here.end != Block::End::jump || stores(function, here))
            return std::nullopt;
        turn.edges_.push_back({here.successors[0], at});
        at = here.successors[0];
    }
    bool real = false;
    for (const Value phi : cone.of(function.blocks[block].condition)) {
        if (!loop.is_header_phi(phi))
            continue;
        if (turn.idle(loop, function.operands_of(function.instructions[phi])[loop.back_slot]) != phi)
            return std::nullopt;
        real = real || function.instructions[phi].type == Scalar::real;
    }
    return real ? std::optional(std::move(turn)) : std::nullopt;
}

/// Returns the index of the phi's operand on the idle path; nullopt if the path does not enter its block.
std::optional<size_t> IdleTurn::slot_of(const LoopBlocks& loop, Value phi) const {
    const Instruction& instruction = loop.function.instructions[phi];
    if (instruction.op != Op::phi || loop.is_header_phi(phi))
        return std::nullopt;
    const auto edge = std::ranges::find(edges_, loop.block_of[phi], &Edge::to);
    if (edge == edges_.end())
        return std::nullopt;
    const auto& predecessors = loop.function.blocks[edge->to].predecessors;
    return size_t(std::ranges::find(predecessors, edge->from) - predecessors.begin());
}

Value IdleTurn::idle(const LoopBlocks& loop, Value value) const {
    while (const auto slot = slot_of(loop, value))
        value = loop.function.operands_of(loop.function.instructions[value])[*slot];
    return value;
}

Value IdleTurn::busy(const LoopBlocks& loop, Value value) const {
    while (const auto slot = slot_of(loop, value)) {
        const auto operands = loop.function.operands_of(loop.function.instructions[value]);
        if (operands.size() != 2)
            break;
        value = operands[1 - *slot];
    }
    return value;
}

namespace {

constexpr uint32_t k_most = 1'000'000;

struct Numbers {
    Value first, added, limit;
    bool down;         ///< `added` is subtracted
    bool of_next;      ///< the test looks at the value after the iteration
    bool from_smaller; ///< the loop ends below the limit
    bool at_equality;
};

template <class Written, class Number>
std::optional<uint32_t> count(const Function& function, const Numbers& numbers) {
    const auto number = [&](Value value) {
        return Number(std::bit_cast<Written>(function.instructions[value].immediate));
    };
    const Number limit = number(numbers.limit), added = number(numbers.added);
    Number now = number(numbers.first);
    for (uint32_t turns = 0; turns < k_most; ++turns) {
        const Number next = numbers.down ? Number(now - added) : Number(now + added);
        const Number looked_at = numbers.of_next ? next : now;
        const Number smaller = numbers.from_smaller ? looked_at : limit;
        const Number larger = numbers.from_smaller ? limit : looked_at;
        if (numbers.at_equality ? smaller <= larger : smaller < larger)
            return turns;
        now = next;
    }
    return std::nullopt;
}

} // namespace

std::optional<uint32_t> turns_of(const Function& function, const LoopCounter& counter) {
    const auto at = [&](Value value) -> const Instruction& { return function.instructions[value]; };
    const Op op = at(counter.next).op;
    if (op != Op::add && op != Op::subtract)
        return std::nullopt;
    const auto parts = function.operands_of(at(counter.next));
    const bool second = parts[1] == counter.phi && op == Op::add;
    if (parts[0] != counter.phi && !second)
        return std::nullopt;
    const auto looks_at = [&](Value value) { return value == counter.phi || value == counter.next; };
    const bool from_smaller = looks_at(counter.smaller);
    if (!from_smaller && !looks_at(counter.larger))
        return std::nullopt;
    const Numbers numbers{counter.first,
                          parts[second ? 0 : 1],
                          from_smaller ? counter.larger : counter.smaller,
                          op == Op::subtract,
                          (from_smaller ? counter.smaller : counter.larger) == counter.next,
                          from_smaller,
                          counter.at_equality};
    for (const Value each : {numbers.first, numbers.added, numbers.limit})
        if (at(each).op != Op::constant)
            return std::nullopt;
    return at(counter.phi).type == Scalar::real ? count<float, float>(function, numbers)
                                                : count<int32_t, int64_t>(function, numbers);
}

namespace {

constexpr uint32_t k_no_block = ~uint32_t{0};

/// Role of an instruction of the whole function in the slice.
enum class Role : uint8_t { left_out, input, invariant, turn };

class Slicer {
public:
    Slicer(const Function& whole, const MarchingLoop& loop, SliceOf what)
        : whole_(whole), loop_(loop), with_step_(what == SliceOf::step),
          block_of_(blocks_of_instructions(whole)), kept_(whole.blocks.size()),
          roles_(whole.instructions.size()), number_(whole.instructions.size(), k_no_value) {}

    LoopSlice run() {
        keep_blocks();
        keep_instructions();
        find_invariants();
        result_.loop = loop_;
        number_all();
        number_cells();
        write_blocks();
        result_.function.lookups = whole_.lookups;
        result_.turn = turn();
        return std::move(result_);
    }

private:
    /// Keeps the blocks on a path from the header to the test; the whole loop if the test is in the next
    /// iteration.
    void keep_blocks() {
        const std::vector<bool> inside = natural_loop(whole_, loop_.header);
        std::vector<uint32_t> open{loop_.header};
        while (!open.empty()) {
            const uint32_t block = open.back();
            open.pop_back();
            if (!inside[block] || kept_[block])
                continue;
            kept_[block] = true;
            if (!ends_turn(block))
                std::ranges::copy(whole_.blocks[block].successors, std::back_inserter(open));
        }
        for (Value value = 0; value < whole_.instructions.size(); ++value)
            if (whole_.instructions[value].op == Op::store && kept_[block_of_[value]])
                stores_.push_back(value);
    }
    bool ends_turn(uint32_t block) const { return block == loop_.test && !loop_.in_next_turn && !with_step_; }

    bool is_cut(Value value) const {
        return std::ranges::any_of(loop_.carried,
                                   [&](const Carried& each) { return loop_.cut(each) == value; });
    }

    /// Keeps all that the distance, its threshold, and the path to them depend on.
    void keep_instructions() {
        keep(loop_.distance);
        keep(loop_.threshold);
        if (with_step_)
            keep(loop_.advance);
        for (const Carried& each : loop_.carried)
            keep(loop_.cut(each));
        for (uint32_t block = 0; block < kept_.size(); ++block)
            if (kept_[block] && !ends_turn(block) && whole_.blocks[block].condition != k_no_value)
                keep(whole_.blocks[block].condition);
        while (!open_.empty()) {
            const Value value = open_.back();
            open_.pop_back();
            if (!is_given(value))
                keep_operands(value);
        }
    }
    /// Returns whether the value is the place on the ray and is set from outside, because the slice has no
    /// second iteration.
    bool is_given(Value value) const { return is_cut(value) && !kept_[loop_.latch]; }
    void keep(Value value) {
        if (roles_[value] != Role::left_out)
            return;
        const bool inside = whole_.instructions[value].op != Op::constant && kept_[block_of_[value]];
        roles_[value] = inside ? Role::turn : Role::input;
        if (inside)
            open_.push_back(value);
    }
    void keep_operands(Value value) {
        for (const Value operand : operands_of(value))
            keep(operand);
        if (whole_.instructions[value].op == Op::load)
            for (const Value store : stores_)
                if (may_change(store, value))
                    keep(store);
    }
    bool may_change(Value store, Value load) const {
        return overlap(whole_.accesses[whole_.instructions[store].immediate],
                       whole_.accesses[whole_.instructions[load].immediate]);
    }

    /// Returns the operands of a value; of a phi those that come from kept blocks or from the loop's entry.
    std::vector<Value> operands_of(Value value) const {
        const auto all = whole_.operands_of(whole_.instructions[value]);
        if (whole_.instructions[value].op != Op::phi)
            return {all.begin(), all.end()};
        const auto& predecessors = whole_.blocks[block_of_[value]].predecessors;
        std::vector<Value> operands;
        for (size_t i = 0; i < all.size(); ++i)
            if (is_way(predecessors[i]))
                operands.push_back(all[i]);
        return operands;
    }
    bool is_way(uint32_t predecessor) const { return predecessor == loop_.entry || kept_[predecessor]; }

    /// Dominators come before the instructions that they dominate, so one pass finds all invariants.
    void find_invariants() {
        for (Value value = 0; value < roles_.size(); ++value)
            if (roles_[value] == Role::turn && is_invariant(value))
                roles_[value] = Role::invariant;
    }
    bool is_invariant(Value value) const {
        switch (whole_.instructions[value].op) {
        case Op::phi:
        case Op::store:
        case Op::texel:
        case Op::derivative_x:
        case Op::derivative_y: return false;
        case Op::load:
            if (is_changed(value))
                return false;
            break;
        default: break;
        }
        return !is_cut(value) && std::ranges::all_of(operands_of(value), [&](Value operand) {
            return roles_[operand] == Role::input || roles_[operand] == Role::invariant;
        });
    }
    bool is_changed(Value load) const {
        return std::ranges::any_of(
            stores_, [&](Value store) { return roles_[store] == Role::turn && may_change(store, load); });
    }

    void number_all() {
        Value next = 0;
        const auto number = [&](Role role) {
            for (Value value = 0; value < roles_.size(); ++value)
                if (roles_[value] == role) {
                    number_[value] = next++;
                    order_.push_back(value);
                }
        };
        number(Role::input);
        result_.inputs = order_;
        number(Role::invariant);
        first_of_turn_ = next;
        number(Role::turn);
        block_number_.assign(kept_.size(), k_no_block);
        uint32_t next_block = 1;
        for (uint32_t block = 0; block < kept_.size(); ++block)
            if (kept_[block])
                block_number_[block] = next_block++;
        leave_ = next_block;
    }

    void number_cells() {
        std::vector<bool> used(whole_.cells.size());
        for (const Value value : order_)
            if (is_access(value)) {
                const Access& access = whole_.accesses[whole_.instructions[value].immediate];
                std::fill_n(used.begin() + access.first, access.size, true);
            }
        std::vector<uint32_t> number(whole_.cells.size());
        for (uint32_t cell = 0; cell < used.size(); ++cell)
            if (used[cell]) {
                number[cell] = uint32_t(result_.cells.size());
                result_.cells.push_back(cell);
                result_.function.cells.push_back(whole_.cells[cell]);
            }
        result_.function.accesses = whole_.accesses;
        for (Access& access : result_.function.accesses)
            if (access.first < number.size()) // else it refers to no cell
                access.first = number[access.first];
    }
    bool is_access(Value value) const {
        const Instruction& instruction = whole_.instructions[value];
        return roles_[value] != Role::input && (instruction.op == Op::load || instruction.op == Op::store);
    }

    void write_blocks() {
        Function& function = result_.function;
        for (const Value value : order_)
            write(value);
        const auto inputs = uint32_t(result_.inputs.size());
        function.blocks.push_back({.end = Block::End::jump,
                                   .first = inputs,
                                   .last = first_of_turn_,
                                   .successors = {block_number_[loop_.header]}});
        uint32_t at = first_of_turn_;
        for (uint32_t block = 0; block < kept_.size(); ++block)
            if (kept_[block])
                function.blocks.push_back(block_of(whole_.blocks[block], at));
        function.blocks.push_back({.end = Block::End::leave, .first = at, .last = at});
    }
    void write(Value value) {
        Instruction instruction = whole_.instructions[value];
        std::vector<Value> operands;
        if (roles_[value] == Role::input) {
            if (instruction.op != Op::constant)
                instruction = {.op = Op::undefined, .type = instruction.type};
        } else {
            for (const Value operand : operands_of(value))
                operands.push_back(number_[is_given(value) ? value : operand]);
        }
        instruction.first_operand = uint32_t(result_.function.operands.size());
        instruction.operand_count = uint32_t(operands.size());
        std::ranges::copy(operands, std::back_inserter(result_.function.operands));
        result_.function.instructions.push_back(instruction);
        result_.stores = result_.stores || instruction.op == Op::store;
    }
    /// Returns the block with its kept instructions, numbered from `at` on.
    Block block_of(const Block& whole, uint32_t& at) const {
        Block block = whole;
        block.first = at;
        at += uint32_t(std::count(roles_.begin() + whole.first, roles_.begin() + whole.last, Role::turn));
        block.last = at;
        block.predecessors.clear();
        for (const uint32_t each : whole.predecessors)
            if (is_way(each))
                block.predecessors.push_back(each == loop_.entry ? 0 : block_number_[each]);
        for (uint32_t& each : block.successors)
            each = block_number_[each] == k_no_block ? leave_ : block_number_[each];
        block.condition = whole.condition == k_no_value ? k_no_value : number_[whole.condition];
        return block;
    }

    MarchingLoop turn() const {
        MarchingLoop turn = loop_;
        turn.header = block_number_[loop_.header];
        turn.entry = 0;
        turn.latch = block_number_[loop_.latch];
        turn.test = block_number_[loop_.test];
        turn.distance = number_[loop_.distance];
        turn.threshold = number_[loop_.threshold];
        turn.advance = with_step_ ? number_[loop_.advance] : k_no_value;
        turn.step = block_number_[loop_.step];
        turn.far = turn.comparison = k_no_value;
        for (Carried& each : turn.carried)
            each = {number_[each.phi], number_[each.update]};
        return turn;
    }

    const Function& whole_;
    const MarchingLoop& loop_;
    bool with_step_;
    std::vector<uint32_t> block_of_;
    std::vector<bool> kept_; ///< by block
    std::vector<Role> roles_;
    std::vector<Value> number_; ///< index in the slice
    std::vector<Value> order_;  ///< values of the whole function, in the order of the slice's instructions
    std::vector<Value> open_;
    std::vector<Value> stores_; ///< in the kept blocks
    std::vector<uint32_t> block_number_;
    Value first_of_turn_ = 0;
    uint32_t leave_ = 0;
    LoopSlice result_;
};

} // namespace

LoopSlice slice_of(const Function& function, const MarchingLoop& loop, SliceOf what) {
    return Slicer(function, loop, what).run();
}

bool another_goes_on(const Function& function, const std::vector<uint32_t>& block_of,
                     const std::vector<bool>& inside, Value phi, Value update) {
    std::vector<bool> place(inside.size());
    place[phi] = place[update] = true;
    for (Value value = function.blocks[block_of[phi]].last; value < inside.size(); ++value) {
        const Instruction& each = function.instructions[value];
        if (inside[value] || each.type != Scalar::real)
            continue;
        const auto parts = function.operands_of(each);
        const auto places = std::ranges::count_if(parts, [&](Value part) { return place[part]; });
        const bool sum =
            each.op == Op::add || each.op == Op::subtract || each.op == Op::minimum || each.op == Op::maximum;
        if (places == 0 || !(each.op == Op::phi || (sum && places == 1)))
            continue;
        if (each.op == Op::phi && function.blocks[block_of[value]].loop)
            return true;
        place[value] = each.op != Op::subtract || place[parts[0]];
    }
    return false;
}

} // namespace tidemark::proof
