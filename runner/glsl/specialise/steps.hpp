// An expression taken apart into its operations, each of which can be given a variable.
#pragma once

#include "glsl/specialise/globals.hpp"
#include "glsl/specialise/value_types.hpp"

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// An operation on floats whose type is known and that is carried out in any case.
struct Step {
    NodeId node = k_no_node;
    ValueType type;
};

/// The type of what a call of one of the author's functions gives.
using TypeOfCall = std::function<std::optional<ValueType>(NodeId call)>;

/// Those of an expression without effects, operands first; `locals` hide `globals`.
std::vector<Step> find_steps(const ParsedText& text, NodeId expression, const Variables& locals,
                             const Variables& globals, const TypeOfCall& type_of_own);

} // namespace tidemark::glsl
