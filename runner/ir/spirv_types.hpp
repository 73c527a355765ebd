// Types and constants of a SPIR-V module, and how many scalars a value of a type is taken apart into.
#pragma once

#include "ir/function.hpp"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace tidemark::ir {

using Id = uint32_t;

struct Type {
    enum class Kind { none, scalar, vector, matrix, array, record, pointer, sampler } kind = Kind::none;
    Scalar scalar = Scalar::real; ///< of a scalar, and of the first one in anything else
    uint32_t count = 0;           ///< scalars in it
    uint32_t parts = 0;           ///< components, columns, elements, members
    std::vector<Id> members{}; ///< of a record each; of the others one: component, column, element, pointee
    uint32_t dimensions = 2;   ///< of a sampler's coordinates
};

/// Ids and counts come from a module that SPIRV-Tools wrote, so they are not checked beyond memory safety.
class Types {
public:
    const Type& of(Id id) const;
    void add(Id id, Type type) { types_[id] = std::move(type); }
    /// The type of a part, and the scalars before it.
    Id part(Id type, uint32_t index) const;
    uint32_t offset(Id type, uint32_t index) const;

private:
    std::unordered_map<Id, Type> types_;
};

} // namespace tidemark::ir
