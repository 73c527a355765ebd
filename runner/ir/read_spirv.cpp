#include "ir/function_builder.hpp"
#include "ir/spirv.hpp"
#include "ir/spirv_types.hpp"

#include <fmt/format.h>
#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <unordered_map>

namespace tidemark::ir {
namespace {

/// What the text does and we do not follow; caught where a module is read.
struct CannotFollow : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Beyond that nobody evaluates it.
constexpr size_t k_most_instructions = 4'000'000;
constexpr uint32_t k_most_cells = 1 << 20;

struct SpirvInstruction {
    spv::Op op;
    std::span<const uint32_t> words; ///< after the first

    uint32_t at(size_t i) const {
        if (i >= words.size())
            throw CannotFollow("a module that ends in the middle");
        return words[i];
    }
    std::span<const uint32_t> from(size_t i) const { return words.subspan(std::min(i, words.size())); }
};

std::string string_at(std::span<const uint32_t> words) {
    const char* text = reinterpret_cast<const char*>(words.data());
    return std::string(text, strnlen(text, words.size_bytes()));
}

std::vector<SpirvInstruction> instructions_of(std::span<const uint32_t> words) {
    constexpr size_t k_header = 5;
    std::vector<SpirvInstruction> result;
    for (size_t at = k_header; at < words.size();) {
        const size_t count = words[at] >> spv::WordCountShift;
        if (count == 0 || at + count > words.size())
            throw CannotFollow("a module that ends in the middle");
        result.push_back({spv::Op(words[at] & spv::OpCodeMask), words.subspan(at + 1, count - 1)});
        at += count;
    }
    return result;
}

/// A place in memory: fixed, or with an offset that is computed.
struct Pointer {
    Id type = 0; ///< of what it points at
    uint32_t first = 0;
    Value offset = k_no_value;
    uint32_t last = 0; ///< cell that the offset may reach
    std::string sampler{};
};

/// Operations that go component by component, with the type of their operands.
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

class Reader {
public:
    Function read(std::span<const uint32_t> words) {
        const auto all = instructions_of(words);
        number_blocks(all);
        for (const SpirvInstruction& each : all) {
            read(each);
            if (function().instructions.size() > k_most_instructions)
                throw CannotFollow("too long a computation");
        }
        fill_phis();
        return std::move(build_.function);
    }

private:
    Function& function() { return build_.function; }

    [[noreturn]] void cannot(std::string_view what) const {
        throw CannotFollow(build_.line > 0 ? fmt::format("line {}: {}", build_.line, what)
                                           : std::string(what));
    }

    // -- Values and types

    const Values& values(Id id) const {
        const auto found = values_.find(id);
        if (found == values_.end() || found->second.empty())
            cannot("a value of no type that is known");
        return found->second;
    }
    Value value(Id id) const { return values(id)[0]; }
    const Type& type(Id id) const { return types_.of(id); }

    uint32_t constant_of(Id id) {
        const Instruction& instruction = function().instructions[value(id)];
        if (instruction.op != Op::constant)
            cannot("an index that is computed where it must be fixed");
        return instruction.immediate;
    }

    Values filled(Id type_id, Op op) {
        Values result;
        append_filled(type_id, op, result);
        return result;
    }
    void append_filled(Id type_id, Op op, Values& result) {
        const Type& whole = type(type_id);
        if (whole.kind == Type::Kind::scalar) {
            result.push_back(build_.add(op, whole.scalar, {}));
            return;
        }
        for (uint32_t i = 0; i < whole.parts; ++i)
            append_filled(types_.part(type_id, i), op, result);
    }
    /// The kinds of the scalars of a type.
    std::vector<Scalar> scalars(Id type_id) {
        std::vector<Scalar> result;
        append_scalars(type_id, result);
        return result;
    }
    void append_scalars(Id type_id, std::vector<Scalar>& result) {
        const Type& whole = type(type_id);
        if (whole.kind == Type::Kind::scalar)
            result.push_back(whole.scalar);
        else
            for (uint32_t i = 0; i < whole.parts; ++i)
                append_scalars(types_.part(type_id, i), result);
    }

    void define(const SpirvInstruction& each, Values result) {
        type_of_[each.at(1)] = each.at(0);
        values_[each.at(1)] = std::move(result);
    }

    // -- The module

    void number_blocks(const std::vector<SpirvInstruction>& all) {
        for (const SpirvInstruction& each : all)
            if (each.op == spv::OpLabel)
                block_of_[each.at(0)] = uint32_t(block_of_.size());
        function().blocks.resize(block_of_.size());
    }

    void read(const SpirvInstruction& each) {
        switch (each.op) {
        case spv::OpName: names_[each.at(0)] = string_at(each.from(1)); break;
        case spv::OpLine: build_.line = int(each.at(1)); break;
        case spv::OpNoLine: build_.line = 0; break;
        case spv::OpExtInstImport:
        case spv::OpFunction:
        case spv::OpFunctionEnd:
        case spv::OpSelectionMerge:
        case spv::OpDecorate:
        case spv::OpMemberDecorate: break;
        case spv::OpFunctionCall: cannot("a call that could not be inlined");
        default:
            if (!read_type(each) && !read_constant(each) && !read_control(each) && !read_memory(each) &&
                block_ >= 0)
                define(each, computed(each));
        }
    }

    bool read_type(const SpirvInstruction& each) {
        const auto compound = [&](Type::Kind kind, uint32_t parts) {
            const Type& part = type(each.at(1));
            types_.add(each.at(0), {kind, part.scalar, part.count * parts, parts, {each.at(1)}});
        };
        switch (each.op) {
        case spv::OpTypeVoid:
        case spv::OpTypeFunction: return true;
        case spv::OpTypeBool: types_.add(each.at(0), scalar_type(Scalar::boolean)); return true;
        case spv::OpTypeInt:
            check_width(each.at(1));
            types_.add(each.at(0), scalar_type(each.at(2) ? Scalar::signed_int : Scalar::unsigned_int));
            return true;
        case spv::OpTypeFloat:
            check_width(each.at(1));
            types_.add(each.at(0), scalar_type(Scalar::real));
            return true;
        case spv::OpTypeVector: compound(Type::Kind::vector, each.at(2)); return true;
        case spv::OpTypeMatrix: compound(Type::Kind::matrix, each.at(2)); return true;
        case spv::OpTypeArray: compound(Type::Kind::array, constant_of(each.at(2))); return true;
        case spv::OpTypePointer: {
            Type pointer{Type::Kind::pointer, Scalar::real, 0, 0, {each.at(2)}};
            types_.add(each.at(0), pointer);
            return true;
        }
        case spv::OpTypeStruct: read_record(each); return true;
        case spv::OpTypeImage: {
            Type image{Type::Kind::sampler, Scalar::real, 0, 0, {}};
            image.dimensions = each.at(2) == spv::Dim2D ? 2 : 3;
            types_.add(each.at(0), image);
            return true;
        }
        case spv::OpTypeSampledImage: types_.add(each.at(0), type(each.at(1))); return true;
        default: return false;
        }
    }

    static Type scalar_type(Scalar scalar) { return {Type::Kind::scalar, scalar, 1, 1, {}}; }
    void check_width(uint32_t bits) const {
        if (bits != 32)
            cannot("numbers of other than 32 bits");
    }

    void read_record(const SpirvInstruction& each) {
        Type record{Type::Kind::record, Scalar::real, 0, 0, {}};
        for (const Id member : each.from(1)) {
            record.members.push_back(member);
            record.count += type(member).count;
        }
        record.parts = uint32_t(record.members.size());
        if (record.parts > 0)
            record.scalar = type(record.members[0]).scalar;
        types_.add(each.at(0), record);
    }

    bool read_constant(const SpirvInstruction& each) {
        switch (each.op) {
        case spv::OpConstantTrue:
        case spv::OpConstantFalse:
            define(each, {build_.constant(each.op == spv::OpConstantTrue, Scalar::boolean)});
            return true;
        case spv::OpConstant:
            define(each, {build_.constant(each.at(2), type(each.at(0)).scalar)});
            return true;
        case spv::OpConstantComposite: define(each, together(each.from(2))); return true;
        case spv::OpConstantNull: define(each, filled(each.at(0), Op::constant)); return true;
        case spv::OpUndef: define(each, filled(each.at(0), Op::undefined)); return true;
        default: return false;
        }
    }

    Values together(std::span<const Id> ids) const {
        Values result;
        for (const Id id : ids) {
            const Values& part = values(id);
            result.insert(result.end(), part.begin(), part.end());
        }
        return result;
    }

    // -- Control flow

    bool read_control(const SpirvInstruction& each) {
        switch (each.op) {
        case spv::OpLabel: begin_block(block_of_.at(each.at(0))); return true;
        case spv::OpPhi: read_phi(each); return true;
        case spv::OpLoopMerge:
            current().loop = true;
            current().after = block_of_.at(each.at(0));
            current().next = block_of_.at(each.at(1));
            return true;
        case spv::OpBranch: end_block(Block::End::jump, {each.at(0)}); return true;
        case spv::OpBranchConditional:
            current().condition = value(each.at(0));
            end_block(Block::End::branch, {each.at(1), each.at(2)});
            return true;
        case spv::OpSwitch: read_switch(each); return true;
        case spv::OpReturn:
        case spv::OpUnreachable: end_block(Block::End::leave, {}); return true;
        case spv::OpKill: end_block(Block::End::discard, {}); return true;
        default: return false;
        }
    }

    Block& current() {
        if (block_ < 0)
            cannot("an instruction outside of a function");
        return function().blocks[size_t(block_)];
    }
    void begin_block(uint32_t block) {
        block_ = int(block);
        current().first = uint32_t(function().instructions.size());
        if (block == 0)
            initialise();
    }
    void end_block(Block::End end, const std::vector<Id>& targets) {
        Block& block = current();
        block.end = end;
        block.last = uint32_t(function().instructions.size());
        for (const Id target : targets) {
            block.successors.push_back(block_of_.at(target));
            auto& predecessors = function().blocks[block.successors.back()].predecessors;
            if (std::ranges::find(predecessors, uint32_t(block_)) == predecessors.end())
                predecessors.push_back(uint32_t(block_));
        }
        block_ = -1;
    }
    void read_switch(const SpirvInstruction& each) {
        current().condition = value(each.at(0));
        std::vector<Id> targets{each.at(1)};
        for (size_t i = 2; i + 1 < each.words.size(); i += 2) {
            current().cases.push_back(each.at(i));
            targets.push_back(each.at(i + 1));
        }
        end_block(Block::End::multiway, targets);
    }

    /// Its operands may stand further down: they are filled in at the end.
    void read_phi(const SpirvInstruction& each) {
        Values result;
        for (const Scalar scalar : scalars(each.at(0)))
            result.push_back(build_.add(Op::phi, scalar, {}));
        define(each, std::move(result));
        phis_.push_back({each.at(1), uint32_t(block_), each.from(2)});
    }
    void fill_phis() {
        for (const auto& [id, block, sources] : phis_)
            for (size_t component = 0; component < values(id).size(); ++component) {
                Instruction& phi = function().instructions[values(id)[component]];
                phi.first_operand = uint32_t(function().operands.size());
                for (const uint32_t predecessor : function().blocks[block].predecessors)
                    function().operands.push_back(source_of(sources, predecessor, component));
                phi.operand_count = uint32_t(function().blocks[block].predecessors.size());
            }
    }
    Value source_of(std::span<const uint32_t> sources, uint32_t predecessor, size_t component) {
        for (size_t i = 0; i + 1 < sources.size(); i += 2)
            if (block_of_.at(sources[i + 1]) == predecessor)
                return values(sources[i]).at(component);
        cannot("a value that has no source on one way");
    }

    // -- Memory

    bool read_memory(const SpirvInstruction& each) {
        switch (each.op) {
        case spv::OpVariable: declare(each); return true;
        case spv::OpAccessChain:
        case spv::OpInBoundsAccessChain: pointers_[each.at(1)] = chain(each); return true;
        case spv::OpLoad: load(each); return true;
        case spv::OpStore: store(each); return true;
        case spv::OpCopyMemory: {
            const Pointer from = pointer(each.at(1));
            write(pointer(each.at(0)), read_from(from));
            return true;
        }
        default: return false;
        }
    }

    const Pointer& pointer(Id id) const {
        const auto found = pointers_.find(id);
        if (found == pointers_.end())
            cannot("a pointer that is not known");
        return found->second;
    }

    void declare(const SpirvInstruction& each) {
        const Id pointee = types_.part(each.at(0), 0);
        const Type& of = type(pointee);
        Pointer& place = pointers_[each.at(1)];
        place = {pointee, function().cells, k_no_value, function().cells + std::max(1u, of.count) - 1, {}};
        if (of.kind == Type::Kind::sampler) {
            place.sampler = names_[each.at(1)];
            return;
        }
        if (of.count > k_most_cells - function().cells)
            cannot("too large an array");
        function().variables.push_back(variable(each, of, pointee));
        function().cells += of.count;
        if (each.words.size() > 3)
            initialisers_.emplace_back(each.at(1), each.at(3));
        if (block_ >= 0)
            initialise();
    }

    Variable variable(const SpirvInstruction& each, const Type& of, Id pointee) {
        Variable result{Variable::Kind::local, names_[each.at(1)], function().cells, of.count, of.scalar};
        switch (spv::StorageClass(each.at(2))) {
        case spv::StorageClassUniformConstant:
        case spv::StorageClassUniform: result.kind = Variable::Kind::uniform; break;
        case spv::StorageClassInput: result.kind = Variable::Kind::input; break;
        case spv::StorageClassOutput: result.kind = Variable::Kind::output; break;
        default: break;
        }
        const bool array = of.kind == Type::Kind::array;
        result.length = array ? of.parts : 0;
        const Type& element = array ? type(types_.part(pointee, 0)) : of;
        result.columns = element.kind == Type::Kind::matrix ? element.parts : 1;
        result.rows = result.columns == 0 ? 0 : element.count / result.columns;
        return result;
    }

    /// What global variables hold is written at the head of the function.
    void initialise() {
        for (const auto& [variable, value_id] : std::exchange(initialisers_, {}))
            write(pointer(variable), values(value_id));
    }

    Pointer chain(const SpirvInstruction& each) {
        Pointer place = pointer(each.at(2));
        for (const Id index : each.from(3)) {
            const Instruction known = function().instructions[value(index)];
            const Id part = types_.part(place.type, known.immediate);
            if (known.op == Op::constant || type(place.type).kind == Type::Kind::record) {
                const uint32_t within = types_.offset(place.type, constant_of(index));
                if (within >= std::max(1u, type(place.type).count))
                    cannot("an index out of range");
                place.first += within;
                if (place.offset == k_no_value)
                    place.last = place.first + std::max(1u, type(part).count) - 1;
            } else {
                move(place, value(index), type(part).count, type(place.type).parts);
            }
            place.type = part;
        }
        return place;
    }

    /// By an index that is computed; it is kept in the range of its array.
    void move(Pointer& place, Value index, uint32_t stride, uint32_t count) {
        const auto number = [&](uint32_t bits) { return build_.constant(bits, Scalar::signed_int); };
        const auto whole = [&](Op op, Value a, Value b) {
            return build_.add(op, Scalar::signed_int, {a, b});
        };
        if (build_.type_of(index) == Scalar::unsigned_int)
            index = build_.add(Op::bits_as, Scalar::signed_int, {index});
        const Value inside = whole(Op::minimum, whole(Op::maximum, index, number(0)), number(count - 1));
        const Value offset = whole(Op::multiply, inside, number(stride));
        if (place.offset == k_no_value)
            place.last = place.first + stride * count - 1;
        place.offset = place.offset == k_no_value ? offset : whole(Op::add, place.offset, offset);
    }

    uint32_t access(const Pointer& place, uint32_t component) {
        const uint32_t first = place.first + component;
        if (first > place.last || place.last >= function().cells)
            cannot("an index out of range");
        function().accesses.push_back({first, place.offset == k_no_value ? 1 : place.last - first + 1});
        return uint32_t(function().accesses.size() - 1);
    }

    Values read_from(const Pointer& place) {
        Values result;
        const std::vector<Scalar> kinds = scalars(place.type);
        for (uint32_t i = 0; i < kinds.size(); ++i) {
            Values operands;
            if (place.offset != k_no_value)
                operands.push_back(place.offset);
            result.push_back(build_.add(Op::load, kinds[i], operands, access(place, i)));
        }
        return result;
    }

    void write(const Pointer& place, const Values& what) {
        for (uint32_t i = 0; i < what.size(); ++i) {
            Values operands{what[i]};
            if (place.offset != k_no_value)
                operands.push_back(place.offset);
            build_.add(Op::store, build_.type_of(what[i]), operands, access(place, i));
        }
    }

    void load(const SpirvInstruction& each) {
        const Pointer place = pointer(each.at(2));
        if (type(place.type).kind == Type::Kind::sampler)
            pointers_[each.at(1)] = place;
        else
            define(each, read_from(place));
    }
    void store(const SpirvInstruction& each) { write(pointer(each.at(0)), values(each.at(1))); }

    // -- Computations

    Values computed(const SpirvInstruction& each) {
        const Scalar result = type(each.at(0)).scalar;
        if (each.op == spv::OpExtInst)
            return called(each, result);
        for (const Componentwise& row : k_componentwise)
            if (row.spirv == each.op)
                return componentwise(row.op, result, each.from(2));
        switch (each.op) {
        case spv::OpCopyObject: return values(each.at(2));
        case spv::OpFOrdGreaterThan:
        case spv::OpSGreaterThan:
        case spv::OpUGreaterThan:
            return build_.each(Op::less, result, {values(each.at(3)), values(each.at(2))});
        case spv::OpFOrdGreaterThanEqual:
        case spv::OpSGreaterThanEqual:
        case spv::OpUGreaterThanEqual:
            return build_.each(Op::less_equal, result, {values(each.at(3)), values(each.at(2))});
        case spv::OpAny: return {folded(Op::logical_or, values(each.at(2)))};
        case spv::OpAll: return {folded(Op::logical_and, values(each.at(2)))};
        case spv::OpFwidth:
        case spv::OpFwidthFine:
        case spv::OpFwidthCoarse: return width_of(values(each.at(2)));
        default: return composite(each);
        }
    }

    Values componentwise(Op op, Scalar result, std::span<const Id> ids) {
        std::vector<Values> operands;
        for (const Id id : ids)
            operands.push_back(values(id));
        return build_.each(op, result, operands);
    }

    Value folded(Op op, const Values& bits) {
        Value result = bits[0];
        for (size_t i = 1; i < bits.size(); ++i)
            result = build_.add(op, Scalar::boolean, {result, bits[i]});
        return result;
    }

    Values width_of(const Values& a) {
        const auto change = [&](Op along) {
            return build_.each(Op::absolute, Scalar::real, {build_.each(along, Scalar::real, {a})});
        };
        return build_.each(Op::add, Scalar::real, {change(Op::derivative_x), change(Op::derivative_y)});
    }

    Values composite(const SpirvInstruction& each) {
        switch (each.op) {
        case spv::OpCompositeConstruct: return together(each.from(2));
        case spv::OpCompositeExtract: return extract(each.at(2), each.from(3));
        case spv::OpCompositeInsert: return insert(each);
        case spv::OpVectorShuffle: return shuffle(each);
        case spv::OpVectorExtractDynamic: return {component(values(each.at(2)), value(each.at(3)))};
        case spv::OpVectorInsertDynamic:
            return with_component(values(each.at(2)), value(each.at(3)), value(each.at(4)));
        default: return linear_algebra(each);
        }
    }

    std::pair<size_t, size_t> part_of(Id type_id, std::span<const uint32_t> indices) const {
        size_t first = 0;
        for (const uint32_t index : indices) {
            first += types_.offset(type_id, index);
            type_id = types_.part(type_id, index);
        }
        return {first, type(type_id).count};
    }
    Values extract(Id whole, std::span<const uint32_t> indices) {
        const auto [first, count] = part_of(type_of_[whole], indices);
        const Values& all = values(whole);
        if (first + count > all.size())
            cannot("a part of a value that does not have it");
        return Values(all.begin() + long(first), all.begin() + long(first + count));
    }
    Values insert(const SpirvInstruction& each) {
        Values whole = values(each.at(3));
        const auto [first, count] = part_of(each.at(0), each.from(4));
        const Values& part = values(each.at(2));
        if (first + count > whole.size() || part.size() != count)
            cannot("a part of a value that does not have it");
        std::copy(part.begin(), part.end(), whole.begin() + long(first));
        return whole;
    }
    Values shuffle(const SpirvInstruction& each) {
        const Id both[] = {each.at(2), each.at(3)};
        const Values all = together(both);
        Values result;
        for (const uint32_t index : each.from(4))
            result.push_back(all[index < all.size() ? index : 0]);
        return result;
    }

    Value is_index(Value index, size_t i) {
        return build_.add(Op::equal, Scalar::boolean,
                          {index, build_.constant(uint32_t(i), build_.type_of(index))});
    }
    Value component(const Values& vector, Value index) {
        Value result = vector.back();
        for (size_t i = vector.size() - 1; i-- > 0;)
            result = build_.add(Op::select, build_.type_of(result), {is_index(index, i), vector[i], result});
        return result;
    }
    Values with_component(const Values& vector, Value what, Value index) {
        Values result;
        for (size_t i = 0; i < vector.size(); ++i)
            result.push_back(
                build_.add(Op::select, build_.type_of(what), {is_index(index, i), what, vector[i]}));
        return result;
    }

    Values linear_algebra(const SpirvInstruction& each) {
        const auto parts = [&](Id id) { return type(type_of_[id]).parts; };
        switch (each.op) {
        case spv::OpDot: return {build_.dot(values(each.at(2)), values(each.at(3)))};
        case spv::OpMatrixTimesVector:
            return build_.matrix_times_vector(values(each.at(2)), values(each.at(3)));
        case spv::OpVectorTimesMatrix:
            return build_.vector_times_matrix(values(each.at(2)), values(each.at(3)));
        case spv::OpMatrixTimesMatrix:
            return build_.product(values(each.at(2)), parts(each.at(2)), values(each.at(3)));
        case spv::OpOuterProduct: return build_.outer_product(values(each.at(2)), values(each.at(3)));
        case spv::OpTranspose: {
            const Values& matrix = values(each.at(2));
            return build_.transpose(matrix, uint32_t(matrix.size()) / parts(each.at(2)));
        }
        default: return looked_up(each);
        }
    }

    Values called(const SpirvInstruction& each, Scalar result) {
        const auto function_id = GLSLstd450(each.at(3));
        for (const ComponentwiseFunction& row : k_functions)
            if (row.function == function_id)
                return componentwise(row.op, result, each.from(4));
        const auto a = [&]() -> const Values& { return values(each.at(4)); };
        const auto b = [&]() -> const Values& { return values(each.at(5)); };
        const auto c = [&]() -> const Values& { return values(each.at(6)); };
        switch (function_id) {
        case GLSLstd450Radians: return build_.scaled(a(), build_.constant(0.017453292519943295f));
        case GLSLstd450Degrees: return build_.scaled(a(), build_.constant(57.29577951308232f));
        case GLSLstd450Pow: return power(a(), b());
        case GLSLstd450Length: return {build_.length(a())};
        case GLSLstd450Distance: return {build_.length(build_.difference(a(), b()))};
        case GLSLstd450Normalize: return build_.normalize(a());
        case GLSLstd450Cross: return build_.cross(a(), b());
        case GLSLstd450Reflect: return build_.reflect(a(), b());
        case GLSLstd450Refract: return build_.refract(a(), b(), c()[0]);
        case GLSLstd450FaceForward: return build_.face_forward(a(), b(), c());
        case GLSLstd450FClamp:
        case GLSLstd450SClamp:
        case GLSLstd450UClamp: return build_.clamp(a(), b(), c());
        case GLSLstd450SmoothStep: return build_.smoothstep(a(), b(), c());
        case GLSLstd450Step: {
            const Values below = build_.each(Op::less, Scalar::boolean, {b(), a()});
            return build_.each(Op::select, Scalar::real,
                               {below, {build_.constant(0.0f)}, {build_.constant(1.0f)}});
        }
        case GLSLstd450Fma:
            return build_.each(Op::add, Scalar::real,
                               {build_.each(Op::multiply, Scalar::real, {a(), b()}), c()});
        case GLSLstd450Determinant: return {build_.determinant(a(), type(type_of_[each.at(4)]).parts)};
        case GLSLstd450MatrixInverse: return build_.inverse(a(), type(type_of_[each.at(4)]).parts);
        case GLSLstd450Modf: {
            const Values whole = build_.each(Op::truncate, Scalar::real, {a()});
            write(pointer(each.at(5)), whole);
            return build_.difference(a(), whole);
        }
        default: cannot(fmt::format("the built-in function number {}", uint32_t(function_id)));
        }
    }

    /// Drivers make products of the squares, which are defined for negative numbers, too.
    Values power(const Values& base, const Values& exponent) {
        const auto is = [&](float number) {
            return std::ranges::all_of(exponent, [&](Value each) {
                const Instruction& constant = function().instructions[each];
                return constant.op == Op::constant && constant.immediate == std::bit_cast<uint32_t>(number);
            });
        };
        const auto square = [&](const Values& a) { return build_.each(Op::multiply, Scalar::real, {a, a}); };
        if (is(2))
            return square(base);
        if (is(4))
            return square(square(base));
        return build_.each(Op::pow, Scalar::real, {base, exponent});
    }

    // -- Textures

    Values looked_up(const SpirvInstruction& each) {
        Lookup lookup;
        size_t extra = 4; // where the image operands begin
        switch (each.op) {
        case spv::OpImage: pointers_[each.at(1)] = pointer(each.at(2)); return {};
        case spv::OpImageSampleImplicitLod:
        case spv::OpImageSampleExplicitLod: break;
        case spv::OpImageFetch: lookup.form = Lookup::Form::fetch; break;
        case spv::OpImageQuerySizeLod: lookup.form = Lookup::Form::size; break;
        case spv::OpImageGather:
            lookup.form = Lookup::Form::gather;
            lookup.component = constant_of(each.at(4));
            extra = 5;
            break;
        default: cannot(fmt::format("the instruction number {}", uint32_t(each.op)));
        }
        const Pointer& place = pointer(each.at(2));
        lookup.sampler = place.sampler;
        Values operands = values(each.at(3));
        const uint32_t dimensions = type(place.type).dimensions;
        lookup.coordinates = lookup.form == Lookup::Form::size ? 0 : dimensions;
        operands.resize(std::min<size_t>(operands.size(), std::max(1u, lookup.coordinates)));
        lookup.has_level = lookup.form == Lookup::Form::size;
        add_image_operands(each, extra, lookup, operands);
        return components(each.at(0), lookup, operands);
    }

    void add_image_operands(const SpirvInstruction& each, size_t at, Lookup& lookup, Values& operands) {
        if (at >= each.words.size())
            return;
        const uint32_t mask = each.at(at++);
        const auto take = [&] {
            const Values& part = values(each.at(at++));
            operands.insert(operands.end(), part.begin(), part.end());
        };
        if (mask & spv::ImageOperandsBiasMask) {
            lookup.has_bias = true;
            take();
        }
        if (mask & spv::ImageOperandsLodMask) {
            lookup.has_level = true;
            take();
        }
        if (mask & spv::ImageOperandsGradMask) {
            lookup.has_gradients = true;
            take();
            take();
        }
        if (mask &
            ~uint32_t(spv::ImageOperandsBiasMask | spv::ImageOperandsLodMask | spv::ImageOperandsGradMask))
            cannot("a texture look-up with an offset");
    }

    Values components(Id type_id, Lookup lookup, const Values& operands) {
        Values result;
        const uint32_t first = lookup.component;
        const std::vector<Scalar> kinds = scalars(type_id);
        for (uint32_t i = 0; i < kinds.size(); ++i) {
            lookup.component = first + i;
            function().lookups.push_back(lookup);
            result.push_back(
                build_.add(Op::texel, kinds[i], operands, uint32_t(function().lookups.size() - 1)));
        }
        return result;
    }

    struct Phi {
        Id id;
        uint32_t block;
        std::span<const uint32_t> sources;
    };

    FunctionBuilder build_;
    Types types_;
    std::unordered_map<Id, std::string> names_;
    std::unordered_map<Id, Values> values_;
    std::unordered_map<Id, Id> type_of_;
    std::unordered_map<Id, Pointer> pointers_;
    std::unordered_map<Id, uint32_t> block_of_;
    std::vector<std::pair<Id, Id>> initialisers_;
    std::vector<Phi> phis_;
    int block_ = -1;
};

} // namespace

Result<Function> read_spirv(std::span<const uint32_t> words) {
    try {
        return Reader().read(words);
    } catch (const CannotFollow& reason) {
        return fail(ErrorCode::load, reason.what());
    }
}

} // namespace tidemark::ir
