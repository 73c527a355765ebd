#include "shader/variables.hpp"

#include "shader/builtin_functions.hpp"
#include "shader/march_record.hpp"
#include "shader/source_edits.hpp"
#include "shader/tree_facts.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
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

namespace {

/// Marks what is needed until nothing new is. Nothing is at first, but the colour of mainImage.
class NeededFinder {
public:
    NeededFinder(const ParsedText& text, const TreeFacts& facts)
        : text_(text), tree_(text.tree()), facts_(facts), needed_(tree_.nodes.size()),
          lasting_(tree_.nodes.size()) {}

    std::vector<bool> run() {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            if (tree_[id].kind == NodeKind::declarator || tree_[id].kind == NodeKind::parameter)
                declared_[tree_.around(id, NodeKind::function)].insert(text_.word_of(id));
        find_sets();
        runs_.insert("mainImage");
        while (std::exchange(grew_, false))
            for (const NodeId global : tree_.children(0))
                if (tree_[global].kind != NodeKind::function)
                    visit(global, false);
                else if (runs_.contains(text_.word_of(global)))
                    enter(global);
        return std::move(needed_);
    }

private:
    using Name = std::pair<NodeId, std::string_view>; ///< its function; k_no_node: global

    void enter(NodeId function) {
        function_ = function;
        const NodeId body = body_of_function(text_, function);
        if (body == k_no_node)
            return;
        const FunctionFacts& facts = facts_.functions.at(text_.word_of(function));
        unsigned bit = 1;
        for (const NodeId parameter : parameters_of(text_, function)) {
            if (facts.written_arguments & bit)
                read(text_.word_of(parameter));
            bit <<= 1;
        }
        visit(body, false);
        function_ = k_no_node;
    }

    bool is_declared(NodeId function, std::string_view name) const {
        const auto found = declared_.find(function);
        return found != declared_.end() && found->second.contains(name);
    }

    void read(std::string_view name) {
        if (function_ != k_no_node && is_declared(function_, name))
            grew_ = read_.insert({function_, name}).second || grew_;
        if (is_declared(k_no_node, name))
            grew_ = read_.insert({k_no_node, name}).second || grew_;
    }

    bool is_read(std::string_view name) const {
        return read_.contains({function_, name}) || read_.contains({k_no_node, name});
    }

    /// Marks an expression with all that it reads and calls.
    void keep(NodeId id) {
        if (id == k_no_node || needed_[id])
            return;
        needed_[id] = true;
        if (tree_[id].kind == NodeKind::name)
            read(text_.word_of(id));
        if (calls_authors_function(text_, facts_, id))
            grew_ = runs_.insert(called_name(text_, id)).second || grew_;
        for (const NodeId child : tree_.children(id))
            keep(child);
    }

    /// Returns whether a call changes a variable that is read: through an argument, or a global one.
    bool has_effect(NodeId call) const {
        for (const std::string_view name : names_set(text_, facts_, call))
            if (is_read(name))
                return true;
        const auto found = sets_.find(called_name(text_, call));
        return found != sets_.end() && std::ranges::any_of(found->second, [&](std::string_view name) {
                   return read_.contains({k_no_node, name});
               });
    }

    /// Finds the global variables that each function sets, those that it calls included.
    void find_sets() {
        std::map<std::string_view, std::set<std::string_view>> calls;
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            const NodeId function = tree_.around(id, NodeKind::function);
            if (function == k_no_node)
                continue;
            for (const std::string_view name : names_set(text_, facts_, id))
                if (is_declared(k_no_node, name))
                    sets_[text_.word_of(function)].insert(name);
            if (calls_authors_function(text_, facts_, id))
                calls[text_.word_of(function)].insert(called_name(text_, id));
        }
        for (bool grows = true; std::exchange(grows, false);)
            for (const auto& [caller, called] : calls)
                for (const std::string_view name : called)
                    for (const std::string_view global : std::set(sets_[name]))
                        grows = sets_[caller].insert(global).second || grows;
    }

    bool visit_children(NodeId id, bool in_lasting_loop) {
        bool effect = false;
        for (const NodeId child : tree_.children(id))
            effect = visit(child, in_lasting_loop) || effect;
        return effect;
    }

    /// Marks what a statement or an expression needs for its effects. Returns whether it has any.
    /// `in_lasting_loop`: the loop around it has effects, so what ends it matters.
    bool visit(NodeId id, bool in_lasting_loop) {
        switch (tree_[id].kind) {
        case NodeKind::jump: return in_lasting_loop || text_.word_of(id) == "discard";
        case NodeKind::return_statement: keep(tree_.child(id, 0)); return true;
        case NodeKind::if_else:
        case NodeKind::conditional: return with_condition(id, tree_.child(id, 0), in_lasting_loop);
        case NodeKind::switch_on:
        case NodeKind::loop_for:
        case NodeKind::loop_while:
        case NodeKind::loop_do: return loop(id);
        case NodeKind::declarator:
            if (!is_read(text_.word_of(id)))
                return visit_children(id, in_lasting_loop);
            for (const NodeId part : tree_.children(id))
                keep(part);
            return true;
        case NodeKind::call:
            if (!has_effect(id))
                return visit_children(id, in_lasting_loop);
            keep(id);
            return true;
        default: break;
        }
        if (!is_change(text_, id))
            return visit_children(id, in_lasting_loop);
        const NodeId base = base_of(tree_, tree_.child(id, 0));
        if (tree_[base].kind == NodeKind::name && !is_read(text_.word_of(base)))
            return visit_children(id, in_lasting_loop);
        keep(id);
        return true;
    }

    bool with_condition(NodeId id, NodeId condition, bool in_lasting_loop) {
        if (!visit_children(id, in_lasting_loop))
            return false;
        keep(condition);
        return true;
    }

    /// A loop without effects ends; what it counts and when it ends does not matter.
    bool loop(NodeId id) {
        if (!lasting_[id] && !visit_children(id, false))
            return false;
        lasting_[id] = true;
        for (const NodeId part : tree_.children(id))
            if (is_expression(tree_[part].kind))
                keep(part);
        visit_children(id, true);
        return true;
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    std::vector<bool> needed_;
    std::vector<bool> lasting_; ///< loops that have effects
    std::map<NodeId, std::set<std::string_view>> declared_;
    std::set<Name> read_;
    std::set<std::string_view> runs_;                             ///< functions, overloads taken together
    std::map<std::string_view, std::set<std::string_view>> sets_; ///< global variables that a function sets
    NodeId function_ = k_no_node;
    bool grew_ = true;
};

} // namespace

std::vector<bool> find_needed(const ParsedText& text, const TreeFacts& facts) {
    return NeededFinder(text, facts).run();
}

namespace {

/// Works in rounds, for a parameter gets its values after its function in the text.
class KnownFinder {
public:
    KnownFinder(const ParsedText& text, const TreeFacts& facts, bool uniforms)
        : text_(text), tree_(text.tree()), facts_(facts), uniforms_(uniforms), single_(text, facts) {}

    std::vector<bool> run() {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            const NodeId function = tree_.around(id, NodeKind::function);
            if (tree_[id].kind == NodeKind::declarator || tree_[id].kind == NodeKind::parameter)
                declared_.insert({function, text_.word_of(id)});
            for (const std::string_view name : names_set(text_, facts_, id))
                sets_[{function, name}].push_back(id);
        }
        for (int round = 0; round < 4; ++round) {
            find_values();
            find_parameters();
            find_settled_globals();
        }
        return std::move(known_);
    }

private:
    using Name = std::pair<NodeId, std::string_view>; ///< its function; k_no_node: global

    void find_values() {
        known_.assign(tree_.nodes.size(), false);
        pure_.clear();
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) // children come before their parents
            known_[id] = is_known(id);
    }

    bool is_known(NodeId id) {
        const NodeKind kind = tree_[id].kind;
        if (kind == NodeKind::literal || !is_expression(kind))
            return kind == NodeKind::literal;
        if (kind == NodeKind::name)
            return !is_callee(id) && is_known_name(id);
        const std::vector<NodeId> children = tree_.children(id);
        const size_t first = kind == NodeKind::call ? 1 : 0;
        if (children.size() <= first || is_change(text_, id) ||
            !std::all_of(children.begin() + long(first), children.end(),
                         [&](NodeId child) { return known_[child]; }))
            return false;
        return kind != NodeKind::call || calls_pure(id);
    }

    bool is_callee(NodeId name) const {
        const NodeId parent = tree_[name].parent;
        return tree_[parent].kind == NodeKind::call && tree_.child(parent, 0) == name;
    }

    bool calls_pure(NodeId call) {
        const std::string_view name = called_name(text_, call);
        if (const FunctionFacts* const function = facts_.function(name))
            return std::ranges::all_of(function->definitions, [&](NodeId each) { return is_pure(each); });
        const BuiltinFunction* const builtin = find_builtin(name);
        return !builtin || builtin->is(Trait::pure);
    }

    /// Returns whether the function has no loops, sets only its own variables, and reads only these and what
    /// is known.
    bool is_pure(NodeId function) {
        const auto [found, is_new] = pure_.insert({function, true});
        if (!is_new)
            return found->second;
        bool pure = true;
        for (NodeId id = function - 1; pure && id != k_no_node && tree_.is_within(id, function); --id) {
            pure = !is_loop(tree_[id].kind) && (tree_[id].kind != NodeKind::call || calls_pure(id));
            for (const std::string_view name : names_set(text_, facts_, id))
                pure = pure && declared_.contains({function, name});
            if (tree_[id].kind == NodeKind::name && !is_callee(id))
                pure = pure && (declared_.contains({function, text_.word_of(id)}) || is_known_name(id));
        }
        return pure_[function] = pure;
    }

    bool is_known_name(NodeId id) const {
        const std::string_view name = text_.word_of(id);
        const NodeId function = tree_.around(id, NodeKind::function);
        if (const NodeId value = single_.of(id); value != k_no_node)
            return known_[value];
        if (declared_.contains({function, name}))
            return names_.contains({function, name});
        // The text does not declare uniforms of the host.
        const auto meanings = facts_.names.find(name);
        if (meanings == facts_.names.end() || meanings->second.uniform)
            return uniforms_ && !name.starts_with("gl_");
        return names_.contains({k_no_node, name});
    }

    /// Finds parameters that nothing sets and that get a known value in each call.
    void find_parameters() {
        std::set<Name> varies;
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            const FunctionFacts* const function =
                tree_[id].kind == NodeKind::call ? facts_.function(called_name(text_, id)) : nullptr;
            for (const NodeId definition : function ? function->definitions : std::vector<NodeId>{}) {
                size_t argument = 1;
                for (const NodeId parameter : parameters_of(text_, definition)) {
                    const NodeId given = tree_.child(id, argument++);
                    if (given == k_no_node || !known_[given] || function->definitions.size() > 1)
                        varies.insert({definition, text_.word_of(parameter)});
                }
            }
        }
        for (const NodeId function : tree_.children(0))
            if (tree_[function].kind == NodeKind::function && function != find_main_image(text_))
                for (const NodeId parameter : parameters_of(text_, function))
                    if (const Name name{function, text_.word_of(parameter)};
                        !varies.contains(name) && !sets_.contains(name))
                        names_.insert(name);
    }

    /// Finds global variables that only one statement of mainImage sets, always, to a known value.
    void find_settled_globals() {
        const NodeId body = body_of_function(text_, find_main_image(text_));
        std::map<std::string_view, std::vector<NodeId>> all;
        for (const auto& [name, changes] : sets_)
            if (!declared_.contains(name) && declared_.contains({k_no_node, name.second}))
                all[name.second].insert(all[name.second].end(), changes.begin(), changes.end());
        for (const auto& [name, changes] : all) {
            const NodeId change = changes.front();
            if (changes.size() == 1 && tree_[change].kind == NodeKind::assign &&
                text_.word_of(change) == "=" && tree_[tree_.child(change, 0)].kind == NodeKind::name &&
                tree_[tree_[change].parent].parent == body && known_[tree_.child(change, 1)])
                names_.insert({k_no_node, name});
        }
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    bool uniforms_;
    SingleValues single_;
    std::set<Name> declared_;
    std::map<Name, std::vector<NodeId>> sets_; ///< expressions that set a variable, by the function around
    std::set<Name> names_;                     ///< parameters and global variables with a known value
    std::map<NodeId, bool> pure_;              ///< functions of is_pure
    std::vector<bool> known_;
};

} // namespace

std::vector<bool> find_known(const ParsedText& text, const TreeFacts& facts, bool uniforms) {
    return KnownFinder(text, facts, uniforms).run();
}

} // namespace tidemark::glsl
