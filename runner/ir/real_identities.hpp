// Rewrites an operation as another one that is equal in real arithmetic and has narrower interval bounds: in
// x - floor(x) intervals treat both x as independent, in fract(x) they do not.
#pragma once

#include "ir/function.hpp"

#include <optional>
#include <vector>

namespace tidemark::ir {

struct EqualInReal {
    Op op;
    std::vector<Value> operands;
};

/// Returns another form of an instruction; nullopt if no identity applies.
std::optional<EqualInReal> equal_in_real(const Function& function, Value value);

} // namespace tidemark::ir
