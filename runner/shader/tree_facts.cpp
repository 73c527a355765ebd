#include "shader/tree_facts.hpp"

#include "shader/builtin_functions.hpp"
#include "shader/source_edits.hpp"

#include <algorithm>
#include <vector>

namespace tidemark::glsl {
namespace {

class Collector {
public:
    explicit Collector(const ParsedText& text) : text_(text), tree_(text.tree()) {}

    TreeFacts run() {
        for (NodeId id = 0; id < tree_.nodes.size(); ++id) {
            switch (tree_[id].kind) {
            case NodeKind::structure: read_structure(id); break;
            case NodeKind::function: read_function(id); break;
            case NodeKind::declaration: read_declaration(id); break;
            case NodeKind::parameter: declare(tree_.child(id, 0), id); break;
            default: break;
            }
        }
        facts_.surely_whole.resize(tree_.nodes.size());
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) // children come before their parents
            facts_.surely_whole[id] = is_whole(id);
        return std::move(facts_);
    }

private:
    bool whole_child(NodeId id, size_t index) const {
        const NodeId child = tree_.child(id, index);
        return child != k_no_node && facts_.surely_whole[child];
    }

    bool is_whole(NodeId id) const {
        switch (tree_[id].kind) {
        case NodeKind::literal: {
            const auto type = type_of_literal(text_.word_of(id));
            return type && type->base != 'f';
        }
        case NodeKind::name: {
            const auto found = facts_.names.find(text_.word_of(id));
            return found != facts_.names.end() && found->second.only_whole();
        }
        case NodeKind::call:
            return class_of_type(called_name(text_, id)) == TypeClass::whole ||
                   tree_[tree_.child(id, 0)].kind == NodeKind::member;
        case NodeKind::binary: return whole_child(id, 0) && whole_child(id, 1);
        case NodeKind::conditional: return whole_child(id, 1) && whole_child(id, 2);
        case NodeKind::assign:
        case NodeKind::index:
        case NodeKind::member:
        case NodeKind::prefix:
        case NodeKind::postfix:
        case NodeKind::parenthesis: return whole_child(id, 0);
        default: return false;
        }
    }

    void read_structure(NodeId id) {
        if (text_.word(tree_[id].begin) != "struct" || text_.word_of(id) == "struct")
            return;
        auto& members = facts_.structures[text_.word_of(id)];
        members.clear();
        for (const NodeId declaration : tree_.children(id)) {
            const NodeId type = tree_.child(declaration, 0);
            for (NodeId name = tree_[type].next; name != k_no_node; name = tree_[name].next)
                members.push_back(
                    {type_name(text_, type), text_.word_of(name), dimensions(text_, type, name) > 0});
        }
    }

    void read_function(NodeId id) {
        FunctionFacts& function = facts_.functions[text_.word_of(id)];
        const NodeId type = tree_.child(id, 0);
        function.returns_nothing = function.returns_nothing || type_name(text_, type) == "void";
        function.returns_array = function.returns_array || dimensions(text_, type, k_no_node) > 0;
        unsigned bit = 1;
        for (NodeId part = tree_[type].next; part != k_no_node; part = tree_[part].next) {
            if (tree_[part].kind == NodeKind::block)
                function.definitions.push_back(id);
            const NodeId of = tree_.child(part, 0);
            if (tree_[part].kind == NodeKind::parameter &&
                (has_qualifier(text_, of, "out") || has_qualifier(text_, of, "inout")))
                function.written_arguments |= bit;
            bit <<= 1;
        }
    }

    void read_declaration(NodeId id) {
        const NodeId type = tree_.child(id, 0);
        for (NodeId name = tree_[type].next; name != k_no_node; name = tree_[name].next)
            declare(type, name);
    }

    void declare(NodeId type, NodeId declared) {
        Meanings& meanings = facts_.names[text_.word_of(declared)];
        const TypeClass kind = class_of_type(type_name(text_, type));
        meanings.floating = meanings.floating || kind == TypeClass::floating;
        meanings.whole = meanings.whole || kind == TypeClass::whole;
        meanings.sampler = meanings.sampler || kind == TypeClass::sampler;
        meanings.structure = meanings.structure || kind == TypeClass::none;
        meanings.array = meanings.array || dimensions(text_, type, declared) > 0;
        meanings.uniform = meanings.uniform || has_qualifier(text_, type, "uniform");
        meanings.constant = meanings.constant || has_qualifier(text_, type, "const");
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    TreeFacts facts_;
};

class Typer {
public:
    Typer(const ParsedText& text, const TreeFacts& facts) : text_(text), tree_(text.tree()), facts_(facts) {}

    std::optional<ValueType> of(NodeId id) const {
        switch (tree_[id].kind) {
        case NodeKind::literal: return type_of_literal(text_.word_of(id));
        case NodeKind::name: return value_of(declared_name(id));
        case NodeKind::parenthesis:
        case NodeKind::prefix:
        case NodeKind::postfix: return of(tree_.child(id, 0));
        case NodeKind::conditional:
        case NodeKind::comma: return of(tree_.child(id, 1));
        case NodeKind::assign: return of(tree_.child(id, 0));
        case NodeKind::binary: return of_operation(id);
        case NodeKind::member: return of_member(id);
        case NodeKind::index: return of_index(id);
        case NodeKind::call: return of_call(id);
        default: return std::nullopt;
        }
    }

    std::vector<NodeId> called_definitions(NodeId call) const {
        const FunctionFacts* const function = facts_.function(called_name(text_, call));
        if (!function)
            return {};
        std::vector<Argument> arguments; // empty if there is no choice
        for (size_t i = 1; i < tree_.child_count(call) && function->definitions.size() > 1; ++i)
            arguments.push_back(argument(tree_.child(call, i)));
        std::map<size_t, std::vector<NodeId>> by_differing;
        for (const NodeId definition : function->definitions) {
            const std::vector<NodeId> parameters = parameters_of(text_, definition);
            if (parameters.size() + 1 != tree_.child_count(call))
                continue;
            size_t differing = 0;
            for (size_t i = 0; i < arguments.size(); ++i)
                differing += differs(arguments[i], parameters[i]);
            by_differing[differing].push_back(definition);
        }
        return by_differing.empty() ? std::vector<NodeId>{} : by_differing.begin()->second;
    }

private:
    /// The declared type of a name, an element or a member.
    struct Declared {
        std::string_view type;
        size_t dimensions = 0;
        bool operator==(const Declared&) const = default;
    };
    struct Argument {
        std::optional<Declared> declared;
        std::optional<ValueType> value;
    };

    template <class T>
    static std::optional<T> agreed(const std::vector<T>& all) {
        const bool agree = std::ranges::all_of(all, [&](const T& each) { return each == all[0]; });
        return all.empty() || !agree ? std::nullopt : std::optional<T>(all[0]);
    }

    std::optional<ValueType> value_of(const std::optional<Declared>& declared) const {
        return declared && declared->dimensions == 0 ? value_type(declared->type) : std::nullopt;
    }

    /// Returns what all declarations of the name agree on: those of its function, else the global ones.
    std::optional<Declared> declared_name(NodeId id) const {
        const NodeId function = tree_.around(id, NodeKind::function);
        std::vector<Declared> local, global;
        for (NodeId each = 1; each < tree_.nodes.size(); ++each) {
            const NodeKind kind = tree_[each].kind;
            if ((kind != NodeKind::declarator && kind != NodeKind::parameter) ||
                text_.word_of(each) != text_.word_of(id) ||
                tree_.around(each, NodeKind::structure) != k_no_node)
                continue;
            const NodeId inside = tree_.around(each, NodeKind::function);
            if (inside != function && inside != k_no_node)
                continue;
            const NodeId type = tree_.child(kind == NodeKind::parameter ? each : tree_[each].parent, 0);
            (inside == k_no_node ? global : local)
                .push_back({type_name(text_, type), dimensions(text_, type, each)});
        }
        return agreed(local.empty() ? global : local);
    }

    std::optional<Declared> declared(NodeId id) const {
        switch (tree_[id].kind) {
        case NodeKind::name: return declared_name(id);
        case NodeKind::parenthesis: return declared(tree_.child(id, 0));
        case NodeKind::index: {
            auto whole = declared(tree_.child(id, 0));
            if (!whole || whole->dimensions == 0)
                return std::nullopt;
            --whole->dimensions;
            return whole;
        }
        case NodeKind::member: {
            const auto whole = declared(tree_.child(id, 0));
            const auto structure = whole && whole->dimensions == 0 ? facts_.structures.find(whole->type)
                                                                   : facts_.structures.end();
            if (structure != facts_.structures.end())
                for (const StructureMember& each : structure->second)
                    if (each.name == text_.word_of(id) && !each.array)
                        return Declared{each.type};
            return std::nullopt;
        }
        case NodeKind::call: return declared_call(id);
        default: return std::nullopt;
        }
    }

    /// Returns the type that the called overloads of the author's function have, or the structure that is
    /// constructed.
    std::optional<Declared> declared_call(NodeId id) const {
        if (const std::string_view name = called_name(text_, id); facts_.structures.contains(name))
            return Declared{name};
        std::vector<Declared> types;
        for (const NodeId definition : called_definitions(id)) {
            const NodeId type = tree_.child(definition, 0);
            types.push_back({type_name(text_, type), dimensions(text_, type, k_no_node)});
        }
        return agreed(types);
    }

    std::optional<ValueType> of_operation(NodeId id) const {
        constexpr std::string_view k_tests[] = {"==", "!=", "<", ">", "<=", ">=", "&&", "||", "^^"};
        const std::string_view op = text_.word_of(id);
        if (std::ranges::find(k_tests, op) != std::end(k_tests))
            return ValueType{'b', 1, 1};
        const auto left = of(tree_.child(id, 0)), right = of(tree_.child(id, 1));
        if (!left || !right)
            return std::nullopt;
        const auto is_whole = [](const ValueType& type) { return type.base == 'i' || type.base == 'u'; };
        if (op == "<<" || op == ">>")
            return is_whole(*left) && is_whole(*right) ? left : std::nullopt;
        if (op != "%" && op != "&" && op != "|" && op != "^")
            return type_of_operation(op, *left, *right);
        if (!is_whole(*left) || left->base != right->base ||
            (!left->scalar() && !right->scalar() && left->rows != right->rows))
            return std::nullopt;
        return left->scalar() ? right : left;
    }

    /// Returns the type of an element of an array, of a vector's component or of a matrix's column.
    std::optional<ValueType> of_index(NodeId id) const {
        if (const auto element = declared(id))
            return value_of(element);
        const auto whole = of(tree_.child(id, 0));
        if (!whole)
            return std::nullopt;
        return whole->columns > 1 ? ValueType{whole->base, 1, whole->rows} : ValueType{whole->base, 1, 1};
    }

    std::optional<ValueType> of_member(NodeId id) const {
        if (const auto member = declared(id))
            return value_of(member);
        const auto whole = of(tree_.child(id, 0));
        return whole ? type_of_member(*whole, text_.word_of(id)) : std::nullopt;
    }

    std::optional<ValueType> of_call(NodeId id) const {
        const std::string_view name = called_name(text_, id);
        if (const NodeId callee = tree_.child(id, 0);
            tree_[callee].kind == NodeKind::member && text_.word_of(callee) == "length")
            return ValueType{'i', 1, 1};
        if (facts_.function(name))
            return value_of(declared_call(id));
        if (const auto constructed = value_type(name))
            return constructed;
        const BuiltinFunction* const builtin = find_builtin(name);
        if (!builtin)
            return std::nullopt;
        if (builtin->is(Trait::implicit_lod))
            return value_type("vec4");
        std::vector<ValueType> arguments;
        for (size_t i = 1; i < tree_.child_count(id); ++i) {
            const auto argument = of(tree_.child(id, i));
            if (!argument)
                return std::nullopt;
            arguments.push_back(*argument);
        }
        return type_of_call(*builtin, arguments);
    }

    /// Does not type a call twice: the time would double with each level of nested calls.
    Argument argument(NodeId id) const {
        const auto known = declared(id);
        return {known, known || calls_authors_function(text_, facts_, id) ? value_of(known) : of(id)};
    }

    /// Returns whether the argument is known to have another type than the parameter.
    bool differs(const Argument& argument, NodeId parameter) const {
        const NodeId type = tree_.child(parameter, 0);
        const Declared wanted{type_name(text_, type), dimensions(text_, type, parameter)};
        return argument.value ? argument.value != value_of(wanted)
                              : argument.declared && argument.declared != wanted;
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
};

} // namespace

std::string_view type_name(const ParsedText& text, NodeId type) {
    const SyntaxTree& tree = text.tree();
    const NodeId structure = tree.child(type, 0);
    if (structure != k_no_node)
        return text.word_of(structure) == "struct" ? std::string_view{} : text.word_of(structure);
    return text.word_of(type);
}

bool has_qualifier(const ParsedText& text, NodeId type, std::string_view qualifier) {
    const Node& node = text.tree()[type];
    for (size_t i = node.begin; i < node.word; ++i)
        if (text.word(i) == qualifier)
            return true;
    return false;
}

bool is_given(const ParsedText& text, NodeId type) {
    const auto qualifiers = {"const", "uniform", "in", "out", "buffer", "shared", "varying", "attribute"};
    return std::ranges::any_of(qualifiers, [&](auto word) { return has_qualifier(text, type, word); });
}

bool is_bracket(const ParsedText& text, NodeId part) {
    const Node& node = text.tree()[part];
    return node.kind == NodeKind::index && text.word(node.begin) == "[";
}

size_t dimensions(const ParsedText& text, NodeId type, NodeId declared) {
    const SyntaxTree& tree = text.tree();
    const NodeId structure = tree.child(type, 0);
    size_t count = 0;
    int depth = 0;
    for (size_t i = structure != k_no_node ? tree[structure].end : tree[type].word + 1; i < tree[type].end;
         ++i) {
        if (text.word(i) == "[" && depth++ == 0)
            ++count;
        depth -= text.word(i) == "]";
    }
    if (declared != k_no_node)
        for (const NodeId part : tree.children(declared))
            count += tree[part].kind == NodeKind::index && text.word(tree[part].begin) == "[";
    return count;
}

std::vector<std::string_view> names_set(const ParsedText& text, const TreeFacts& facts, NodeId expression) {
    const SyntaxTree& tree = text.tree();
    std::vector<std::string_view> names;
    const auto add = [&](NodeId place) {
        if (const NodeId base = base_of(tree, place); tree[base].kind == NodeKind::name)
            names.push_back(text.word_of(base));
    };
    if (is_change(text, expression))
        add(tree.child(expression, 0));
    size_t index = 0;
    if (tree[expression].kind == NodeKind::call)
        for (NodeId part = tree[tree.child(expression, 0)].next; part != k_no_node; part = tree[part].next)
            if (facts.writes_argument(called_name(text, expression), index++))
                add(part);
    return names;
}

std::string_view called_name(const ParsedText& text, NodeId call) {
    const NodeId callee = text.tree().child(call, 0);
    return text.tree()[callee].kind == NodeKind::name ? text.word_of(callee) : std::string_view{};
}

bool calls_authors_function(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    return text.tree()[id].kind == NodeKind::call && facts.function(called_name(text, id));
}

bool TreeFacts::is_type(std::string_view word) const {
    return structures.contains(word) || class_of_type(word) != TypeClass::none ||
           !float_type_of(word).empty();
}

const FunctionFacts* TreeFacts::function(std::string_view name) const {
    const auto found = functions.find(name);
    return found == functions.end() ? nullptr : &found->second;
}

bool TreeFacts::writes_argument(std::string_view name, size_t index) const {
    if (index >= 32)
        return true; // no function has so many arguments; the conservative answer
    const FunctionFacts* own = function(name);
    const unsigned written = own ? own->written_arguments : builtin_written_arguments(name);
    return ((written >> index) & 1u) != 0;
}

TreeFacts find_facts(const ParsedText& text) {
    return Collector(text).run();
}

NodeId base_of(const SyntaxTree& tree, NodeId place) {
    while (tree[place].kind == NodeKind::member || tree[place].kind == NodeKind::index ||
           tree[place].kind == NodeKind::parenthesis)
        place = tree.child(place, 0);
    return place;
}

NodeId without_brackets(const SyntaxTree& tree, NodeId expression) {
    while (tree[expression].kind == NodeKind::parenthesis)
        expression = tree.child(expression, 0);
    return expression;
}

bool is_change(const ParsedText& text, NodeId expression) {
    const NodeKind kind = text.tree()[expression].kind;
    const std::string_view word = text.word_of(expression);
    return kind == NodeKind::assign || kind == NodeKind::postfix ||
           (kind == NodeKind::prefix && (word == "++" || word == "--"));
}

std::unordered_set<std::string_view> functions_of_main(const ParsedText& text, const TreeFacts& facts) {
    const SyntaxTree& tree = text.tree();
    std::unordered_map<std::string_view, std::vector<std::string_view>> calls;
    for (NodeId id = 1; id < tree.nodes.size(); ++id)
        if (tree[id].kind == NodeKind::call)
            if (const std::string_view name = called_name(text, id); facts.function(name))
                if (const NodeId caller = tree.around(id, NodeKind::function); caller != k_no_node)
                    calls[text.word_of(caller)].push_back(name);
    std::vector<std::string_view> open{"main"};
    std::unordered_set<std::string_view> found(open.begin(), open.end());
    while (!open.empty()) {
        const std::string_view name = open.back();
        open.pop_back();
        for (const std::string_view callee : calls[name])
            if (found.insert(callee).second)
                open.push_back(callee);
    }
    return found;
}

bool must_stay_constant(const ParsedText& text, NodeId id) {
    const SyntaxTree& tree = text.tree();
    for (NodeId around = id; around != k_no_node; around = tree[around].parent) {
        const Node& node = tree[around];
        switch (node.kind) {
        case NodeKind::label:
        case NodeKind::type:
        case NodeKind::structure: return true;
        case NodeKind::index: // a declarator's bracket, which has no array child
            if (text.word(node.begin) == "[")
                return true;
            break;
        case NodeKind::declaration: {
            const NodeId type = tree.child(around, 0);
            if (has_qualifier(text, type, "const") || (node.parent == 0 && text.is_es()))
                return true;
            break;
        }
        case NodeKind::function: return false;
        default: break;
        }
    }
    return false;
}

std::optional<ValueType> expression_type(const ParsedText& text, const TreeFacts& facts, NodeId expression) {
    return Typer(text, facts).of(expression);
}

std::vector<NodeId> called_definitions(const ParsedText& text, const TreeFacts& facts, NodeId call) {
    return Typer(text, facts).called_definitions(call);
}

SingleValues::SingleValues(const ParsedText& text, const TreeFacts& facts) : text_(text) {
    const SyntaxTree& tree = text.tree();
    for (NodeId id = 1; id < tree.nodes.size(); ++id) {
        const NodeId function = tree.around(id, NodeKind::function);
        const NodeKind kind = tree[id].kind;
        if (kind == NodeKind::declarator || kind == NodeKind::parameter) {
            Declared& declared = declared_[{function, text.word_of(id)}];
            declared = {id, declared.times + 1};
        }
        for (const std::string_view name : names_set(text, facts, id)) {
            set_.insert({function, name});
            set_somewhere_.insert(name);
        }
    }
}

NodeId SingleValues::of(NodeId name) const {
    const SyntaxTree& tree = text_.tree();
    if (tree[name].kind != NodeKind::name)
        return k_no_node;
    const std::string_view word = text_.word_of(name);
    const Place local{tree.around(name, NodeKind::function), word};
    const auto inside = declared_.find(local), outside = declared_.find({k_no_node, word});
    const auto declared = inside != declared_.end() ? inside : outside;
    if (declared == declared_.end() || declared->second.times != 1 ||
        (declared == inside ? set_.contains(local) : set_somewhere_.contains(word)))
        return k_no_node;
    const NodeId node = declared->second.node;
    const bool has_value = tree[node].kind == NodeKind::declarator && tree.child_count(node) == 1 &&
                           !is_bracket(text_, tree.child(node, 0));
    return has_value ? tree.child(node, 0) : k_no_node;
}

} // namespace tidemark::glsl
