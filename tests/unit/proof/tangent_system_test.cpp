// The mean value theorem, held against values in double: between two places of a piece a function changes by
// its slope there times the way between them.
#include "proof/number_systems.hpp"

#include <gtest/gtest.h>

#include <random>

namespace tidemark::proof::tangent_system_test {

constexpr int k_pieces = 2'000; ///< of each operation

using Numbers = std::array<double, 3>;

double value_of(Op op, size_t count, const Numbers& operands) {
    std::array<Point<double>, 3> points{};
    for (size_t i = 0; i < count; ++i)
        points[i].real = operands[i];
    return PointSystem<double>()
        .compute(op, Scalar::real, Scalar::real, {points[0], points[1], points[2]})
        .real;
}

/// Operands that go straight along the ray.
struct Straight {
    Numbers begin{}, slope{};

    Numbers at(double t) const {
        Numbers result{};
        for (size_t i = 0; i < result.size(); ++i)
            result[i] = begin[i] + slope[i] * t;
        return result;
    }
};

Tangent tangent_of(Op op, size_t count, const Straight& operands, const Interval& piece) {
    std::array<Tangent, 3> tangents{};
    for (size_t i = 0; i < count; ++i) {
        const double a = operands.at(piece.low)[i], b = operands.at(piece.high)[i];
        tangents[i] = {{std::min(a, b), std::max(a, b)}, {operands.slope[i], operands.slope[i]}};
    }
    return TangentSystem().compute(op, Scalar::real, Scalar::real, {tangents[0], tangents[1], tangents[2]});
}

void expect_mean_values(Op op, size_t count, const Straight& operands, const Interval& piece, double part) {
    const Tangent tangent = tangent_of(op, count, operands, piece);
    if (tangent.value.partial || !std::isfinite(tangent.slope.low) || !std::isfinite(tangent.slope.high))
        return;
    const double middle = piece.low + part * piece.width();
    const double begin = value_of(op, count, operands.at(piece.low)),
                 end = value_of(op, count, operands.at(middle));
    const double way = middle - piece.low;
    const double rounding = 1e-11 * (std::abs(begin) + std::abs(end) + 1);
    EXPECT_GE(end - begin, tangent.slope.low * way - rounding) << "operation " << int(op);
    EXPECT_LE(end - begin, tangent.slope.high * way + rounding) << "operation " << int(op);
}

class Pieces {
public:
    Straight operands() {
        Straight result;
        for (size_t i = 0; i < 3; ++i) {
            result.begin[i] = 6 * part() - 3;
            result.slope[i] = random_() % 4 == 0 ? 0 : 4 * part() - 2;
        }
        return result;
    }
    double part() { return double(random_()) / double(random_.max()); }

private:
    std::mt19937 random_{11};
};

struct Named {
    Op op;
    size_t count;
};
constexpr Named k_operations[] = {
    {Op::add, 2},       {Op::subtract, 2}, {Op::multiply, 2}, {Op::divide, 2},       {Op::modulo, 2},
    {Op::negate, 1},    {Op::square, 1},   {Op::absolute, 1}, {Op::minimum, 2},      {Op::maximum, 2},
    {Op::fract, 1},     {Op::sqrt, 1},     {Op::floor, 1},    {Op::inverse_sqrt, 1}, {Op::sin, 1},
    {Op::cos, 1},       {Op::tan, 1},      {Op::asin, 1},     {Op::acos, 1},         {Op::atan, 1},
    {Op::atan2, 2},     {Op::sinh, 1},     {Op::cosh, 1},     {Op::tanh, 1},         {Op::asinh, 1},
    {Op::acosh, 1},     {Op::atanh, 1},    {Op::exp, 1},      {Op::exp2, 1},         {Op::log, 1},
    {Op::log2, 1},      {Op::pow, 2},      {Op::mix, 3},      {Op::hermite, 1},      {Op::quintic, 1},
    {Op::remainder, 2}, {Op::sign, 1},     {Op::round, 1},    {Op::nearest_rest, 2},
};

TEST(TangentSystem, satisfies_the_mean_value_theorem) {
    Pieces pieces;
    for (const Named& operation : k_operations)
        for (int i = 0; i < k_pieces; ++i) {
            const double width = std::ldexp(1, -i % 14);
            expect_mean_values(operation.op, operation.count, pieces.operands(), {0, width}, pieces.part());
        }
}

/// Else the theorem would hold of slopes that say nothing.
TEST(TangentSystem, has_narrow_slopes_of_narrow_pieces) {
    const Straight rising{{0.4, 0.7, 0.3}, {1, 0, 0}};
    for (const Named& operation : k_operations) {
        if (operation.op == Op::acosh)
            continue; // of numbers from 1 on
        const Tangent tangent = tangent_of(operation.op, operation.count, rising, {0, 1e-6});
        EXPECT_LT(tangent.slope.width(), 1e-4) << "operation " << int(operation.op);
    }
}

TEST(TangentSystem, has_no_slope_where_a_value_jumps) {
    const Straight rising{{0.9, 1, 0}, {1, 0, 0}};
    for (const Op op : {Op::floor, Op::fract, Op::modulo})
        EXPECT_EQ(tangent_of(op, 2, rising, {0, 0.2}).slope.low, -k_infinity);
    EXPECT_EQ(tangent_of(Op::atan2, 2, {{-0.1, -1, 0}, {1, 0, 0}}, {0, 0.2}).slope.low, -k_infinity);
}

TEST(TangentSystem, has_one_sided_slopes_at_jumps_on_request) {
    TangentSystem system;
    system.jumps_aside = true;
    const Tangent wide{{0.2, 3.4}, {-1, 2}}, three{{3, 3}, {}}, none{};
    const auto slope = [&](Op op, const Tangent& a, const Tangent& b, const Tangent& c = {}) {
        return system.compute(op, Scalar::real, op == Op::select ? Scalar::boolean : Scalar::real, {a, b, c})
            .slope;
    };
    for (const Op op : {Op::fract, Op::modulo}) {
        EXPECT_LE(slope(op, wide, three).low, -1);
        EXPECT_GE(slope(op, wide, three).high, 2);
        EXPECT_TRUE(std::isfinite(slope(op, wide, three).high));
    }
    EXPECT_EQ(slope(Op::floor, wide, none).high, 0);
    const Tangent either{{0, 1}, {}};
    EXPECT_EQ(slope(Op::select, either, three, wide).low, -1);
    EXPECT_EQ(slope(Op::select, either, three, wide).high, 2);
    system.jumps_aside = false;
    EXPECT_EQ(slope(Op::fract, wide, none).high, k_infinity);
    EXPECT_EQ(slope(Op::select, either, three, wide).high, k_infinity);
}

} // namespace tidemark::proof::tangent_system_test
