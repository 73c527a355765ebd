#include "glsl/flow/zero_value.hpp"

#include "glsl/syntax/types.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::glsl {
namespace {

/// Mesa needs 0.4 s more for 64 elements written out than for none, and 20 s for 512.
constexpr size_t k_most_written_out = 64;

bool is_seen(const Shape& shape, const TreeFacts& facts) {
    if (shape.kind == Shape::Kind::array)
        return is_seen(*shape.part, facts);
    if (shape.kind != Shape::Kind::structure)
        return true;
    return !facts.names.contains(shape.type) && !facts.functions.contains(shape.type) &&
           std::ranges::all_of(shape.members,
                               [&](const auto& member) { return is_seen(*member.shape, facts); });
}

std::string plain_zero(std::string_view type) {
    const auto value = value_type(type);
    const char* const zero = value->base == 'f'   ? "0.0"
                             : value->base == 'b' ? "false"
                             : value->base == 'u' ? "0u"
                                                  : "0";
    return value->scalar() ? zero : fmt::format("{}({})", type, zero);
}

std::string written_out(const Shape& shape) {
    if (shape.is_plain())
        return plain_zero(shape.type);
    std::string text = constructor_of(shape) + "(";
    const bool array = shape.kind == Shape::Kind::array;
    for (size_t i = 0; i < (array ? shape.length : shape.members.size()); ++i)
        text += (i == 0 ? "" : ", ") + written_out(array ? *shape.part : *shape.members[i].shape);
    return text + ")";
}

} // namespace

std::string constructor_of(const Shape& shape) {
    std::string text(shape.type);
    for (const Shape* each = &shape; each->kind == Shape::Kind::array; each = each->part)
        text += fmt::format("[{}]", each->length);
    return text;
}

std::optional<std::string> zero_value(const Shape& shape, const TreeFacts& facts) {
    if (shape.numbers == 0 || shape.numbers > k_most_written_out || !is_seen(shape, facts))
        return std::nullopt;
    return written_out(shape);
}

} // namespace tidemark::glsl
