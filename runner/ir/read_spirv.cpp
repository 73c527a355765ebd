#include "ir/spirv.hpp"
#include "ir/spirv_names.hpp"

#include <algorithm>
#include <numeric>

namespace tidemark::ir {
namespace {

/// Limit above which an evaluation takes too long.
constexpr size_t k_most_instructions = 4'000'000;

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

/// Reads the module itself, and its control flow.
class Reader : SpirvNames {
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
        leave_out_phis();
        return std::move(build_.function);
    }

private:
    // -- The module

    void number_blocks(const std::vector<SpirvInstruction>& all) {
        for (const SpirvInstruction& each : all)
            if (each.op == spv::OpLabel)
                block_of_[each.at(0)] = uint32_t(block_of_.size());
        function().blocks.resize(block_of_.size());
    }

    void read(const SpirvInstruction& each) {
        if (read_debug(each))
            return;
        begin_statement();
        switch (each.op) {
        case spv::OpName: names_[each.at(0)] = string_at(each.from(1)); break;
        case spv::OpLine: build_.line = int(each.at(1)); break;
        case spv::OpNoLine: build_.line = 0; break;
        case spv::OpStore:
            name_stored(each);
            store(each);
            break;
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

    // -- Control flow

    bool read_control(const SpirvInstruction& each) {
        switch (each.op) {
        case spv::OpLabel: begin_block(block_of_.at(each.at(0))); return true;
        case spv::OpPhi: read_phi(each); return true;
        case spv::OpLoopMerge:
            current().loop = true;
            current().behind_loop = block_of_.at(each.at(0));
            is_loop_header();
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
        in_function_ = true;
        begin_named_block(block);
        current().first = uint32_t(function().instructions.size());
        if (block == 0)
            initialise();
    }
    void end_block(Block::End end, const std::vector<Id>& targets) {
        Block& block = current();
        block.end = end;
        block.line = build_.line;
        block.last = uint32_t(function().instructions.size());
        for (const Id target : targets) {
            block.successors.push_back(block_of_.at(target));
            auto& predecessors = function().blocks[block.successors.back()].predecessors;
            if (std::ranges::find(predecessors, uint32_t(block_)) == predecessors.end())
                predecessors.push_back(uint32_t(block_));
        }
        block_ = -1;
        in_function_ = false;
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

    /// Operands may be defined later, so fill_phis() adds them at the end.
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
    /// Replaces phis that have the same value on every path; inlining leaves many.
    void leave_out_phis() {
        Function& all = function();
        std::vector<Value> same(all.instructions.size());
        std::iota(same.begin(), same.end(), Value{0});
        for (Value value = 0; value < same.size(); ++value) {
            const auto ways = all.operands_of(all.instructions[value]);
            if (all.instructions[value].op == Op::phi && !ways.empty() &&
                std::ranges::all_of(ways, [&](Value way) { return same[way] == same[ways[0]]; }))
                same[value] = same[ways[0]];
        }
        for (Value& operand : all.operands)
            if (operand != k_no_value)
                operand = same[operand];
        for (Block& block : all.blocks)
            if (block.condition != k_no_value)
                block.condition = same[block.condition];
    }
    Value source_of(std::span<const uint32_t> sources, uint32_t predecessor, size_t component) {
        for (size_t i = 0; i + 1 < sources.size(); i += 2)
            if (block_of_.at(sources[i + 1]) == predecessor)
                return values(sources[i]).at(component);
        cannot("a value that has no source on one way");
    }

    struct Phi {
        Id id;
        uint32_t block;
        std::span<const uint32_t> sources;
    };

    std::unordered_map<Id, uint32_t> block_of_;
    std::vector<Phi> phis_;
    int block_ = -1;
};

} // namespace

Result<Function> read_spirv(std::span<const uint32_t> words) {
    try {
        return Reader().read(words);
    } catch (const std::exception& reason) { // CannotFollow, or an undefined id
        return fail(ErrorCode::load, reason.what());
    }
}

} // namespace tidemark::ir
