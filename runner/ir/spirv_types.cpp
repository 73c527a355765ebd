#include "ir/spirv_types.hpp"

namespace tidemark::ir {

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

} // namespace tidemark::ir
