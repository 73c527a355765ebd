// Reads a SPIR-V module, second layer: variables, and pointers into them.
#pragma once

#include "proof/spirv_values.hpp"

namespace tidemark::ir {

/// A place in memory, fixed or with a computed offset.
struct Pointer {
    Id type = 0; ///< of the target
    uint32_t first = 0;
    Value offset = k_no_value;
    uint32_t last = 0; ///< last cell that the offset may reach
    std::string sampler{};
};

class SpirvMemory : protected SpirvValues {
protected:
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

    bool has_pointer(Id id) const { return pointers_.contains(id); }
    const Pointer& pointer(Id id) const {
        const auto found = pointers_.find(id);
        if (found == pointers_.end())
            cannot("an unknown pointer");
        return found->second;
    }

    void same_pointer(Id id, Id as) { pointers_[id] = pointer(as); }

    void declare(const SpirvInstruction& each) {
        const Id pointee = types_.part(each.at(0), 0);
        const Type& of = type(pointee);
        Pointer& place = pointers_[each.at(1)];
        place = {pointee, cells(), k_no_value, cells() + std::max(1u, of.count) - 1, {}};
        if (of.kind == Type::Kind::sampler) {
            place.sampler = names_[each.at(1)];
            return;
        }
        if (of.count > k_most_cells - cells())
            cannot("too large an array");
        function().variables.push_back(variable(each, of, pointee));
        append_scalars(pointee, function().cells);
        if (each.words.size() > 3)
            initialisers_.emplace_back(each.at(1), each.at(3));
        if (in_function_)
            initialise();
    }

    Variable variable(const SpirvInstruction& each, const Type& of, Id pointee) {
        Variable result{Variable::Kind::local, names_[each.at(1)], cells(), of.count, of.scalar};
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

    /// Writes the initial values of global variables at the start of the function.
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

    /// Moves the place by a computed index, which is clamped to its array.
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
        if (first > place.last || place.last >= cells())
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

    bool in_function_ = false;

private:
    static constexpr uint32_t k_most_cells = 1 << 20;

    uint32_t cells() { return uint32_t(function().cells.size()); }

    std::unordered_map<Id, Pointer> pointers_;
    std::vector<std::pair<Id, Id>> initialisers_;
};

} // namespace tidemark::ir
