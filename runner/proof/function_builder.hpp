// Appends instructions to a Function, and expands functions of several operations: dot products, lengths,
// linear algebra. Sums are evaluated from left to right.
#pragma once

#include "proof/function.hpp"

#include <bit>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

namespace tidemark::proof {

using Values = std::vector<Value>;

class FunctionBuilder {
public:
    Function function;
    int line = 0;

    Value add(Op op, Scalar type, std::span<const Value> operands, uint32_t immediate = 0);
    Value add(Op op, Scalar type, std::initializer_list<Value> operands, uint32_t immediate = 0) {
        return add(op, type, std::span(operands.begin(), operands.size()), immediate);
    }
    Value real(Op op, std::initializer_list<Value> operands) { return add(op, Scalar::real, operands); }
    Value constant(float value) { return constant(std::bit_cast<uint32_t>(value), Scalar::real); }
    Value constant(uint32_t bits, Scalar type) { return add(Op::constant, type, {}, bits); }
    Scalar type_of(Value value) const { return function.instructions[value].type; }

    /// Applies the operation to each component; an operand of one component is used for all components of the
    /// others.
    Values each(Op op, Scalar type, std::span<const Values> operands);
    Values each(Op op, Scalar type, std::initializer_list<Values> operands) {
        return each(op, type, std::span(operands.begin(), operands.size()));
    }

    Value dot(const Values& a, const Values& b);
    Value length(const Values& a) { return real(Op::sqrt, {dot(a, a)}); }
    Values scaled(const Values& a, Value by) { return each(Op::multiply, Scalar::real, {a, {by}}); }
    Values difference(const Values& a, const Values& b) { return each(Op::subtract, Scalar::real, {a, b}); }
    Values normalize(const Values& a) { return scaled(a, real(Op::inverse_sqrt, {dot(a, a)})); }
    Values cross(const Values& a, const Values& b);
    Values clamp(const Values& a, const Values& low, const Values& high);
    Values smoothstep(const Values& low, const Values& high, const Values& a);
    Values reflect(const Values& incident, const Values& normal);
    Values refract(const Values& incident, const Values& normal, Value ratio);
    Values face_forward(const Values& normal, const Values& incident, const Values& reference);

    /// Matrices are column by column, with `rows` components in each.
    Values matrix_times_vector(const Values& matrix, const Values& vector);
    Values vector_times_matrix(const Values& vector, const Values& matrix);
    Values product(const Values& left, uint32_t left_columns, const Values& right);
    Values transpose(const Values& matrix, uint32_t rows);
    Values outer_product(const Values& column, const Values& row);
    Value determinant(const Values& matrix, uint32_t size);
    Values inverse(const Values& matrix, uint32_t size);

private:
    Value append(Op op, Scalar type, std::span<const Value> operands, uint32_t immediate);
};

// Rewrites an operation as another one that is equal in real arithmetic and has narrower interval bounds: in
// x - floor(x) intervals treat both x as independent, in fract(x) they do not.

struct EqualInReal {
    Op op;
    std::vector<Value> operands;
};

/// Returns another form of an instruction; nullopt if no identity applies.
std::optional<EqualInReal> equal_in_real(const Function& function, Value value);

} // namespace tidemark::proof
