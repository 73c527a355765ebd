// Types and constants of a SPIR-V module, and the number of scalars that a value of a type is split into.
#pragma once

#include "proof/function.hpp"
#include "proof/function_builder.hpp"

#include <fmt/format.h>
#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tidemark::proof {

using Id = uint32_t;

struct Type {
    enum class Kind { none, scalar, vector, matrix, array, record, pointer, sampler } kind = Kind::none;
    Scalar scalar = Scalar::real; ///< of a scalar; else of the first scalar in it
    uint32_t count = 0;           ///< number of scalars
    uint32_t parts = 0;           ///< number of components, columns, elements or members
    /// of a record: one a member; else one type: component, column, element or pointee
    std::vector<Id> members{};
    uint32_t dimensions = 2; ///< of a sampler's coordinates
};

/// The module was written by SPIRV-Tools, so ids and counts are only checked for memory safety.
class Types {
public:
    const Type& of(Id id) const;
    void add(Id id, Type type) { types_[id] = std::move(type); }
    /// Returns the type of a part, and the number of scalars before it.
    Id part(Id type, uint32_t index) const;
    uint32_t offset(Id type, uint32_t index) const;

private:
    std::unordered_map<Id, Type> types_;
};

// Maps the SPIR-V instructions and built-in functions that work component by component to our operations.

std::optional<Op> componentwise(spv::Op instruction);
std::optional<Op> componentwise(GLSLstd450 function);

// Reads a SPIR-V module, first layer: types and values, each split into scalars.

/// Thrown for constructs that are not supported; caught in read_spirv.
struct CannotFollow : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct SpirvInstruction {
    spv::Op op;
    std::span<const uint32_t> words; ///< without the first word

    uint32_t at(size_t i) const {
        if (i >= words.size())
            throw CannotFollow("a module that ends in the middle");
        return words[i];
    }
    std::span<const uint32_t> from(size_t i) const { return words.subspan(std::min(i, words.size())); }
};

class SpirvValues {
protected:
    Function& function() { return build_.function; }

    [[noreturn]] void cannot(std::string_view what) const {
        throw CannotFollow(build_.line > 0 ? fmt::format("line {}: {}", build_.line, what)
                                           : std::string(what));
    }

    const Values& values(Id id) const {
        const auto found = values_.find(id);
        if (found == values_.end() || found->second.empty())
            cannot("a value of unknown type");
        return found->second;
    }
    bool has_values(Id id) const { return values_.contains(id); }
    Value value(Id id) const { return values(id)[0]; }
    const Type& type(Id id) const { return types_.of(id); }

    Values together(std::span<const Id> ids) const {
        Values result;
        for (const Id id : ids) {
            const Values& part = values(id);
            result.insert(result.end(), part.begin(), part.end());
        }
        return result;
    }
    uint32_t constant_of(Id id) {
        const Instruction& instruction = function().instructions[value(id)];
        if (instruction.op != Op::constant)
            cannot("a computed index where a constant is needed");
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
    /// Returns the types of the scalars of a type.
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
    Id type_of(Id value) const {
        const auto found = type_of_.find(value);
        return found == type_of_.end() ? 0 : found->second;
    }

    FunctionBuilder build_;
    Types types_;
    std::unordered_map<Id, std::string> names_;

private:
    std::unordered_map<Id, Values> values_;
    std::unordered_map<Id, Id> type_of_;
};

} // namespace tidemark::proof
