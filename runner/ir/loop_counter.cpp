#include "ir/loop_counter.hpp"

#include <bit>

namespace tidemark::ir {
namespace {

constexpr uint32_t k_most = 1'000'000;

struct Numbers {
    Value first, added, limit;
    bool down; ///< `added` is subtracted
    bool of_next; ///< the test looks at the value after the iteration
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

} // namespace tidemark::ir
