// Reads a SPIR-V module, fourth layer: debug information (NonSemantic.Shader.DebugInfo.100), which is there
// if the text was compiled with Names::keep.
#pragma once

#include "ir/spirv_computations.hpp"

#include <spirv/unified1/NonSemanticShaderDebugInfo100.h>

#include <map>

namespace tidemark::ir {

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
    std::map<Id, Id> declared_; ///< variables in memory
    /// names of this block's phis, until the block is known to be a loop header
    std::vector<Assignment> carried_;
    uint32_t call_ = 0;
    uint32_t named_block_ = 0;
    bool line_is_known_ = false;
};

} // namespace tidemark::ir
