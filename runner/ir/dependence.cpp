#include "ir/dependence.hpp"

#include <algorithm>
#include <iterator>

namespace tidemark::ir {

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

} // namespace tidemark::ir
