#include "proof/function_builder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace tidemark::proof {
namespace {

/// Reads how a value is computed. A narrowed value counts as its first operand, the expression in the text.
class Identities {
public:
    explicit Identities(const Function& function) : function_(function) {}

    Op op(Value value) const { return function_.instructions[said(value)].op; }
    Value operand(Value value, size_t index) const {
        return function_.operands_of(function_.instructions[said(value)])[index];
    }
    bool is(Value value, float constant) const {
        const Instruction& instruction = function_.instructions[value];
        return instruction.op == Op::constant && std::bit_cast<float>(instruction.immediate) == constant;
    }

    /// Returns the operands of a sum or product, in both orders.
    std::array<std::pair<Value, Value>, 2> both_orders(Value value) const {
        const Value a = operand(value, 0), b = operand(value, 1);
        return {{{a, b}, {b, a}}};
    }
    /// Returns the other operand of a product with `factor`.
    std::optional<Value> times(Value value, float factor) const {
        if (op(value) == Op::multiply)
            for (const auto& [a, b] : both_orders(value))
                if (is(a, factor))
                    return b;
        return std::nullopt;
    }

private:
    Value said(Value value) const {
        const Instruction& instruction = function_.instructions[value];
        return instruction.op == Op::narrowed ? function_.operands_of(instruction)[0] : value;
    }

    const Function& function_;
};

using Found = std::optional<EqualInReal>;

/// Matches b floor(a / b) and b round(a / b); returns the operation and b.
std::optional<std::pair<Op, Value>> multiple_near(const Identities& read, Value value, Value a) {
    if (read.op(value) != Op::multiply)
        return std::nullopt;
    for (const auto& [unit, turns] : read.both_orders(value)) {
        const Op rounding = read.op(turns);
        if (rounding != Op::floor && rounding != Op::round)
            continue;
        const Value quotient = read.operand(turns, 0);
        if (read.op(quotient) == Op::divide && read.operand(quotient, 0) == a &&
            read.operand(quotient, 1) == unit)
            return std::pair{rounding == Op::floor ? Op::modulo : Op::nearest_rest, unit};
    }
    return std::nullopt;
}

/// Matches s (b - a); returns s and b.
std::optional<std::pair<Value, Value>> part_of_way(const Identities& read, Value value, Value a) {
    if (read.op(value) != Op::multiply)
        return std::nullopt;
    for (const auto& [share, way] : read.both_orders(value))
        if (read.op(way) == Op::subtract && read.operand(way, 1) == a)
            return std::pair{share, read.operand(way, 0)};
    return std::nullopt;
}

/// Matches a (1 - s); returns a and s.
std::optional<std::pair<Value, Value>> rest_of(const Identities& read, Value value) {
    if (read.op(value) != Op::multiply)
        return std::nullopt;
    for (const auto& [a, rest] : read.both_orders(value))
        if (read.op(rest) == Op::subtract && read.is(read.operand(rest, 0), 1))
            return std::pair{a, read.operand(rest, 1)};
    return std::nullopt;
}

/// Matches x - floor(x), x - fract(x) and similar differences.
Found of_difference(const Identities& read, Value value) {
    const Value a = read.operand(value, 0), b = read.operand(value, 1);
    const bool same = read.op(b) == Op::floor || read.op(b) == Op::fract || read.op(b) == Op::modulo;
    if (same && read.operand(b, 0) == a) {
        switch (read.op(b)) {
        case Op::floor: return EqualInReal{Op::fract, {a}};
        case Op::fract: return EqualInReal{Op::floor, {a}};
        default: return EqualInReal{Op::whole_multiple, {a, read.operand(b, 1)}};
        }
    }
    if (const auto multiple = multiple_near(read, b, a))
        return EqualInReal{multiple->first, {a, multiple->second}};
    return std::nullopt;
}

/// Matches interpolation by hand: a + s (b - a), and a (1 - s) + b s.
Found of_sum(const Identities& read, Value value) {
    for (const auto& [a, other] : read.both_orders(value)) {
        if (const auto part = part_of_way(read, other, a))
            return EqualInReal{Op::mix, {a, part->second, part->first}};
        const auto rest = rest_of(read, a);
        if (!rest || read.op(other) != Op::multiply)
            continue;
        for (const auto& [b, share] : read.both_orders(other))
            if (share == rest->second)
                return EqualInReal{Op::mix, {rest->first, b, share}};
    }
    return std::nullopt;
}

/// Matches 3 - 2 x; returns x.
std::optional<Value> of_three_less_two(const Identities& read, Value value) {
    if (read.op(value) != Op::subtract || !read.is(read.operand(value, 0), 3))
        return std::nullopt;
    return read.times(read.operand(value, 1), 2);
}

/// Matches x (6 x - 15) + 10; returns x.
std::optional<Value> of_quintic_factor(const Identities& read, Value value) {
    if (read.op(value) != Op::add)
        return std::nullopt;
    for (const auto& [ten, product] : read.both_orders(value)) {
        if (!read.is(ten, 10) || read.op(product) != Op::multiply)
            continue;
        for (const auto& [x, factor] : read.both_orders(product))
            if (read.op(factor) == Op::subtract && read.is(read.operand(factor, 1), 15) &&
                read.times(read.operand(factor, 0), 6) == x)
                return x;
    }
    return std::nullopt;
}

/// Appends all factors of a product; the factor of a square twice.
void add_factors(const Identities& read, Value value, std::vector<Value>& factors, int depth = 0) {
    constexpr int k_deepest = 3;
    const Op op = read.op(value);
    if ((op != Op::multiply && op != Op::square) || depth > k_deepest) {
        factors.push_back(value);
        return;
    }
    for (const size_t side : {size_t(0), size_t(op == Op::multiply)})
        add_factors(read, read.operand(value, side), factors, depth + 1);
}

/// Matches smooth steps by hand: x x (3 - 2 x), x x x (x (6 x - 15) + 10).
Found of_product(const Identities& read, Value value) {
    std::vector<Value> factors;
    add_factors(read, value, factors);
    for (size_t i = 0; i < factors.size(); ++i) {
        const bool hermite = factors.size() == 3;
        if (!hermite && factors.size() != 4)
            return std::nullopt;
        const auto x = hermite ? of_three_less_two(read, factors[i]) : of_quintic_factor(read, factors[i]);
        if (x && std::ranges::count(factors, *x) == long(factors.size()) - 1)
            return EqualInReal{hermite ? Op::hermite : Op::quintic, {*x}};
    }
    return std::nullopt;
}

/// Matches a minimum or maximum by hand: a < b ? a : b.
Found of_selection(const Identities& read, Value value) {
    const Value condition = read.operand(value, 0);
    if (read.op(condition) != Op::less && read.op(condition) != Op::less_equal)
        return std::nullopt;
    const Value less = read.operand(condition, 0), more = read.operand(condition, 1);
    const Value chosen = read.operand(value, 1), other = read.operand(value, 2);
    if (chosen == less && other == more)
        return EqualInReal{Op::minimum, {less, more}};
    if (chosen == more && other == less)
        return EqualInReal{Op::maximum, {less, more}};
    return std::nullopt;
}

} // namespace

std::optional<EqualInReal> equal_in_real(const Function& function, Value value) {
    const Identities read(function);
    switch (function.instructions[value].op) {
    case Op::add: return of_sum(read, value);
    case Op::subtract: return of_difference(read, value);
    case Op::multiply: return of_product(read, value);
    case Op::select: return of_selection(read, value);
    default: return std::nullopt;
    }
}

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

} // namespace tidemark::proof
