#include "shader/variables.hpp"

#include "shader/source_edits.hpp"
#include "shader/tree_facts.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tidemark::glsl {
namespace {

/// Larger than any array in real texts, and than any constructor that Tidemark writes.
constexpr size_t k_most_numbers = 1u << 20;
/// Largest array whose elements are tracked separately.
constexpr long k_most_elements = 16;
/// Nested structures can double the number of statements at each level; texts longer than this are not
/// written.
constexpr size_t k_most_statements = 512;

size_t times(size_t a, size_t b) {
    return a == 0 || b == 0 || a > k_most_numbers / b ? 0 : a * b;
}

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

Shapes::Shapes(const ParsedText& text) : text_(text), tree_(text.tree()) {
    for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
        const Node& node = tree_[id];
        if (node.kind == NodeKind::structure && text_.word(node.begin) == "struct" &&
            text_.word_of(id) != "struct")
            structures_by_name_[text_.word_of(id)].push_back(id);
        if (node.kind != NodeKind::declaration || node.parent != 0)
            continue;
        const NodeId type = tree_.child(id, 0);
        if (!has_qualifier(text_, type, "const") || class_of_type(type_name(text_, type)) != TypeClass::whole)
            continue;
        for (NodeId name = tree_[type].next; name != k_no_node; name = tree_[name].next)
            if (const NodeId value = tree_.child(name, 0); value != k_no_node && !is_bracket(text_, value))
                if (const auto known = number(tree_[value].begin, tree_[value].end))
                    constants_[text_.word_of(name)] = *known;
    }
}

std::optional<long> Shapes::number(size_t begin, size_t end) const {
    if (end != begin + 1)
        return std::nullopt;
    std::string_view word = text_.word(begin);
    if (const auto found = constants_.find(word); found != constants_.end())
        return found->second;
    if (!word.empty() && (word.back() == 'u' || word.back() == 'U'))
        word.remove_suffix(1);
    return whole_number(word);
}

const Shape& Shapes::unknown(std::string_view type) {
    Shape shape;
    shape.type = type;
    shape.whole = true;
    return shapes_.emplace_back(std::move(shape));
}

const Shape& Shapes::plain(std::string_view type) {
    if (const auto found = plain_.find(type); found != plain_.end())
        return *found->second;
    const ValueType known = value_type(type).value_or(ValueType{});
    Shape shape;
    shape.type = type;
    shape.numbers = 1;
    shape.statements = 1;
    shape.kind = known.scalar()   ? Shape::Kind::scalar
                 : known.vector() ? Shape::Kind::vector
                                  : Shape::Kind::matrix;
    if (!known.scalar()) {
        shape.length = size_t(known.matrix() ? known.columns : known.rows);
        shape.part = &plain(k_float_vectors[known.matrix() ? size_t(known.rows) - 1 : 0]);
        shape.slots = unsigned(shape.length) * shape.part->slots;
    }
    return *(plain_[type] = &shapes_.emplace_back(std::move(shape)));
}

const Shape& Shapes::structure(NodeId structure) {
    if (const auto found = structures_.find(structure); found != structures_.end())
        return *found->second;
    Shape shape;
    shape.kind = Shape::Kind::structure;
    shape.type = text_.word_of(structure) == "struct" ? std::string_view{} : text_.word_of(structure);
    shape.slots = 0;
    shape.numbers = shape.type.empty() ? 0 : 1;
    size_t numbers = 0;
    bool can_be_zero = true;
    for (const NodeId declaration : tree_.children(structure)) {
        const NodeId type = tree_.child(declaration, 0);
        for (NodeId name = tree_[type].next; name != k_no_node; name = tree_[name].next) {
            const Shape& member = of(type, name);
            shape.members.push_back({text_.word_of(name), &member, shape.slots});
            shape.slots += member.slots;
            shape.numbers = member.numbers == 0 ? 0 : shape.numbers;
            numbers = std::min(numbers + member.numbers, k_most_numbers);
            shape.statements = std::min(shape.statements + member.statements, k_most_statements + 1);
            can_be_zero = can_be_zero && member.can_be_zero();
        }
    }
    shape.numbers = shape.numbers == 0 ? 0 : numbers;
    if (!can_be_zero || shape.statements > k_most_statements)
        shape.statements = 0;
    if (shape.slots > k_most_slots || shape.slots == 0) {
        shape.slots = 1;
        shape.whole = true;
    }
    return *(structures_[structure] = &shapes_.emplace_back(std::move(shape)));
}

const Shape& Shapes::array_of(const Shape& element, std::optional<long> length) {
    Shape shape;
    shape.kind = Shape::Kind::array;
    shape.type = element.type;
    shape.part = &element;
    shape.statements = element.statements;
    shape.length = length && *length > 0 ? size_t(*length) : 0;
    shape.numbers = times(shape.length, element.numbers);
    shape.slots = shape.length > 0 && shape.length <= k_most_elements && !element.whole
                      ? unsigned(shape.length) * element.slots
                      : k_most_slots + 1;
    if (shape.slots > k_most_slots) {
        shape.slots = 1;
        shape.whole = true;
    }
    return shapes_.emplace_back(std::move(shape));
}

/// Returns the structure defined in the type itself, or the last visible one of that name declared before it.
const Shape& Shapes::named(NodeId type) {
    if (const NodeId own = tree_.child(type, 0); own != k_no_node)
        return structure(own);
    const std::string_view name = type_name(text_, type);
    if (const TypeClass kind = class_of_type(name); kind == TypeClass::floating || kind == TypeClass::whole)
        return plain(name);
    NodeId best = k_no_node;
    if (const auto found = structures_by_name_.find(name); found != structures_by_name_.end())
        for (const NodeId id : found->second) {
            const NodeId inside = tree_.around(id, NodeKind::function);
            if (tree_[id].end <= tree_[type].begin &&
                (inside == k_no_node || inside == tree_.around(type, NodeKind::function)))
                best = id;
        }
    return best == k_no_node ? unknown(name) : structure(best);
}

/// Returns the array lengths, outermost first: `float[3] a[2]` is two arrays of three.
std::vector<std::optional<long>> Shapes::lengths(NodeId type, NodeId declared) const {
    std::vector<std::optional<long>> result;
    if (declared != k_no_node)
        for (const NodeId part : tree_.children(declared))
            if (is_bracket(text_, part)) {
                const Node& length = tree_[tree_.child(part, 0)];
                result.push_back(number(length.begin, length.end));
            }
    const NodeId own = tree_.child(type, 0);
    size_t open = 0;
    int depth = 0;
    for (size_t i = own != k_no_node ? tree_[own].end : tree_[type].word + 1; i < tree_[type].end; ++i) {
        if (text_.word(i) == "[" && depth++ == 0)
            open = i;
        if (text_.word(i) == "]" && --depth == 0)
            result.push_back(number(open + 1, i));
    }
    return result;
}

const Shape& Shapes::of(NodeId type, NodeId declared) {
    const Shape* shape = &named(type);
    auto all = lengths(type, declared);
    std::ranges::reverse(all);
    for (const auto& length : all)
        shape = &array_of(*shape, length);
    return *shape;
}

Part Shapes::member(const Part& of, std::string_view name) const {
    if (!of.shape || of.shape->whole)
        return {of.slots, nullptr, false};
    const auto first = unsigned(std::countr_zero(of.slots));
    for (const Shape::Member& member : of.shape->members)
        if (member.name == name)
            return {all_slots(member.shape->slots) << (first + member.first_slot), member.shape, of.exact};
    if (of.shape->kind != Shape::Kind::vector)
        return {of.slots, nullptr, false};
    Part part{0, nullptr, of.exact};
    for (const char c : name)
        for (const std::string_view set : {"xyzw", "rgba", "stpq"})
            if (const size_t at = set.find(c); at < of.shape->length)
                part.slots |= Slots(1) << (first + at);
    part.shape = name.size() == 1 ? of.shape->part : nullptr;
    return part;
}

Part Shapes::element(const Part& of, NodeId index) const {
    const auto known = number(tree_[index].begin, tree_[index].end);
    if (!of.shape || of.shape->whole || !of.shape->part || !known || *known < 0 ||
        size_t(*known) >= of.shape->length)
        return {of.slots, nullptr, false};
    const unsigned slots = of.shape->part->slots;
    const unsigned first = unsigned(std::countr_zero(of.slots)) + unsigned(*known) * slots;
    return {all_slots(slots) << first, of.shape->part, of.exact};
}

Part Shapes::part_of(const Shape& shape, NodeId place) const {
    switch (tree_[place].kind) {
    case NodeKind::parenthesis: return part_of(shape, tree_.child(place, 0));
    case NodeKind::member: return member(part_of(shape, tree_.child(place, 0)), text_.word_of(place));
    case NodeKind::index: return element(part_of(shape, tree_.child(place, 0)), tree_.child(place, 1));
    default: return {all_slots(shape.slots), &shape, true};
    }
}

int channels_of(const ParsedText& text, const TreeFacts& facts, NodeId sampler, int depth) {
    constexpr int k_all = 15, k_deepest = 8;
    const SyntaxTree& tree = text.tree();
    const std::string_view word = text.word_of(sampler);
    if (tree[sampler].kind != NodeKind::name || depth > k_deepest)
        return k_all;
    if (word.starts_with("iChannel") && word.size() == 9)
        return 1 << (word.back() - '0');
    const NodeId function = tree.around(sampler, NodeKind::function);
    const std::vector<NodeId> parameters = parameters_of(text, function);
    const auto found =
        std::ranges::find_if(parameters, [&](NodeId each) { return text.word_of(each) == word; });
    if (found == parameters.end())
        return k_all;
    int channels = 0;
    for (NodeId id = 1; id < tree.nodes.size() && channels != k_all; ++id)
        if (calls_authors_function(text, facts, id) && called_name(text, id) == text.word_of(function)) {
            const NodeId given = tree.child(id, size_t(found - parameters.begin()) + 1);
            channels |= given == k_no_node ? k_all : channels_of(text, facts, given, depth + 1);
        }
    return channels == 0 ? k_all : channels;
}

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
