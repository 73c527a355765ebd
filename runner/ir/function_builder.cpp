#include "ir/function_builder.hpp"

#include "ir/real_identities.hpp"

#include <algorithm>
#include <array>

namespace tidemark::ir {

Value FunctionBuilder::add(Op op, Scalar type, std::span<const Value> operands, uint32_t immediate) {
    // intervals cannot see that a product of equal factors is never negative
    if (op == Op::multiply && operands[0] == operands[1])
        return add(Op::square, type, operands.first(1), immediate);
    const Value result = append(op, type, operands, immediate);
    const auto equal = type == Scalar::real ? equal_in_real(function, result) : std::nullopt;
    if (!equal)
        return result;
    const Value other = append(equal->op, type, equal->operands, 0);
    return append(Op::narrowed, type, std::array{result, other}, 0);
}

Value FunctionBuilder::append(Op op, Scalar type, std::span<const Value> operands, uint32_t immediate) {
    Instruction instruction{
        op, type, immediate, uint32_t(function.operands.size()), uint32_t(operands.size()), line};
    function.operands.insert(function.operands.end(), operands.begin(), operands.end());
    function.instructions.push_back(instruction);
    return Value(function.instructions.size() - 1);
}

Values FunctionBuilder::each(Op op, Scalar type, std::span<const Values> operands) {
    size_t count = 0;
    for (const Values& operand : operands)
        count = std::max(count, operand.size());
    Values result;
    for (size_t i = 0; i < count; ++i) {
        Values components;
        for (const Values& operand : operands)
            components.push_back(operand[operand.size() == 1 ? 0 : i]);
        result.push_back(add(op, type, components));
    }
    return result;
}

Value FunctionBuilder::dot(const Values& a, const Values& b) {
    Value sum = real(Op::multiply, {a[0], b[0]});
    for (size_t i = 1; i < a.size(); ++i)
        sum = real(Op::add, {sum, real(Op::multiply, {a[i], b[i]})});
    return sum;
}

Values FunctionBuilder::cross(const Values& a, const Values& b) {
    Values result;
    for (const auto& [i, j] : {std::pair{1, 2}, std::pair{2, 0}, std::pair{0, 1}})
        result.push_back(
            real(Op::subtract, {real(Op::multiply, {a[i], b[j]}), real(Op::multiply, {b[i], a[j]})}));
    return result;
}

Values FunctionBuilder::clamp(const Values& a, const Values& low, const Values& high) {
    const Scalar type = type_of(a[0]);
    return each(Op::minimum, type, {each(Op::maximum, type, {a, low}), high});
}

Values FunctionBuilder::smoothstep(const Values& low, const Values& high, const Values& a) {
    const Values part = each(Op::divide, Scalar::real, {difference(a, low), difference(high, low)});
    return each(Op::hermite, Scalar::real, {clamp(part, {constant(0.0f)}, {constant(1.0f)})});
}

Values FunctionBuilder::reflect(const Values& incident, const Values& normal) {
    const Value twice = real(Op::multiply, {constant(2.0f), dot(normal, incident)});
    return difference(incident, scaled(normal, twice));
}

Values FunctionBuilder::refract(const Values& incident, const Values& normal, Value ratio) {
    const Value cosine = dot(normal, incident);
    const Value one = constant(1.0f);
    const Value sine2 = real(Op::multiply, {real(Op::multiply, {ratio, ratio}),
                                            real(Op::subtract, {one, real(Op::multiply, {cosine, cosine})})});
    const Value k = real(Op::subtract, {one, sine2});
    const Value root = real(Op::sqrt, {real(Op::maximum, {k, constant(0.0f)})});
    const Value along = real(Op::add, {real(Op::multiply, {ratio, cosine}), root});
    const Values bent = difference(scaled(incident, ratio), scaled(normal, along));
    const Value reflected = add(Op::less, Scalar::boolean, {k, constant(0.0f)});
    return each(Op::select, Scalar::real, {{reflected}, {constant(0.0f)}, bent});
}

Values FunctionBuilder::face_forward(const Values& normal, const Values& incident, const Values& reference) {
    const Value keeps = add(Op::less, Scalar::boolean, {dot(reference, incident), constant(0.0f)});
    return each(Op::select, Scalar::real, {{keeps}, normal, each(Op::negate, Scalar::real, {normal})});
}

Values FunctionBuilder::matrix_times_vector(const Values& matrix, const Values& vector) {
    const size_t rows = matrix.size() / vector.size();
    Values result;
    for (size_t row = 0; row < rows; ++row) {
        Values line_of;
        for (size_t column = 0; column < vector.size(); ++column)
            line_of.push_back(matrix[column * rows + row]);
        result.push_back(dot(line_of, vector));
    }
    return result;
}

Values FunctionBuilder::vector_times_matrix(const Values& vector, const Values& matrix) {
    Values result;
    for (size_t begin = 0; begin < matrix.size(); begin += vector.size())
        result.push_back(
            dot(vector, Values(matrix.begin() + long(begin), matrix.begin() + long(begin + vector.size()))));
    return result;
}

Values FunctionBuilder::product(const Values& left, uint32_t left_columns, const Values& right) {
    Values result;
    for (size_t begin = 0; begin < right.size(); begin += left_columns) {
        const Values column = matrix_times_vector(
            left, Values(right.begin() + long(begin), right.begin() + long(begin + left_columns)));
        result.insert(result.end(), column.begin(), column.end());
    }
    return result;
}

Values FunctionBuilder::transpose(const Values& matrix, uint32_t rows) {
    Values result;
    for (size_t row = 0; row < rows; ++row)
        for (size_t at = row; at < matrix.size(); at += rows)
            result.push_back(matrix[at]);
    return result;
}

Values FunctionBuilder::outer_product(const Values& column, const Values& row) {
    Values result;
    for (const Value factor : row)
        for (const Value component : column)
            result.push_back(real(Op::multiply, {component, factor}));
    return result;
}

namespace {

/// Returns the matrix without one column and one row.
Values minor_of(const Values& matrix, uint32_t size, uint32_t without_column, uint32_t without_row) {
    Values result;
    for (uint32_t column = 0; column < size; ++column)
        for (uint32_t row = 0; row < size; ++row)
            if (column != without_column && row != without_row)
                result.push_back(matrix[column * size + row]);
    return result;
}

} // namespace

/// Expands by the first column.
Value FunctionBuilder::determinant(const Values& matrix, uint32_t size) {
    if (size == 1)
        return matrix[0];
    Value sum = k_no_value;
    for (uint32_t row = 0; row < size; ++row) {
        const Value part =
            real(Op::multiply, {matrix[row], determinant(minor_of(matrix, size, 0, row), size - 1)});
        sum = row == 0 ? part : real(row % 2 == 0 ? Op::add : Op::subtract, {sum, part});
    }
    return sum;
}

/// Uses Cramer's rule.
Values FunctionBuilder::inverse(const Values& matrix, uint32_t size) {
    const Value whole = determinant(matrix, size);
    Values result;
    for (uint32_t column = 0; column < size; ++column)
        for (uint32_t row = 0; row < size; ++row) {
            const Value cofactor = determinant(minor_of(matrix, size, row, column), size - 1);
            const Value part = real(Op::divide, {cofactor, whole});
            result.push_back((column + row) % 2 == 0 ? part : real(Op::negate, {part}));
        }
    return result;
}

} // namespace tidemark::ir
