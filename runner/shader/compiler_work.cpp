// Finds what a compiler leaves out of a text: work whose result is not read, and work whose result it knows
// before the program runs. Finds also which variables it reads earlier than the text says.
#include "shader/builtin_functions.hpp"
#include "shader/loops.hpp"
#include "shader/march_record.hpp"
#include "shader/source_edits.hpp"
#include "shader/tree_facts.hpp"
#include "shader/variables.hpp"
#include "shader/variation.hpp"
#include "shader/vocabulary.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace tidemark::glsl {

NamesSet globals_set(const ParsedText& text, const TreeFacts& facts) {
    const SyntaxTree& tree = text.tree();
    NamesSet sets, calls;
    std::set<std::string_view> globals;
    for (const NodeId declaration : tree.children(0))
        for (const NodeId name : tree.children(declaration))
            if (tree[name].kind == NodeKind::declarator)
                globals.insert(text.word_of(name));
    for (NodeId id = 1; id < tree.nodes.size(); ++id) {
        const NodeId function = tree.around(id, NodeKind::function);
        if (function == k_no_node)
            continue;
        for (const std::string_view name : names_set(text, facts, id))
            if (globals.contains(name))
                sets[text.word_of(function)].insert(name);
        if (calls_authors_function(text, facts, id))
            calls[text.word_of(function)].insert(called_name(text, id));
    }
    for (bool grows = true; std::exchange(grows, false);)
        for (const auto& [caller, called] : calls)
            for (const std::string_view name : called)
                for (const std::string_view global : std::set(sets[name]))
                    grows = sets[caller].insert(global).second || grows;
    return sets;
}

void add_names_set(const ParsedText& text, const TreeFacts& facts, const NamesSet& globals, NodeId id,
                   std::set<std::string_view>& names) {
    for (const std::string_view name : names_set(text, facts, id))
        names.insert(name);
    if (!calls_authors_function(text, facts, id))
        return;
    if (const auto set = globals.find(called_name(text, id)); set != globals.end())
        names.insert(set->second.begin(), set->second.end());
}

bool is_number_read(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    const SyntaxTree& tree = text.tree();
    const auto type = expression_type(text, facts, id);
    if (!type || type->matrix() || (type->base != 'f' && !(type->scalar() && type->base != 'b')))
        return false;
    NodeId whole = id;
    const auto names_part_of_it = [&](NodeId parent) {
        return tree[parent].kind == NodeKind::member || tree[parent].kind == NodeKind::parenthesis ||
               (tree[parent].kind == NodeKind::index && tree.child(parent, 0) == whole);
    };
    while (names_part_of_it(tree[whole].parent))
        whole = tree[whole].parent;
    const NodeId use = tree[whole].parent;
    return is_change(text, use) ? tree.child(use, 0) != whole : names_set(text, facts, use).empty();
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
        sets_ = globals_set(text_, facts_);
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
    std::set<std::string_view> runs_; ///< functions, overloads taken together
    NamesSet sets_;                   ///< global variables that a function sets
    NodeId function_ = k_no_node;
    bool grew_ = true;
};

} // namespace

std::vector<bool> find_needed(const ParsedText& text, const TreeFacts& facts) {
    return NeededFinder(text, facts).run();
}

namespace {

/// Functions that SwiftShader's compiler (SPIRV-Tools) computes of values that are not constant expressions.
constexpr std::string_view k_folded[] = {"mix",  "min", "max", "clamp", "sin",  "cos",  "tan", "asin", "acos",
                                         "atan", "exp", "log", "exp2",  "log2", "sqrt", "pow", "dot"};

/// Works in rounds, for a parameter gets its values after its function in the text.
class KnownFinder {
public:
    KnownFinder(const ParsedText& text, const TreeFacts& facts, KnownTo whom)
        : text_(text), tree_(text.tree()), facts_(facts), whom_(whom), single_(text, facts) {}

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
            if (whom_ != KnownTo::swiftshader)
                find_settled_globals();
        }
        return std::move(known_);
    }

private:
    using Name = std::pair<NodeId, std::string_view>; ///< its function; k_no_node: global

    void find_values() {
        known_.assign(tree_.nodes.size(), false);
        constant_ = known_;
        pure_.clear();
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) { // children come before their parents
            known_[id] = is_known(id);
            constant_[id] = known_[id] && is_constant(id);
        }
    }

    bool is_known(NodeId id) {
        const NodeKind kind = tree_[id].kind;
        if (kind == NodeKind::literal || !is_expression(kind))
            return kind == NodeKind::literal;
        if (kind == NodeKind::name)
            return !is_callee(id) && is_known_name(id);
        const size_t first = kind == NodeKind::call ? 1 : 0;
        if (tree_.child_count(id) <= first || is_change(text_, id) || !has_all_children(id, known_))
            return false;
        return kind != NodeKind::call || calls_pure(id);
    }

    /// Returns whether the known expression is a constant one: it reads only variables that are `const`.
    bool is_constant(NodeId id) const {
        if (tree_[id].kind != NodeKind::name)
            return has_all_children(id, constant_);
        const NodeId value = single_.of(id), declaration = tree_.around(value, NodeKind::declaration);
        return value != k_no_node && constant_[value] &&
               has_qualifier(text_, tree_.child(declaration, 0), "const");
    }

    bool has_all_children(NodeId id, const std::vector<bool>& flags) const {
        return std::ranges::all_of(tree_.children(id),
                                   [&](NodeId child) { return flags[child] || is_callee(child); });
    }

    bool is_callee(NodeId id) const {
        const NodeId parent = tree_[id].parent;
        return tree_[parent].kind == NodeKind::call && tree_.child(parent, 0) == id;
    }

    bool calls_pure(NodeId call) {
        const std::string_view name = called_name(text_, call);
        if (const FunctionFacts* const function = facts_.function(name))
            return whom_ != KnownTo::swiftshader &&
                   std::ranges::all_of(function->definitions, [&](NodeId each) { return is_pure(each); });
        const BuiltinFunction* const builtin = find_builtin(name);
        if (builtin && whom_ == KnownTo::swiftshader && !has_all_children(call, constant_))
            return is_folded_by_swiftshader(name);
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
            return whom_ == KnownTo::frame && !name.starts_with("gl_");
        return names_.contains({k_no_node, name});
    }

    /// Finds parameters that nothing sets or hides and that get a known value in each call.
    void find_parameters() {
        std::set<Name> varies;
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            if (tree_[id].kind == NodeKind::declarator)
                varies.insert({tree_.around(id, NodeKind::function), text_.word_of(id)});
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
    KnownTo whom_;
    SingleValues single_;
    std::set<Name> declared_;
    std::map<Name, std::vector<NodeId>> sets_; ///< expressions that set a variable, by the function around
    std::set<Name> names_;                     ///< parameters and global variables with a known value
    std::map<NodeId, bool> pure_;              ///< functions of is_pure
    std::vector<bool> known_, constant_;
};

} // namespace

std::vector<bool> find_known(const ParsedText& text, const TreeFacts& facts, KnownTo whom) {
    return KnownFinder(text, facts, whom).run();
}

bool is_folded_by_swiftshader(std::string_view name) {
    return std::ranges::find(k_folded, name) != std::end(k_folded);
}

namespace {

class UnknownFinder {
public:
    UnknownFinder(const ParsedText& text, const TreeFacts& facts, const std::vector<bool>& known)
        : text_(text), tree_(text.tree()), facts_(facts), known_(known), globals_(globals_set(text, facts)) {}

    std::vector<NodeId> run() {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            if (tree_[id].kind == NodeKind::call && !known_[id] && is_left_to_run(id))
                found_.insert(id);
            if (is_loop(tree_[id].kind))
                look_at_loop(id);
        }
        return {found_.begin(), found_.end()};
    }

private:
    /// Returns whether the node calls a built-in function that the compiler does not compute, for floats.
    bool is_left_to_run(NodeId call) const {
        const std::string_view name = called_name(text_, call);
        const BuiltinFunction* const builtin = facts_.function(name) ? nullptr : find_builtin(name);
        return builtin && builtin->is(Trait::pure) && !is_folded_by_swiftshader(name) && is_float(call);
    }

    bool is_float(NodeId id) const {
        const auto type = expression_type(text_, facts_, id);
        return type && type->base == 'f' && !type->matrix();
    }

    /// Finds what reads variables that the loop sets, in its body and after it in its function.
    void look_at_loop(NodeId loop) {
        std::set<std::string_view> names;
        const auto add_names = [&](NodeId id) { add_names_set(text_, facts_, globals_, id, names); };
        const NodeId function = tree_.around(loop, NodeKind::function), body = body_of_loop(tree_, loop);
        for (NodeId id = loop; id != k_no_node && tree_.is_within(id, loop); --id)
            add_names(id);
        for (NodeId id = body; id != k_no_node && tree_.is_within(id, body); --id)
            if (tree_[id].kind == NodeKind::declarator)
                names.erase(text_.word_of(id));
        for (NodeId id = body; id != k_no_node && tree_.is_within(id, body); --id)
            look_at(id, names);
        for (NodeId id = loop + 1; id < function; ++id)
            look_at(id, names);
    }

    /// Notes a read of one of the variables; if it is an index, the element.
    void look_at(NodeId id, const std::set<std::string_view>& names) {
        if (tree_[id].kind != NodeKind::name || !names.contains(text_.word_of(id)))
            return;
        NodeId read = id;
        for (NodeId up = id; is_expression(tree_[up].kind); up = tree_[up].parent)
            if (const NodeId parent = tree_[up].parent;
                tree_[parent].kind == NodeKind::index && tree_.child(parent, 1) == up)
                read = parent;
        if (is_number_read(text_, facts_, read))
            found_.insert(read);
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    const std::vector<bool>& known_;
    NamesSet globals_;
    std::set<NodeId> found_;
};

class ReadsFinder {
public:
    ReadsFinder(const ParsedText& text, const TreeFacts& facts)
        : text_(text), tree_(text.tree()), facts_(facts), globals_(globals_set(text, facts)) {}

    ReadsBeforeSettings run() {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            if (!is_expression(tree_[id].kind) || tree_.around(id, NodeKind::function) == k_no_node)
                continue;
            names_.clear();
            add_names_set(text_, facts_, globals_, id, names_);
            if (!names_.empty())
                look_left_of(id);
        }
        return {{early_.begin(), early_.end()}, {late_.begin(), late_.end()}};
    }

private:
    void look_left_of(NodeId setting) {
        for (NodeId id = setting, parent = tree_[id].parent; is_expression(tree_[parent].kind);
             id = std::exchange(parent, tree_[parent].parent)) {
            if (tree_[parent].kind == NodeKind::comma)
                continue; // what is left of it is done
            for (const NodeId left : tree_.children(parent)) {
                if (left == id)
                    break;
                operand_ = without_brackets(tree_, left);
                look_at(operand_);
            }
        }
    }

    void look_at(NodeId id) {
        if (tree_[id].kind == NodeKind::name && names_.contains(text_.word_of(id)))
            return note(id);
        for (const NodeId child : tree_.children(id))
            look_at(child);
    }

    /// Notes the place that begins with the name, if an operator reads it.
    void note(NodeId name) {
        NodeId place = name;
        const auto is_part = [&](NodeId parent) {
            return (tree_[parent].kind == NodeKind::member || tree_[parent].kind == NodeKind::index) &&
                   tree_.child(parent, 0) == place;
        };
        while (place != operand_ && is_part(tree_[place].parent))
            place = tree_[place].parent;
        const NodeId parent = tree_[place].parent;
        if (place == operand_)
            late_.insert(name);
        if (place == operand_ || (is_change(text_, parent) && tree_.child(parent, 0) == place))
            return;
        if (tree_[parent].kind == NodeKind::call)
            for (size_t i = 0; i < tree_.child_count(parent); ++i)
                if (tree_.child(parent, i) == place &&
                    (i == 0 || facts_.writes_argument(called_name(text_, parent), i - 1)))
                    return;
        if (expression_type(text_, facts_, place))
            early_.insert(place);
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    NamesSet globals_;
    std::set<std::string_view> names_; ///< that an expression sets
    NodeId operand_ = k_no_node;       ///< an operand to the left of it
    std::set<NodeId> early_, late_;
};

} // namespace

ReadsBeforeSettings reads_before_settings(const ParsedText& text, const TreeFacts& facts) {
    return ReadsFinder(text, facts).run();
}

std::vector<NodeId> find_unknown(const ParsedText& text, const TreeFacts& facts,
                                 const std::vector<bool>& known) {
    return UnknownFinder(text, facts, known).run();
}

} // namespace tidemark::glsl
