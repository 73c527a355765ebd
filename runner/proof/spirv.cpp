// Reads a SPIR-V module, fourth layer: debug information (NonSemantic.Shader.DebugInfo.100), which is there
// if the text was compiled with Names::keep.

#include "proof/spirv.hpp"

#include "base/dynamic_library.hpp"
#include "base/error.hpp"
#include "proof/spirv_computations.hpp"

#include <spirv/unified1/NonSemanticShaderDebugInfo100.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace tidemark::proof {

class SpirvNames : protected SpirvComputations {
protected:
    /// Returns whether it was debug information.
    bool read_debug(const SpirvInstruction& each) {
        if (each.op == spv::OpString)
            strings_[each.at(0)] = string_at(each.from(1));
        else if (each.op == spv::OpExtInstImport && string_at(each.from(1)) == k_set)
            set_ = each.at(0);
        else if (each.op != spv::OpExtInst || each.at(2) != set_)
            return false;
        else
            read_fact({each.op, each.from(1)});
        return true;
    }

    /// Begins a statement if the line or the call has changed. Call it before each instruction is computed.
    void begin_statement() {
        if (set_ == 0)
            return;
        auto& statements = function().names.statements;
        if (statements.empty() || statements.back().line != build_.line || statements.back().call != call_)
            statements.push_back({uint32_t(function().instructions.size()), build_.line, call_});
    }
    void begin_named_block(uint32_t block) {
        named_block_ = block;
        line_is_known_ = false;
        carried_.clear();
    }
    /// Turns the names of this block's phis into assignments that the loop carries.
    void is_loop_header() {
        for (Assignment& each : carried_) {
            each.line = build_.line;
            each.call = call_;
            add(std::move(each));
        }
        carried_.clear();
    }
    /// Names an element of an array in memory.
    void name_stored(const SpirvInstruction& store) {
        const Pointer& place = pointer(store.at(0));
        for (const auto& [variable, declared] : declared_)
            if (const Pointer& whole = pointer(variable);
                place.first >= whole.first && place.first <= whole.last)
                name_element(declared, whole, place, store.at(1));
    }

    static std::string string_at(std::span<const uint32_t> words) {
        const char* text = reinterpret_cast<const char*>(words.data());
        return std::string(text, strnlen(text, words.size_bytes()));
    }

private:
    static constexpr std::string_view k_set = "NonSemantic.Shader.DebugInfo.100";
    /// Limit of elements to name if an array is assigned as a whole.
    static constexpr uint32_t k_most_elements = 16;

    /// The words are: id, set, kind, operands.
    void read_fact(const SpirvInstruction& each) {
        constexpr size_t k_operands = 3;
        const auto operands = each.from(k_operands);
        const auto at = [&](size_t i) { return each.at(k_operands + i); };
        switch (each.at(2)) {
        case NonSemanticShaderDebugInfo100DebugLine:
            build_.line = int(constant_of(at(1)));
            line_is_known_ = true;
            break;
        case NonSemanticShaderDebugInfo100DebugScope:
            call_ = call_of(at(0), operands.size() > 1 ? at(1) : 0);
            break;
        case NonSemanticShaderDebugInfo100DebugInlinedAt:
            inlined_[each.at(0)] = {int(constant_of(at(0))), at(1), operands.size() > 2 ? at(2) : 0};
            break;
        case NonSemanticShaderDebugInfo100DebugFunction:
        case NonSemanticShaderDebugInfo100DebugLocalVariable:
        case NonSemanticShaderDebugInfo100DebugTypeMember:
            named_[each.at(0)] = {strings_[at(0)], at(1)};
            break;
        case NonSemanticShaderDebugInfo100DebugLexicalBlock: named_[each.at(0)] = named_[at(3)]; break;
        case NonSemanticShaderDebugInfo100DebugTypeArray:
        case NonSemanticShaderDebugInfo100DebugTypeVector:
        case NonSemanticShaderDebugInfo100DebugTypeMatrix: parts_[each.at(0)] = {at(0)}; break;
        case NonSemanticShaderDebugInfo100DebugTypeComposite:
            parts_[each.at(0)] = copy(each.from(k_operands + 9));
            break;
        case NonSemanticShaderDebugInfo100DebugDeclare:
            if (has_pointer(at(1)))
                declared_[at(1)] = at(0);
            break;
        case NonSemanticShaderDebugInfo100DebugValue:
            name_value(at(0), at(1), each.from(k_operands + 3));
            break;
        default: break;
        }
    }

    static std::vector<Id> copy(std::span<const Id> ids) { return {ids.begin(), ids.end()}; }

    // -- Calls

    uint32_t call_of(Id scope, Id inlined_at) {
        const auto [known, is_new] = calls_.try_emplace({scope, inlined_at}, 0);
        if (!is_new)
            return known->second;
        InlinedCall call{named_[scope].name};
        if (const auto site = inlined_.find(inlined_at); site != inlined_.end()) {
            call.line = site->second.line;
            call.caller = call_of(site->second.scope, site->second.inlined_at);
        } else {
            call.caller = uint32_t(function().names.calls.size());
        }
        const auto index = uint32_t(function().names.calls.size());
        function().names.calls.push_back(std::move(call));
        return calls_[{scope, inlined_at}] = index;
    }

    // -- Values

    /// A part of a variable, and its debug type.
    struct Part {
        std::string name{};
        Id type = 0;
    };

    Part part_of(const Part& whole, uint32_t index) {
        const auto& parts = parts_[whole.type];
        const auto member = index < parts.size() ? named_.find(parts[index]) : named_.end();
        if (member != named_.end())
            return {whole.name + "." + member->second.name, member->second.type};
        return {fmt::format("{}[{}]", whole.name, index), parts.empty() ? 0 : parts[0]};
    }

    void name_value(Id variable, Id id, std::span<const Id> indices) {
        if (!has_values(id)) // undefined for pointers
            return;
        Part part = named_[variable];
        for (const Id index : indices)
            part = part_of(part, constant_of(index));
        const Values& all = values(id);
        if (!all.empty())
            name_parts(type_of(id), part, all, 0);
    }

    void name_parts(Id type_id, const Part& part, const Values& all, size_t first) {
        const Type& whole = type(type_id);
        const bool divided = whole.kind == Type::Kind::record || whole.kind == Type::Kind::array;
        if (!divided) {
            Assignment each{Assignment::Kind::computed, part.name};
            each.values.assign(all.begin() + long(first), all.begin() + long(first + whole.count));
            each.rows = whole.kind == Type::Kind::matrix ? whole.count / whole.parts : whole.count;
            name(std::move(each));
        }
        for (uint32_t i = 0; divided && i < std::min(whole.parts, k_most_elements); ++i)
            name_parts(types_.part(type_id, i), part_of(part, i), all, first + types_.offset(type_id, i));
    }

    void name(Assignment each) {
        each.block = named_block_;
        each.place = uint32_t(function().instructions.size());
        each.line = build_.line;
        each.call = call_;
        const auto is_phi = [&](Value value) { return function().instructions[value].op == Op::phi; };
        if (line_is_known_) {
            add(std::move(each));
        } else if (std::ranges::any_of(each.values, is_phi)) {
            each.kind = Assignment::Kind::carried;
            carried_.push_back(std::move(each));
        }
    }
    void add(Assignment each) { function().names.assignments.push_back(std::move(each)); }

    void name_element(Id declared, const Pointer& whole, const Pointer& place, Id what) {
        const Type& array = type(whole.type);
        const Type& stored = type(place.type);
        if (array.kind != Type::Kind::array || stored.kind == Type::Kind::record ||
            stored.kind == Type::Kind::array)
            return;
        Assignment each{Assignment::Kind::stored, named_[declared].name, values(what)};
        each.rows = stored.kind == Type::Kind::matrix ? stored.count / stored.parts : stored.count;
        each.stride = array.count / std::max(1u, array.parts);
        each.first_element = (place.first - whole.first) / std::max(1u, each.stride);
        each.offset = place.offset;
        name(std::move(each));
    }

    struct InlinedAt {
        int line = 0;
        Id scope = 0, inlined_at = 0;
    };

    Id set_ = 0;
    std::unordered_map<Id, std::string> strings_;
    std::unordered_map<Id, Part> named_; ///< functions, variables, members
    std::unordered_map<Id, std::vector<Id>> parts_;
    std::unordered_map<Id, InlinedAt> inlined_;
    std::map<std::pair<Id, Id>, uint32_t> calls_; ///< by scope and place of inlining
    std::map<Id, Id> declared_;                   ///< variables in memory
    /// names of this block's phis, until the block is known to be a loop header
    std::vector<Assignment> carried_;
    uint32_t call_ = 0;
    uint32_t named_block_ = 0;
    bool line_is_known_ = false;
};

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
        cannot("a value without a source on one path");
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

namespace {

const Result<const SpirvCompiler*>& spirv_compiler() {
    static const Result<const SpirvCompiler*> compiler = [] {
        const PlugIn plug_in{"tidemark_spirv.so", "SPIR-V plug-in",       "proofs about a scene",
                             "glslang 12",        k_spirv_compiler_entry, k_spirv_compiler_version};
        return load_plug_in<SpirvCompiler>(plug_in);
    }();
    return compiler;
}

} // namespace

Result<Function> compile(const std::string& text, Names names) {
    const SpirvCompiler* compiler = TRY(spirv_compiler());
    const SpirvResult words = compiler->compile(text, names);
    if (!words)
        return fail(ErrorCode::load, words.error());
    return read_spirv(*words);
}

} // namespace tidemark::proof
