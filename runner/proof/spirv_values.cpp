#include "proof/spirv_values.hpp"

namespace tidemark::proof {

const Type& Types::of(Id id) const {
    static const Type k_none;
    const auto found = types_.find(id);
    return found == types_.end() ? k_none : found->second;
}

Id Types::part(Id type, uint32_t index) const {
    const Type& whole = of(type);
    if (whole.members.empty())
        return 0;
    if (whole.kind != Type::Kind::record)
        return whole.members[0];
    return index < whole.members.size() ? whole.members[index] : 0;
}

uint32_t Types::offset(Id type, uint32_t index) const {
    const Type& whole = of(type);
    if (whole.kind != Type::Kind::record)
        return index * of(part(type, 0)).count;
    uint32_t before = 0;
    for (uint32_t i = 0; i < index && i < whole.members.size(); ++i)
        before += of(whole.members[i]).count;
    return before;
}

namespace {

struct Componentwise {
    spv::Op spirv;
    Op op;
};

constexpr Componentwise k_componentwise[] = {
    {spv::OpFAdd, Op::add},
    {spv::OpIAdd, Op::add},
    {spv::OpFSub, Op::subtract},
    {spv::OpISub, Op::subtract},
    {spv::OpFMul, Op::multiply},
    {spv::OpIMul, Op::multiply},
    {spv::OpVectorTimesScalar, Op::multiply},
    {spv::OpMatrixTimesScalar, Op::multiply},
    {spv::OpFDiv, Op::divide},
    {spv::OpSDiv, Op::divide},
    {spv::OpUDiv, Op::divide},
    {spv::OpFMod, Op::modulo},
    {spv::OpSMod, Op::modulo},
    {spv::OpUMod, Op::modulo},
    {spv::OpFRem, Op::remainder},
    {spv::OpSRem, Op::remainder},
    {spv::OpFNegate, Op::negate},
    {spv::OpSNegate, Op::negate},
    {spv::OpBitwiseAnd, Op::bit_and},
    {spv::OpBitwiseOr, Op::bit_or},
    {spv::OpBitwiseXor, Op::bit_xor},
    {spv::OpNot, Op::bit_not},
    {spv::OpShiftLeftLogical, Op::shift_left},
    {spv::OpShiftRightLogical, Op::shift_right},
    {spv::OpShiftRightArithmetic, Op::shift_right},
    {spv::OpBitCount, Op::bit_count},
    {spv::OpBitReverse, Op::reverse_bits},
    {spv::OpFOrdEqual, Op::equal},
    {spv::OpIEqual, Op::equal},
    {spv::OpLogicalEqual, Op::equal},
    {spv::OpFOrdNotEqual, Op::not_equal},
    {spv::OpFUnordNotEqual, Op::not_equal},
    {spv::OpINotEqual, Op::not_equal},
    {spv::OpLogicalNotEqual, Op::not_equal},
    {spv::OpFOrdLessThan, Op::less},
    {spv::OpSLessThan, Op::less},
    {spv::OpULessThan, Op::less},
    {spv::OpFOrdLessThanEqual, Op::less_equal},
    {spv::OpSLessThanEqual, Op::less_equal},
    {spv::OpULessThanEqual, Op::less_equal},
    {spv::OpIsNan, Op::is_nan},
    {spv::OpIsInf, Op::is_inf},
    {spv::OpLogicalAnd, Op::logical_and},
    {spv::OpLogicalOr, Op::logical_or},
    {spv::OpLogicalNot, Op::logical_not},
    {spv::OpSelect, Op::select},
    {spv::OpConvertSToF, Op::to_real},
    {spv::OpConvertUToF, Op::to_real},
    {spv::OpConvertFToS, Op::to_int},
    {spv::OpConvertFToU, Op::to_int},
    {spv::OpBitcast, Op::bits_as},
    {spv::OpDPdx, Op::derivative_x},
    {spv::OpDPdxFine, Op::derivative_x},
    {spv::OpDPdxCoarse, Op::derivative_x},
    {spv::OpDPdy, Op::derivative_y},
    {spv::OpDPdyFine, Op::derivative_y},
    {spv::OpDPdyCoarse, Op::derivative_y},
};

struct ComponentwiseFunction {
    GLSLstd450 function;
    Op op;
};

constexpr ComponentwiseFunction k_functions[] = {
    {GLSLstd450Round, Op::round},
    {GLSLstd450RoundEven, Op::round_even},
    {GLSLstd450Trunc, Op::truncate},
    {GLSLstd450FAbs, Op::absolute},
    {GLSLstd450SAbs, Op::absolute},
    {GLSLstd450FSign, Op::sign},
    {GLSLstd450SSign, Op::sign},
    {GLSLstd450Floor, Op::floor},
    {GLSLstd450Ceil, Op::ceil},
    {GLSLstd450Fract, Op::fract},
    {GLSLstd450Sin, Op::sin},
    {GLSLstd450Cos, Op::cos},
    {GLSLstd450Tan, Op::tan},
    {GLSLstd450Asin, Op::asin},
    {GLSLstd450Acos, Op::acos},
    {GLSLstd450Atan, Op::atan},
    {GLSLstd450Sinh, Op::sinh},
    {GLSLstd450Cosh, Op::cosh},
    {GLSLstd450Tanh, Op::tanh},
    {GLSLstd450Asinh, Op::asinh},
    {GLSLstd450Acosh, Op::acosh},
    {GLSLstd450Atanh, Op::atanh},
    {GLSLstd450Atan2, Op::atan2},
    {GLSLstd450Exp, Op::exp},
    {GLSLstd450Log, Op::log},
    {GLSLstd450Exp2, Op::exp2},
    {GLSLstd450Log2, Op::log2},
    {GLSLstd450Sqrt, Op::sqrt},
    {GLSLstd450InverseSqrt, Op::inverse_sqrt},
    {GLSLstd450FMin, Op::minimum},
    {GLSLstd450UMin, Op::minimum},
    {GLSLstd450SMin, Op::minimum},
    {GLSLstd450FMax, Op::maximum},
    {GLSLstd450UMax, Op::maximum},
    {GLSLstd450SMax, Op::maximum},
    {GLSLstd450FMix, Op::mix},
    {GLSLstd450Ldexp, Op::ldexp},
    {GLSLstd450FindILsb, Op::lowest_bit},
    {GLSLstd450FindSMsb, Op::highest_bit},
    {GLSLstd450FindUMsb, Op::highest_bit},
};

} // namespace

std::optional<Op> componentwise(spv::Op instruction) {
    for (const Componentwise& row : k_componentwise)
        if (row.spirv == instruction)
            return row.op;
    return std::nullopt;
}

std::optional<Op> componentwise(GLSLstd450 function) {
    for (const ComponentwiseFunction& row : k_functions)
        if (row.function == function)
            return row.op;
    return std::nullopt;
}

} // namespace tidemark::proof
