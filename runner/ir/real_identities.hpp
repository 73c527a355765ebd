// What is the same number in real arithmetic, written so that intervals see more of it: in x - floor(x) they
// do not see that both x are one, in fract(x) they do.
#pragma once

#include "ir/function.hpp"

#include <optional>
#include <vector>

namespace tidemark::ir {

struct EqualInReal {
    Op op;
    std::vector<Value> operands;
};

/// Another form of an instruction; none where no identity is known.
std::optional<EqualInReal> equal_in_real(const Function& function, Value value);

} // namespace tidemark::ir
