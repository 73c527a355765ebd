#include "shader/undefined_behaviour.hpp"

#include "shader/builtin_functions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>
#include <unordered_set>

namespace tidemark::glsl {
namespace {

bool is_arithmetic(std::string_view op) {
    return op == "+" || op == "-" || op == "*" || op == "/";
}

/// Returns whether evaluating the node twice has no side effect.
bool is_pure(const SyntaxTree& tree, NodeId id) {
    switch (tree[id].kind) {
    case NodeKind::call:
    case NodeKind::assign:
    case NodeKind::postfix:
    case NodeKind::prefix: return false; // ++ and --; other prefixes appear only in a target's index
    default: break;
    }
    for (NodeId child = tree[id].first_child; child != k_no_node; child = tree[child].next)
        if (!is_pure(tree, child))
            return false;
    return true;
}

} // namespace

bool is_float_operation(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    const SyntaxTree& tree = text.tree();
    switch (tree[id].kind) {
    case NodeKind::binary: return is_arithmetic(text.word_of(id)) && !facts.surely_whole[id];
    case NodeKind::assign: {
        const std::string_view op = text.word_of(id);
        const NodeId target = tree.child(id, 0);
        return op.size() == 2 && is_arithmetic(op.substr(0, 1)) && !facts.surely_whole[target] &&
               is_pure(tree, target);
    }
    case NodeKind::call: {
        const std::string_view name = called_name(text, id);
        if (name.empty() || facts.is_type(name))
            return false;
        const FunctionFacts* function = facts.function(name);
        if (function)
            return !function->returns_nothing && !function->returns_array;
        return !name.ends_with("Extended") && name != "barrier" && !name.starts_with("memoryBarrier") &&
               !name.starts_with("image") && !name.starts_with("textureSize") && !name.starts_with("atomic");
    }
    default: return false;
    }
}

namespace {

using Names = std::unordered_set<std::string_view>;

/// Finds the values that may differ between pixels: those computed from such values, and those assigned under
/// a condition that depends on them. Derives from that where neighbouring pixels take different paths.
class DivergentRegions {
public:
    DivergentRegions(const ParsedText& text, const TreeFacts& facts)
        : text_(text), tree_(text.tree()), facts_(facts), single_(text, facts),
          differs_(tree_.nodes.size(), false) {
        names_.insert("gl_FragCoord");
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            declare(id);
            note_place(id);
        }
        while (round()) { // each round only adds entries, so this ends
        }
    }

    /// Returns the branch that separates pixels before they reach the node.
    std::optional<DivergentBranch> before(NodeId node) const {
        const NodeId function = tree_.around(node, NodeKind::function);
        if (const NodeId condition = condition_within(function, node); condition != k_no_node)
            return DivergentBranch{condition};
        if (const NodeId exit = exit_before(function, node); exit != k_no_node)
            return DivergentBranch{exit, true};
        const auto divergent =
            divergent_functions_.find(function == k_no_node ? "" : text_.word_of(function));
        return divergent == divergent_functions_.end() ? std::nullopt : std::optional(divergent->second);
    }

    /// Returns whether neighbours on other paths have the value of an expression: its names were set before
    /// the paths part, and it consists of their sums and multiples.
    bool neighbours_have(NodeId expression, int depth = 0) const {
        constexpr int k_deepest = 24;
        if (!differs_[expression])
            return true;
        if (depth > k_deepest)
            return false;
        const auto part = [&](size_t index) {
            return neighbours_have(tree_.child(expression, index), depth + 1);
        };
        const auto same = [&](size_t index) { return !differs_[tree_.child(expression, index)]; };
        switch (tree_[expression].kind) {
        case NodeKind::name: return neighbours_have_name(expression, depth);
        case NodeKind::parenthesis:
        case NodeKind::member: return part(0);
        case NodeKind::prefix: return text_.word_of(expression) == "-" && part(0);
        case NodeKind::binary: {
            const std::string_view sign = text_.word_of(expression);
            return sign == "*"   ? (same(0) || same(1)) && part(0) && part(1)
                   : sign == "/" ? same(1) && part(0)
                                 : (sign == "+" || sign == "-") && part(0) && part(1);
        }
        case NodeKind::call: {
            const std::string_view name = called_name(text_, expression);
            if (name.empty() || class_of_type(name) != TypeClass::floating)
                return false;
            for (size_t i = 1; i < tree_.child_count(expression); ++i)
                if (!part(i))
                    return false;
            return true;
        }
        default: return false;
        }
    }

private:
    bool neighbours_have_name(NodeId name, int depth) const {
        const std::string_view word = text_.word_of(name);
        if (word == "gl_FragCoord")
            return true;
        const NodeId function = tree_.around(name, NodeKind::function);
        const auto locals = locals_.find(function);
        if (function == k_no_node || locals == locals_.end() || !locals->second.contains(word))
            return false;
        const auto sets = sets_.find({function, word});
        const auto paths = where_paths_part(function, name);
        const bool before = sets == sets_.end() || std::ranges::all_of(sets->second, [&](size_t at) {
                                return at < paths.first || at >= paths.last;
                            });
        if (before && !divergent_functions_.contains(text_.word_of(function)))
            return true;
        const NodeId value = single_.of(name);
        if (value != k_no_node)
            return neighbours_have(value, depth + 1);
        return sets == sets_.end() && callers_have(function, word, depth);
    }

    /// Returns whether neighbours have the argument in every call of the function.
    bool callers_have(NodeId function, std::string_view parameter, int depth) const {
        const auto calls = calls_.find(text_.word_of(function));
        if (calls == calls_.end())
            return false;
        for (size_t i = 1; i < tree_.child_count(function); ++i) {
            const NodeId each = tree_.child(function, i);
            if (tree_[each].kind != NodeKind::parameter || text_.word_of(each) != parameter)
                continue;
            return std::ranges::all_of(calls->second, [&](NodeId call) {
                const NodeId argument = tree_.child(call, i);
                return argument != k_no_node && neighbours_have(argument, depth + 1);
            });
        }
        return false;
    }

    /// The words between which some pixels of a function are on another path, or in another iteration.
    struct Parted {
        size_t first, last;
    };

    /// Returns the words before and around the node; its own place if no condition of the function separates
    /// the pixels that reach it.
    Parted where_paths_part(NodeId function, NodeId node) const {
        Parted parted{tree_[node].begin, tree_[node].begin};
        for (NodeId inner = node, outer = tree_[node].parent; inner != function && inner != k_no_node;
             inner = outer, outer = tree_[outer].parent)
            if (const NodeId condition = condition_over(inner, outer);
                condition != k_no_node && (differs_[condition] || divergent_loops_.contains(outer))) {
                const bool repeats = is_loop(tree_[outer].kind);
                parted.first = std::min<size_t>(parted.first, tree_[repeats ? outer : condition].begin);
                if (repeats)
                    parted.last = tree_[outer].end;
            }
        if (const NodeId exit = exit_before(function, node); exit != k_no_node)
            parted.first = std::min<size_t>(parted.first, tree_[exit].begin);
        return parted;
    }

    /// Records where variables are set, and calls of functions.
    void note_place(NodeId id) {
        const NodeId function = tree_.around(id, NodeKind::function);
        if (function == k_no_node)
            return;
        if (tree_[id].kind == NodeKind::declarator)
            sets_[{function, text_.word_of(id)}].push_back(tree_[id].begin);
        if (is_expression(tree_[id].kind))
            for (const std::string_view name : names_set(text_, facts_, id))
                sets_[{function, name}].push_back(tree_[id].begin);
        if (tree_[id].kind == NodeKind::call)
            if (const std::string_view name = called_name(text_, id); !name.empty())
                calls_[name].push_back(id);
    }

    /// Returns the condition of `outer` that decides whether, or how often, its child `inner` runs.
    NodeId condition_over(NodeId inner, NodeId outer) const {
        const auto first = tree_.child(outer, 0);
        switch (tree_[outer].kind) {
        case NodeKind::if_else:
        case NodeKind::conditional:
        case NodeKind::switch_on:
        case NodeKind::loop_while: return inner == first ? k_no_node : first;
        case NodeKind::loop_for: return inner == first ? k_no_node : tree_.child(outer, 1);
        case NodeKind::loop_do: return tree_.child(outer, 1);
        case NodeKind::binary: {
            const std::string_view word = text_.word_of(outer);
            return inner != first && (word == "&&" || word == "||") ? first : k_no_node;
        }
        default: return k_no_node;
        }
    }

    /// Returns the innermost condition in `scope` that separates pixels before the node; k_no_node: none.
    NodeId condition_within(NodeId scope, NodeId node) const {
        for (NodeId inner = node, outer = tree_[node].parent; inner != scope && inner != k_no_node;
             inner = outer, outer = tree_[outer].parent)
            if (const NodeId condition = condition_over(inner, outer);
                condition != k_no_node && (differs_[condition] || divergent_loops_.contains(outer)))
                return condition;
        return k_no_node;
    }

    /// A statement at which some pixels leave `scope`, which is a function or a loop's body.
    struct Exit {
        NodeId statement;
        NodeId scope;
    };

    /// Returns the function's first exit that precedes the node and leads to it; k_no_node: none.
    NodeId exit_before(NodeId function, NodeId node) const {
        const auto exits = exits_.find(function);
        if (exits != exits_.end())
            for (const Exit& exit : exits->second)
                if (tree_[exit.statement].end <= tree_[node].begin && tree_.is_within(node, exit.scope) &&
                    leads_to(exit.statement, node))
                    return exit.statement;
        return k_no_node;
    }

    /// Returns whether a pixel that stays at `exit` may reach the later node. It does not if the two are in
    /// opposite branches or if an unconditional jump is between them.
    bool leads_to(NodeId exit, NodeId node) const {
        NodeId from = exit;
        while (!tree_.is_within(node, tree_[from].parent))
            from = tree_[from].parent;
        const NodeId common = tree_[from].parent;
        if (tree_[common].kind == NodeKind::if_else || tree_[common].kind == NodeKind::conditional)
            return from == tree_.child(common, 0);
        for (NodeId between = tree_[from].next; between != k_no_node && !tree_.is_within(node, between);
             between = tree_[between].next)
            if (tree_[between].kind == NodeKind::jump || tree_[between].kind == NodeKind::return_statement)
                return false;
        return true;
    }

    /// Returns whether anything new was found. Children have smaller numbers than their parents.
    bool round() {
        const size_t before = found_;
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            differs_[id] = differs_by_itself(id);
            for (NodeId child = tree_[id].first_child; child != k_no_node; child = tree_[child].next)
                differs_[id] = differs_[id] || differs_[child];
        }
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            note(id);
        return found_ > before;
    }

    bool differs_by_itself(NodeId id) const {
        if (tree_[id].kind == NodeKind::name)
            return names_.contains(text_.word_of(id));
        return tree_[id].kind == NodeKind::call && functions_.contains(called_name(text_, id));
    }

    /// Records names that are not visible outside their function.
    void declare(NodeId id) {
        const bool handed_out =
            tree_[id].kind == NodeKind::parameter && (has_qualifier(text_, tree_.child(id, 0), "out") ||
                                                      has_qualifier(text_, tree_.child(id, 0), "inout"));
        if ((tree_[id].kind == NodeKind::declarator || tree_[id].kind == NodeKind::parameter) && !handed_out)
            locals_[tree_.around(id, NodeKind::function)].insert(text_.word_of(id));
    }

    void add(Names& names, std::string_view name) { found_ += names.insert(name).second; }

    void note(NodeId id) {
        const NodeId first = tree_.child(id, 0);
        switch (tree_[id].kind) {
        case NodeKind::assign:
            if (differs_[id] || set_by_some(id))
                add(names_, text_.word_of(base_of(tree_, first)));
            return;
        case NodeKind::prefix:
        case NodeKind::postfix:
            if ((text_.word_of(id) == "++" || text_.word_of(id) == "--") && set_by_some(id))
                add(names_, text_.word_of(base_of(tree_, first)));
            return;
        case NodeKind::declarator:
            if (differs_[id] || (first != k_no_node && is_divergent(id)))
                add(names_, text_.word_of(id));
            return;
        case NodeKind::call: call(id); return;
        case NodeKind::return_statement:
        case NodeKind::jump: leave(id); return;
        default: return;
        }
    }

    /// Returns whether a condition, or a divergent call of the function, separates pixels before the node.
    bool is_divergent(NodeId id) const {
        const NodeId function = tree_.around(id, NodeKind::function);
        return function != k_no_node && (divergent_functions_.contains(text_.word_of(function)) ||
                                         condition_within(function, id) != k_no_node);
    }

    /// After an exit, a function's own variables exist only for the pixels that stayed; after a `continue`
    /// the other pixels come back.
    bool set_by_some(NodeId assignment) const {
        if (is_divergent(assignment))
            return true;
        const NodeId function = tree_.around(assignment, NodeKind::function);
        const NodeId exit = exit_before(function, assignment);
        if (exit == k_no_node)
            return false;
        const auto locals = locals_.find(function);
        return text_.word_of(exit) == "continue" || locals == locals_.end() ||
               !locals->second.contains(text_.word_of(base_of(tree_, tree_.child(assignment, 0))));
    }

    /// Marks parameters with differing arguments. A variable passed to an `out` parameter of an author's
    /// function is assumed to differ.
    void call(NodeId id) {
        const std::string_view name = called_name(text_, id);
        const FunctionFacts* function = name.empty() ? nullptr : facts_.function(name);
        if (function) {
            if (auto branch = before(id)) {
                branch->called = true;
                found_ += divergent_functions_.emplace(name, *branch).second;
            }
            if (discarding_.contains(name))
                leave(id);
        }
        size_t index = 0;
        for (NodeId part = tree_[tree_.child(id, 0)].next; part != k_no_node;
             part = tree_[part].next, ++index) {
            if (!name.empty() && facts_.writes_argument(name, index) && (differs_[id] || function))
                add(names_, text_.word_of(base_of(tree_, part)));
            if (function && differs_[part])
                for (const NodeId definition : function->definitions)
                    if (const NodeId parameter = tree_.child(definition, index + 1);
                        parameter != k_no_node && tree_[parameter].kind == NodeKind::parameter)
                        add(names_, text_.word_of(parameter));
        }
    }

    /// Records a statement that leaves a function or a loop: return, discard, continue, break, or a call that
    /// discards.
    void leave(NodeId id) {
        const NodeId function = tree_.around(id, NodeKind::function);
        if (function == k_no_node)
            return;
        const bool returns = tree_[id].kind == NodeKind::return_statement;
        const bool discards = tree_[id].kind == NodeKind::call || text_.word_of(id) == "discard";
        const bool continues = tree_[id].kind == NodeKind::jump && text_.word_of(id) == "continue";
        if (discards)
            add(discarding_, text_.word_of(function));
        if (returns && (differs_[id] || is_divergent(id)))
            add(functions_, text_.word_of(function));
        if (returns || discards)
            leave(id, function, discards && partly_.contains(called_name_or_none(id)));
        else if (const NodeId around = left_by(id); around != k_no_node && continues)
            leave(id, body_of(around), false);
        else if (around != k_no_node && condition_within(around, id) != k_no_node)
            found_ += divergent_loops_.insert(around).second;
    }

    /// Records the exit; `partly`: the statement itself stops only some of the pixels.
    void leave(NodeId id, NodeId scope, bool partly) {
        if (!partly && condition_within(scope, id) == k_no_node)
            return;
        const NodeId function = tree_.around(id, NodeKind::function);
        std::vector<Exit>& exits = exits_[function];
        if (std::ranges::find(exits, id, &Exit::statement) != exits.end())
            return;
        exits.push_back({id, scope});
        std::ranges::sort(exits, {}, [&](const Exit& exit) { return tree_[exit.statement].begin; });
        ++found_;
        if (scope != function)
            return;
        if (tree_[id].kind != NodeKind::return_statement)
            add(partly_, text_.word_of(function));
        for (NodeId around = tree_[id].parent; around != function; around = tree_[around].parent)
            if (is_loop(tree_[around].kind))
                found_ += divergent_loops_.insert(around).second;
    }

    std::string_view called_name_or_none(NodeId id) const {
        return tree_[id].kind == NodeKind::call ? called_name(text_, id) : std::string_view{};
    }

    /// Returns the loop that a break or a continue refers to; k_no_node: it leaves a switch.
    NodeId left_by(NodeId jump) const {
        for (NodeId around = tree_[jump].parent; around != k_no_node; around = tree_[around].parent) {
            if (is_loop(tree_[around].kind))
                return around;
            if (tree_[around].kind == NodeKind::switch_on && text_.word_of(jump) == "break")
                return k_no_node;
        }
        return k_no_node;
    }

    NodeId body_of(NodeId loop) const {
        return tree_.child(loop, tree_[loop].kind == NodeKind::loop_for     ? 3
                                 : tree_[loop].kind == NodeKind::loop_while ? 1
                                                                            : 0);
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    SingleValues single_;
    std::map<std::pair<NodeId, std::string_view>, std::vector<size_t>> sets_; ///< by function and name
    std::unordered_map<std::string_view, std::vector<NodeId>> calls_;         ///< by function
    size_t found_ = 0;          ///< number of entries in the members below
    std::vector<bool> differs_; ///< per expression
    Names names_;               ///< variables that differ
    Names functions_;           ///< functions whose result differs
    Names discarding_;          ///< functions that may discard
    Names partly_;              ///< functions that discard some of the pixels
    /// Functions that only some of the pixels call, by name.
    std::unordered_map<std::string_view, DivergentBranch> divergent_functions_;
    std::unordered_map<NodeId, std::vector<Exit>> exits_; ///< by function, in the order of the text
    std::unordered_map<NodeId, Names> locals_;            ///< by function
    std::unordered_set<NodeId> divergent_loops_;
};

/// Returns whether a look-up has a bias, such as -100.0, by which it reads the base level whatever its
/// coordinates' derivatives are.
bool always_base_level(const ParsedText& text, NodeId look_up) {
    constexpr double k_least_size = 10;
    const NodeId bias = text.tree().child(look_up, 3);
    if (bias == k_no_node)
        return false;
    if (text.tree()[bias].kind != NodeKind::prefix || text.word_of(bias) != "-")
        return false;
    const auto size = number(text.word_of(text.tree().child(bias, 0)));
    return size && *size >= k_least_size;
}

} // namespace

std::vector<Divergent> find_divergent(const ParsedText& text, const TreeFacts& facts,
                                      const std::function<bool(std::string_view sampler)>& has_mipmaps) {
    const SyntaxTree& tree = text.tree();
    const auto reached = functions_of_main(text, facts);
    const auto needs_neighbours = [&](NodeId call) {
        const std::string_view name = called_name(text, call);
        const NodeId sampler = tree.child(call, 1);
        const BuiltinFunction* const builtin = facts.function(name) ? nullptr : find_builtin(name);
        return builtin && (builtin->is(Trait::derivative) ||
                           (builtin->is(Trait::implicit_lod) && sampler != k_no_node &&
                            tree[sampler].kind == NodeKind::name && has_mipmaps(text.word_of(sampler))));
    };
    const auto coordinates = [&](NodeId call) {
        const bool derivative = find_builtin(called_name(text, call))->is(Trait::derivative);
        return tree.child(call, derivative ? 1 : 2);
    };
    std::optional<DivergentRegions> regions; // created on demand: most texts need none
    std::vector<Divergent> found;
    for (NodeId id = 1; id < tree.nodes.size(); ++id) {
        if (tree[id].kind != NodeKind::call || !needs_neighbours(id))
            continue;
        const NodeId function = tree.around(id, NodeKind::function);
        if (function == k_no_node || !reached.contains(text.word_of(function)))
            continue;
        if (!regions)
            regions.emplace(text, facts);
        if (const auto branch = regions->before(id))
            found.push_back(
                {id, *branch, always_base_level(text, id) || regions->neighbours_have(coordinates(id))});
    }
    std::ranges::sort(found, {}, [&](const Divergent& each) { return tree[each.call].begin; });
    return found;
}

std::vector<Unassigned> find_unassigned(const ParsedText& text, const TreeFacts& facts) {
    using Why = Unassigned::Why;
    std::vector<Unassigned> found;
    Shapes shapes(text);
    const Assignment all = find_assignment(text, facts, shapes);
    for (const UnsetVariable& variable : all.variables) {
        if (variable.doubtful || !variable.runs)
            continue;
        if (variable.read != k_no_node)
            found.push_back(
                {variable.written ? Why::on_some_way : Why::never, variable.declared, variable.read});
        else if (variable.left != k_no_node)
            found.push_back({variable.written ? Why::left_on_some_way : Why::not_given, variable.declared,
                             variable.left});
    }
    for (const NodeId function : all.without_return)
        found.push_back({Why::no_return, function, function});
    return found;
}

} // namespace tidemark::glsl
