#include "shader/undefined_behaviour.hpp"

#include "shader/builtin_functions.hpp"

#include <algorithm>
#include <charconv>
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

/// Returns the value of a literal, also in parentheses or after a minus sign.
std::optional<double> number_of(const ParsedText& text, NodeId id) {
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind == NodeKind::parenthesis)
        return number_of(text, tree.child(id, 0));
    if (tree[id].kind == NodeKind::prefix && text.word_of(id) == "-") {
        const auto inside = number_of(text, tree.child(id, 0));
        return inside ? std::optional(-*inside) : std::nullopt;
    }
    if (tree[id].kind != NodeKind::literal)
        return std::nullopt;
    double value = 0;
    const std::string_view digits = text.word_of(id);
    if (std::from_chars(digits.data(), digits.data() + digits.size(), value).ec != std::errc{})
        return std::nullopt;
    return value;
}

/// Returns the numbers of a literal or of a constructor of literals, such as `vec3(1.0, 2.0, 3.0)`.
std::optional<std::vector<double>> numbers_of(const ParsedText& text, NodeId id) {
    if (const auto one = number_of(text, id))
        return std::vector<double>{*one};
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind != NodeKind::call || class_of_type(called_name(text, id)) != TypeClass::floating)
        return std::nullopt;
    std::vector<double> all;
    for (NodeId part = tree[tree.child(id, 0)].next; part != k_no_node; part = tree[part].next) {
        const auto one = number_of(text, part);
        if (!one)
            return std::nullopt;
        all.push_back(*one);
    }
    return all;
}

/// Returns whether the node is iResolution or a part of it: the host draws nothing at size zero.
bool is_the_size(const ParsedText& text, NodeId id) {
    const SyntaxTree& tree = text.tree();
    while (tree[id].kind == NodeKind::member || tree[id].kind == NodeKind::parenthesis)
        id = tree.child(id, 0);
    return tree[id].kind == NodeKind::name && text.word_of(id) == "iResolution";
}

/// Returns whether the node is a `max` with a positive literal, such as `max(x, 0.01)`.
bool is_guarded(const ParsedText& text, NodeId id) {
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind != NodeKind::call || called_name(text, id) != "max")
        return false;
    const auto is_positive = [&](NodeId part) {
        const auto numbers = numbers_of(text, part);
        return numbers && std::ranges::all_of(*numbers, [](double v) { return v > 0; });
    };
    return is_positive(tree.child(id, 1)) || is_positive(tree.child(id, 2));
}

/// Returns whether the literals in the text keep the call inside its domain. An unknown argument is replaced
/// by numbers on every side of the domains' edges.
bool surely_defined(const ParsedText& text, NodeId call, const Domain& domain) {
    const SyntaxTree& tree = text.tree();
    std::vector<double> anything{-2, 0, 2};
    std::vector<double> known[3];
    NodeId argument = tree[tree.child(call, 0)].next;
    for (size_t i = 0; i < 3 && argument != k_no_node; ++i, argument = tree[argument].next) {
        known[i] = numbers_of(text, argument).value_or(std::vector<double>{});
        anything.insert(anything.end(), known[i].begin(), known[i].end());
    }
    const auto values = [&](size_t i) { return known[i].empty() ? anything : known[i]; };
    for (const double x : values(0))
        for (const double y : values(1))
            for (const double z : values(2))
                if (domain.broken({x, y, z}))
                    return false;
    return true;
}

/// Returns whether the literals in the text keep `a / b` defined; only 0 / 0 is undefined.
bool surely_defined(const ParsedText& text, NodeId quotient) {
    const NodeId below = text.tree().child(quotient, 1);
    const auto has_no_zero = [&](NodeId id) {
        const auto numbers = numbers_of(text, id);
        return numbers && std::ranges::find(*numbers, 0) == numbers->end();
    };
    return is_the_size(text, below) || is_guarded(text, below) || has_no_zero(below) ||
           has_no_zero(text.tree().child(quotient, 0));
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::ranges::find(words, word) != words.end();
}

/// Returns whether the node is a name, a literal, or a member or element of a name, so that evaluating it
/// twice has no side effect.
bool is_place(const ParsedText& text, NodeId id) {
    const SyntaxTree& tree = text.tree();
    switch (tree[id].kind) {
    case NodeKind::name:
    case NodeKind::literal: return true;
    case NodeKind::member:
    case NodeKind::parenthesis: return is_place(text, tree.child(id, 0));
    case NodeKind::index: return is_place(text, tree.child(id, 0)) && is_place(text, tree.child(id, 1));
    default: return false;
    }
}

class Finder {
public:
    Finder(const ParsedText& text, const TreeFacts& facts) : text_(text), tree_(text.tree()), facts_(facts) {}

    std::vector<DomainSite> run(DomainScope scope) {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            if (!is_expression(tree_[id].kind) || must_stay_constant(text_, id))
                continue;
            if (is_float_site(id))
                add(id, domain_name(text_, id) == k_quotient ? DomainKind::quotient : DomainKind::function);
            else if (scope == DomainScope::everything)
                look(id);
        }
        return std::move(found_);
    }

private:
    void add(NodeId id, DomainKind kind, bool to_unsigned = false) {
        found_.push_back({id, kind, to_unsigned});
    }

    /// Returns whether `id` is a call or a quotient that has a domain, as GLSL's own functions have.
    bool is_float_site(NodeId id) const {
        if (tree_[id].kind != NodeKind::call)
            return domain_name(text_, id) == k_quotient && is_float_operation(text_, facts_, id) &&
                   !surely_defined(text_, id);
        const std::string_view name = called_name(text_, id);
        const BuiltinFunction* const function = facts_.function(name) ? nullptr : find_builtin(name);
        return function && function->domain && tree_.child_count(id) == most_parameters(*function) + 1 &&
               !surely_defined(text_, id, *function->domain);
    }

    void look(NodeId id) {
        switch (tree_[id].kind) {
        case NodeKind::binary:
        case NodeKind::assign: return operation(id);
        case NodeKind::index: return index(id);
        case NodeKind::call: return call(id);
        default: return;
        }
    }

    void operation(NodeId id) {
        const std::string_view op = text_.word_of(id);
        const NodeId right = tree_.child(id, 1);
        const auto number = number_of(text_, right);
        if (is_one_of(op, {"<<", ">>", "<<=", ">>="})) {
            if (!number || *number < 0 || *number > 31)
                add(id, DomainKind::shift);
        } else if (is_one_of(op, {"%", "%="}) ||
                   (is_one_of(op, {"/", "/="}) && facts_.surely_whole[tree_.child(id, 0)] &&
                    facts_.surely_whole[right])) {
            if (!number || *number == 0)
                add(id, DomainKind::divisor);
        } else if (is_one_of(op, {"/", "/="}) && facts_.surely_whole[tree_.child(id, 0)] && !number) {
            add(id, DomainKind::quotient); // `7 / s.n`: the driver's overload resolution finds the type
        } else if (is_one_of(op, {"<", ">", "<=", ">="}) ||
                   (is_one_of(op, {"==", "!="}) && (number || number_of(text_, tree_.child(id, 0))))) {
            if (!counts(id))
                add(id, DomainKind::comparison);
        }
    }

    /// Returns whether the node is a whole-number comparison in the head of a `for`, such as `i < 10`.
    bool counts(NodeId id) const {
        return facts_.surely_whole[tree_.child(id, 0)] && tree_[tree_[id].parent].kind == NodeKind::loop_for;
    }

    void index(NodeId id) {
        const NodeId what = tree_.child(id, 0), which = tree_.child(id, 1);
        if (tree_[which].kind == NodeKind::absent || number_of(text_, which) || !is_place(text_, what) ||
            facts_.is_type(text_.word(tree_[what].begin))) // `float[n](…)`
            return;
        if (text_.is_es()) { // ES vectors have no length()
            const auto name = facts_.names.find(text_.word_of(what));
            if (tree_[what].kind != NodeKind::name || name == facts_.names.end() || !name->second.array)
                return;
        }
        add(id, DomainKind::index);
    }

    void call(NodeId id) {
        const std::string_view name = called_name(text_, id);
        if (name.empty() || facts_.function(name))
            return;
        if (name == "texelFetch" && tree_.child_count(id) == 4) {
            add(id, DomainKind::fetch);
        } else if (class_of_type(name) == TypeClass::whole && !name.starts_with("b")) {
            for (NodeId part = tree_[tree_.child(id, 0)].next; part != k_no_node; part = tree_[part].next)
                if (!facts_.surely_whole[part] && !number_of(text_, part))
                    add(part, DomainKind::conversion, name.starts_with("u"));
        }
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    std::vector<DomainSite> found_;
};

} // namespace

std::string_view domain_name(const ParsedText& text, NodeId id) {
    switch (text.tree()[id].kind) {
    case NodeKind::call: return called_name(text, id);
    case NodeKind::binary:
    case NodeKind::assign: return text.word_of(id).starts_with('/') ? k_quotient : std::string_view{};
    default: return {};
    }
}

std::vector<DomainSite> find_domain_sites(const ParsedText& text, const TreeFacts& facts, DomainScope scope) {
    return Finder(text, facts).run(scope);
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
