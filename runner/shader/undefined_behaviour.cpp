#include "shader/undefined_behaviour.hpp"

#include "shader/builtin_functions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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
        : text_(text), tree_(text.tree()), facts_(facts), differs_(tree_.nodes.size(), false) {
        names_.insert("gl_FragCoord");
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            declare(id);
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

private:
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
            found.push_back({id, *branch});
    }
    std::ranges::sort(found, {}, [&](const Divergent& each) { return tree[each.call].begin; });
    return found;
}

namespace {

/// Writes coordinates without their jumps. Follows sums, products and constructors only: any other function
/// may hide a jump.
class SmoothCoordinates {
public:
    SmoothCoordinates(const ParsedText& text, const TreeFacts& facts, NodeId look_up)
        : text_(text), tree_(text.tree()), facts_(facts), single_(text, facts), look_up_(look_up) {}

    std::optional<JumpingLookUp> run() {
        const NodeId coordinates = tree_.child(look_up_, 2);
        if (!jumps(coordinates) || (whole_ && part_))
            return std::nullopt;
        auto smooth = written(coordinates, false);
        auto other = angle_ ? written(coordinates, true) : std::string();
        if (!smooth || !other || smooth->size() > k_longest)
            return std::nullopt;
        return JumpingLookUp{look_up_, std::string(first_), *std::move(smooth), *std::move(other)};
    }

private:
    static constexpr size_t k_longest = 240;
    static constexpr int k_most_depth = 24;

    bool is_built_in(NodeId call) const {
        const std::string_view name = called_name(text_, call);
        return !name.empty() && !facts_.function(name);
    }

    /// Returns the initial value of a variable that never gets another, if it jumps.
    NodeId jumping_value(NodeId name, int depth) {
        const NodeId value = single_.of(name);
        return value != k_no_node && jumps(value, depth + 1) ? value : k_no_node;
    }

    bool jumps(NodeId id, int depth = 0) {
        if (depth > k_most_depth)
            return false;
        bool any = false;
        switch (tree_[id].kind) {
        case NodeKind::name: return jumping_value(id, depth) != k_no_node;
        case NodeKind::parenthesis:
        case NodeKind::prefix:
        case NodeKind::member: return jumps(tree_.child(id, 0), depth + 1);
        case NodeKind::binary:
            if (!is_arithmetic(text_.word_of(id)))
                return false;
            for (const size_t side : {0, 1})
                any = jumps(tree_.child(id, side), depth + 1) || any;
            return any;
        case NodeKind::call: break;
        default: return false;
        }
        if (!is_built_in(id))
            return false;
        const std::string_view name = called_name(text_, id);
        const size_t arguments = tree_.child_count(id) - 1;
        const bool angle = name == "atan" && arguments == 2;
        const bool part = name == "fract" || name == "mod";
        const bool whole = name == "floor" || name == "ceil" || name == "round" || name == "trunc";
        if (angle || part || whole) {
            if (first_.empty())
                first_ = name;
            angle_ = angle_ || angle;
            part_ = part_ || part;
            whole_ = whole_ || whole;
            if (!angle)
                jumps(tree_.child(id, 1), depth + 1); // one jump inside another
            return true;
        }
        if (class_of_type(name) != TypeClass::floating)
            return false;
        for (size_t i = 1; i <= arguments; ++i)
            any = jumps(tree_.child(id, i), depth + 1) || any;
        return any;
    }

    /// Returns whether the expression has the same value at the look-up: no name in it is set between.
    bool stays(NodeId id) const {
        if (tree_[id].kind == NodeKind::assign || tree_[id].kind == NodeKind::postfix ||
            (tree_[id].kind == NodeKind::call && !is_built_in(id)))
            return false;
        if (tree_[id].kind == NodeKind::name)
            for (NodeId other = 1; other < tree_.nodes.size(); ++other)
                if (tree_[other].begin > tree_[id].begin && tree_[other].begin < tree_[look_up_].begin)
                    for (const std::string_view set : names_set(text_, facts_, other))
                        if (set == text_.word_of(id))
                            return false;
        for (NodeId child = tree_[id].first_child; child != k_no_node; child = tree_[child].next)
            if (!stays(child))
                return false;
        return true;
    }

    std::optional<std::string> written(NodeId id, bool other_angle, int depth = 0) {
        if (depth > k_most_depth)
            return std::nullopt;
        if (!jumps(id))
            return stays(id) ? std::optional(text_.excerpt(id)) : std::nullopt;
        const auto part = [&](size_t index) {
            return written(tree_.child(id, index), other_angle, depth + 1);
        };
        switch (tree_[id].kind) {
        case NodeKind::name: {
            const auto value = written(single_.of(id), other_angle, depth + 1);
            return value ? std::optional("(" + *value + ")") : std::nullopt;
        }
        case NodeKind::parenthesis: {
            const auto inside = part(0);
            return inside ? std::optional("(" + *inside + ")") : std::nullopt;
        }
        case NodeKind::prefix: {
            const auto inside = part(0);
            return inside ? std::optional(std::string(text_.word_of(id)) + "(" + *inside + ")")
                          : std::nullopt;
        }
        case NodeKind::member: {
            const auto inside = part(0);
            return inside ? std::optional(fmt::format("({}).{}", *inside, text_.word_of(id))) : std::nullopt;
        }
        case NodeKind::binary: {
            const auto left = part(0), right = part(1);
            return left && right ? std::optional(fmt::format("{} {} {}", *left, text_.word_of(id), *right))
                                 : std::nullopt;
        }
        default: break;
        }
        const std::string_view name = called_name(text_, id);
        std::vector<std::string> arguments;
        for (size_t i = 1; i < tree_.child_count(id); ++i) {
            auto argument = part(i);
            if (!argument)
                return std::nullopt;
            arguments.push_back(*std::move(argument));
        }
        if (name == "fract" || name == "mod")
            return "(" + arguments[0] + ")";
        if (name == "atan" && arguments.size() == 2)
            return other_angle ? fmt::format("atan(-({}), -({}))", arguments[0], arguments[1])
                               : fmt::format("atan({}, {})", arguments[0], arguments[1]);
        if (class_of_type(name) != TypeClass::floating)
            return fmt::format("(0.0 * ({}))", arguments[0]); // the whole part: flat between its jumps
        return fmt::format("{}({})", name, fmt::join(arguments, ", "));
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    SingleValues single_;
    NodeId look_up_;
    std::string_view first_{}; ///< the function that jumps
    bool angle_ = false, part_ = false, whole_ = false;
};

/// Returns whether the call is a look-up with a named sampler that has mipmaps, and no level or bias.
bool chooses_mipmap(const ParsedText& text, const TreeFacts& facts, NodeId call,
                    const std::function<bool(std::string_view sampler)>& has_mipmaps) {
    const SyntaxTree& tree = text.tree();
    const NodeId sampler = tree.child(call, 1);
    return called_name(text, call) == "texture" && !facts.function("texture") &&
           tree.child_count(call) == 3 && tree[sampler].kind == NodeKind::name &&
           has_mipmaps(text.word_of(sampler));
}

} // namespace

std::vector<JumpingLookUp>
find_jumping_look_ups(const ParsedText& text, const TreeFacts& facts,
                      const std::function<bool(std::string_view sampler)>& has_mipmaps) {
    const SyntaxTree& tree = text.tree();
    const auto reached = functions_of_main(text, facts);
    std::vector<JumpingLookUp> found;
    for (NodeId id = 1; id < tree.nodes.size(); ++id) {
        if (tree[id].kind != NodeKind::call || !chooses_mipmap(text, facts, id, has_mipmaps))
            continue;
        const NodeId function = tree.around(id, NodeKind::function);
        if (function != k_no_node && reached.contains(text.word_of(function)))
            if (auto jumping = SmoothCoordinates(text, facts, id).run())
                found.push_back(*std::move(jumping));
    }
    std::ranges::sort(found, {}, [&](const JumpingLookUp& each) { return tree[each.call].begin; });
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
