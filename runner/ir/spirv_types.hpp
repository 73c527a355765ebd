// Types and constants of a SPIR-V module, and the number of scalars that a value of a type is split into.
#pragma once

#include "ir/function.hpp"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace tidemark::ir {

using Id = uint32_t;

struct Type {
    enum class Kind { none, scalar, vector, matrix, array, record, pointer, sampler } kind = Kind::none;
    Scalar scalar = Scalar::real; ///< of a scalar; else of the first scalar in it
    uint32_t count = 0; ///< number of scalars
    uint32_t parts = 0; ///< number of components, columns, elements or members
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

} // namespace tidemark::ir
