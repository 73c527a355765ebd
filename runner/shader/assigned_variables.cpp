#include "shader/builtin_functions.hpp"
#include "shader/loops.hpp"
#include "shader/variables.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace tidemark::glsl {
namespace {

/// Maximum nesting of calls of functions that are defined later in the text.
constexpr int k_deepest_call = 16;
/// Limit for the number of global variables times the number of functions; real texts stay far below.
constexpr size_t k_most_followed = 2'000'000;

class Follower : private VariableStates {
public:
    Follower(const ParsedText& text, const TreeFacts& facts, Shapes& shapes)
        : VariableStates(text, shapes), facts_(facts), reached_(functions_of_main(text, facts)) {}

    Assignment run() {
        for (NodeId part = tree_[0].first_child; part != k_no_node; part = tree_[part].next)
            if (tree_[part].kind == NodeKind::declaration)
                global(part);
        size_t functions = 0;
        for (const auto& [name, overloads] : facts_.functions)
            functions += overloads.definitions.size();
        if (live_.size() * functions > k_most_followed)
            doubt_globals();
        globals_ = live_.size();
        const FunctionFacts* const main = facts_.function("main");
        whole_ = !main || main->definitions.empty();
        // last: main often precedes the functions that it calls, which would make the call depth large
        for (const bool last : {false, true})
            for (NodeId part = tree_[0].first_child; part != k_no_node; part = tree_[part].next)
                if (is_definition(part) && (text_.word_of(part) == "main") == last)
                    summarise(part);
        from_the_start();
        result_.variables = std::move(variables_);
        std::ranges::sort(result_.variables, {}, &UnsetVariable::declared);
        std::ranges::sort(result_.without_return);
        return std::move(result_);
    }

private:
    struct Loop {
        State breaks;
        State continues;
        bool is_switch = false;
    };
    bool is_definition(NodeId id) const {
        return tree_[id].kind == NodeKind::function && text_.word(tree_[id].end - 1) == "}";
    }

    /// Marks all globals as possibly read before they have a value.
    void doubt_globals() {
        for (UnsetVariable& variable : variables_) {
            variable.read = variable.declared;
            variable.doubtful = true;
        }
        forget();
    }

    void global(NodeId id) {
        const NodeId type = tree_.child(id, 0);
        for (NodeId part = tree_[type].next; part != k_no_node; part = tree_[part].next) {
            const size_t before = live_.size();
            declare(type, part, !is_given(text_, type) && !has_value(part));
            if (live_.size() > before)
                variables_.back().global = true;
        }
    }

    void declaration(NodeId id) {
        const NodeId type = tree_.child(id, 0);
        for (NodeId part = tree_[type].next; part != k_no_node; part = tree_[part].next) {
            for (const NodeId inside : tree_.children(part))
                walk(inside);
            declare(type, part, !is_given(text_, type) && !has_value(part));
        }
    }

    const Summary& summarise(NodeId function) {
        if (const auto known = summaries_.find(function); known != summaries_.end())
            return known->second; // empty for a function that is being summarised: GLSL has no recursion
        if (calls_ >= k_deepest_call) {
            unfollowed_ = empty_summary();
            std::ranges::fill(unfollowed_.reads, ~Slots(0));
            std::ranges::fill(unfollowed_.places, function);
            return unfollowed_;
        }
        summaries_.emplace(function, empty_summary());
        Sight outer = enter();
        const auto [loops, exits] = std::pair(std::move(loops_), std::move(exits_));
        const auto [parameters, returns] = std::pair(parameters_, returns_);
        loops_.clear();
        parameters_ = globals_;
        returns_ = false;
        ++calls_;
        follow(function);
        --calls_;
        exits_.set.resize(globals_);
        summary_.assigns = exits_.set;
        Summary& summary = summaries_[function] = std::move(summary_);
        leave(std::move(outer));
        loops_ = loops;
        exits_ = exits;
        parameters_ = parameters;
        returns_ = returns;
        return summary;
    }

    void follow(NodeId function) {
        open();
        const bool outer_runs = std::exchange(runs_, whole_ || reached_.contains(text_.word_of(function)));
        NodeId body = k_no_node;
        for (NodeId part = tree_[function].first_child; part != k_no_node; part = tree_[part].next) {
            if (tree_[part].kind == NodeKind::parameter) {
                const NodeId type = tree_.child(part, 0);
                const size_t before = live_.size();
                const bool named = tree_[part].word >= tree_[type].end;
                declare(type, part, named && has_qualifier(text_, type, "out"));
                if (live_.size() > before)
                    variables_.back().parameter = true;
            } else if (tree_[part].kind == NodeKind::block) {
                body = part;
            }
        }
        exits_ = nowhere(live_.size());
        walk(body);
        const bool falls = state_.reached;
        exit(body);
        if (falls && runs_ && returns_ && type_name(text_, tree_.child(function, 0)) != "void")
            result_.without_return.push_back(function);
        runs_ = outer_runs;
        close();
    }

    /// Leaves the function: records `out` parameters without a value, and merges the state into exits_.
    void exit(NodeId at) {
        if (!state_.reached)
            return;
        for (size_t place = parameters_; place < exits_.set.size(); ++place) {
            UnsetVariable& parameter = variable(place);
            if ((all_slots(parameter.shape->slots) & ~state_.set[place]) != 0 && parameter.left == k_no_node)
                parameter.left = at;
        }
        State here = state_;
        here.set.resize(exits_.set.size());
        exits_.meet(here);
        state_ = nowhere(state_.set.size());
    }

    /// Applies a call. Any overload with that many parameters may be the callee, so their summaries are
    /// merged.
    void call_own(const FunctionFacts& own, size_t arguments) {
        Summary all;
        bool first = true;
        for (const NodeId definition : own.definitions) {
            if (parameter_count(definition) != arguments)
                continue;
            const Summary& one = summarise(definition);
            if (first)
                all = one;
            for (size_t i = 0; i < globals_ && !first; ++i) {
                all.reads[i] |= one.reads[i];
                all.places[i] = all.places[i] == k_no_node ? one.places[i] : all.places[i];
                all.assigns[i] &= one.assigns[i];
            }
            first = false;
        }
        for (size_t i = 0; i < globals_ && !first; ++i) {
            if (all.reads[i] != 0)
                need(i, all.reads[i], all.places[i]);
            state_.set[i] |= all.assigns[i];
        }
    }

    size_t parameter_count(NodeId function) const {
        size_t count = 0;
        for (const NodeId part : tree_.children(function))
            count += tree_[part].kind == NodeKind::parameter;
        return count;
    }

    enum class Way { in, out, both, doubtful };
    /// Returns the direction of argument `index` of a call.
    Way way_of(std::string_view name, size_t index, size_t arguments) const {
        const FunctionFacts* own = facts_.function(name);
        if (!own || own->definitions.empty())
            return !facts_.writes_argument(name, index) ? Way::in : own ? Way::doubtful : Way::out;
        bool reads = false;
        bool writes = false;
        bool spares = false;
        for (const NodeId definition : own->definitions) {
            if (parameter_count(definition) != arguments)
                continue;
            const NodeId type = tree_.child(tree_.child(definition, index + 1), 0);
            const bool both = has_qualifier(text_, type, "inout");
            const bool out = both || has_qualifier(text_, type, "out");
            reads = reads || both || !out;
            writes = writes || out;
            spares = spares || !out;
        }
        return !writes ? Way::in : spares ? Way::doubtful : reads ? Way::both : Way::out;
    }

    void call(NodeId id) {
        const NodeId callee = tree_.child(id, 0);
        if (tree_[callee].kind == NodeKind::member)
            return indices(callee); // .length()
        const std::string_view name = called_name(text_, id);
        const size_t arguments = tree_.child_count(id) - 1;
        std::vector<std::pair<NodeId, bool>> written;
        size_t index = 0;
        for (NodeId part = tree_[callee].next; part != k_no_node; part = tree_[part].next, ++index) {
            const Way way = name.empty() ? Way::in : way_of(name, index, arguments);
            if (way == Way::out)
                indices(part);
            else
                walk(part);
            if (way != Way::in)
                written.emplace_back(part, way == Way::doubtful);
        }
        if (const FunctionFacts* own = facts_.function(name); own && globals_ > 0)
            call_own(*own, arguments);
        for (const auto& [part, doubtful] : written)
            write(part, doubtful);
    }

    void each(NodeId id) {
        for (NodeId child = tree_[id].first_child; child != k_no_node; child = tree_[child].next)
            walk(child);
    }

    /// Walks the index expressions of a place: they are read even if the place is only written.
    void indices(NodeId place) {
        switch (tree_[place].kind) {
        case NodeKind::index:
            indices(tree_.child(place, 0));
            walk(tree_.child(place, 1));
            break;
        case NodeKind::member:
        case NodeKind::parenthesis: indices(tree_.child(place, 0)); break;
        case NodeKind::name: break;
        default: walk(place);
        }
    }

    void assign(NodeId id) {
        const NodeId target = tree_.child(id, 0);
        walk(tree_.child(id, 1));
        if (text_.word_of(id) == "=")
            indices(target);
        else
            walk(target);
        write(target);
    }

    void place(NodeId id) {
        const NodeId base = base_of(tree_, id);
        indices(id);
        if (tree_[base].kind == NodeKind::name)
            read(id);
    }

    void scoped(NodeId id) {
        open();
        walk(id);
        close();
    }

    /// Walks two alternatives, one of which runs; `no` may be k_no_node.
    void branch(NodeId yes, NodeId no) {
        State before = state_;
        scoped(yes);
        std::swap(before, state_);
        scoped(no);
        state_.meet(before);
    }

    void choose(NodeId id) {
        walk(tree_.child(id, 0));
        branch(tree_.child(id, 1), tree_.child(id, 2));
    }

    void body_of_loop(NodeId body) {
        loops_.push_back({nowhere(live_.size()), nowhere(live_.size()), false});
        scoped(body);
        state_.meet(loops_.back().continues);
    }

    /// Sets the state after a loop: merges all breaks with `out`, the state in which the condition was false.
    void leave_loop(const State& out) {
        State behind = loops_.back().breaks;
        behind.meet(out);
        loops_.pop_back();
        state_ = std::move(behind);
    }

    void loop_for(NodeId id) {
        open();
        walk(tree_.child(id, 0));
        const NodeId condition = tree_.child(id, 1);
        const bool endless = is_always_true(text_, condition);
        const bool entered = endless || enters_surely(text_, shapes_, id);
        walk(condition);
        State skipped = entered ? nowhere(live_.size()) : state_;
        body_of_loop(tree_.child(id, 3));
        walk(tree_.child(id, 2));
        walk(condition);
        if (!endless)
            skipped.meet(state_);
        leave_loop(skipped);
        for (const NodeId filled : filled_arrays(text_, facts_, id))
            if (const Found found = find(filled);
                found.place != k_untracked && found.part.exact && found.part.shape &&
                fills(text_, shapes_, id, variable(found.place).declared, *found.part.shape, filled))
                state_.set[found.place] |= found.part.slots;
        close();
    }

    void loop_while(NodeId id) {
        open();
        const NodeId condition = tree_.child(id, 0);
        walk(condition);
        const State skipped = is_always_true(text_, condition) ? nowhere(live_.size()) : state_;
        body_of_loop(tree_.child(id, 1));
        leave_loop(skipped); // later iterations have assigned no less
        close();
    }

    void loop_do(NodeId id) {
        body_of_loop(tree_.child(id, 0));
        const NodeId condition = tree_.child(id, 1);
        walk(condition);
        const State out = is_always_true(text_, condition) ? nowhere(live_.size()) : state_;
        leave_loop(out);
    }

    /// Merges at each label the state after the selector with the state at the end of the preceding
    /// statement.
    void switch_on(NodeId id) {
        walk(tree_.child(id, 0));
        State chosen = state_;
        bool has_default = false;
        loops_.push_back({nowhere(live_.size()), nowhere(live_.size()), true});
        open();
        state_ = nowhere(live_.size());
        const NodeId block = tree_.child(id, 1);
        for (NodeId part = tree_[block].first_child; part != k_no_node; part = tree_[part].next) {
            if (tree_[part].kind == NodeKind::label) {
                State entry = chosen; // a jump over a declaration leaves its variable without a value
                entry.set.resize(live_.size(), 0);
                state_.meet(entry);
                has_default = has_default || text_.word_of(part) == "default";
            }
            walk(part);
        }
        close();
        State behind = loops_.back().breaks;
        loops_.pop_back();
        behind.meet(state_);
        if (!has_default)
            behind.meet(chosen);
        state_ = std::move(behind);
    }

    void jump(NodeId id) {
        const std::string_view word = text_.word_of(id);
        if (word == "discard") {
            state_ = nowhere(state_.set.size());
            return;
        }
        for (auto loop = loops_.rbegin(); loop != loops_.rend(); ++loop) {
            if (word == "continue" && loop->is_switch)
                continue;
            State& to = word == "break" ? loop->breaks : loop->continues;
            State here = state_;
            here.set.resize(to.set.size());
            to.meet(here);
            break;
        }
        state_ = nowhere(state_.set.size());
    }

    void walk(NodeId id) {
        if (id == k_no_node)
            return;
        switch (tree_[id].kind) {
        case NodeKind::name:
        case NodeKind::member:
        case NodeKind::index: return place(id);
        case NodeKind::assign: return assign(id);
        case NodeKind::call: return call(id);
        case NodeKind::declaration: return declaration(id);
        case NodeKind::loop_for: return loop_for(id);
        case NodeKind::loop_while: return loop_while(id);
        case NodeKind::loop_do: return loop_do(id);
        case NodeKind::switch_on: return switch_on(id);
        case NodeKind::if_else:
        case NodeKind::conditional: return choose(id);
        case NodeKind::jump: return jump(id);
        case NodeKind::type:
        case NodeKind::structure:
        case NodeKind::other: return;
        case NodeKind::block:
            open();
            each(id);
            return close();
        case NodeKind::return_statement:
            each(id);
            returns_ = true;
            return exit(id);
        case NodeKind::binary:
            walk(tree_.child(id, 0));
            if (text_.word_of(id) == "&&" || text_.word_of(id) == "||")
                return branch(tree_.child(id, 1), k_no_node);
            return walk(tree_.child(id, 1));
        case NodeKind::prefix:
        case NodeKind::postfix:
            each(id);
            if (is_change(text_, id))
                write(tree_.child(id, 0));
            return;
        default: return each(id);
        }
    }

    /// Evaluates globals as `main` finds them: their initialisers run first.
    void from_the_start() {
        enter();
        for (NodeId part = tree_[0].first_child; part != k_no_node; part = tree_[part].next)
            if (tree_[part].kind == NodeKind::declaration)
                for (const NodeId declared : tree_.children(part))
                    if (tree_[declared].kind == NodeKind::declarator)
                        each(declared);
        if (!whole_)
            call_own(*facts_.function("main"), 0);
        else
            for (const auto& [function, summary] : summaries_)
                for (size_t i = 0; i < globals_; ++i)
                    if (summary.reads[i] != 0)
                        need(i, summary.reads[i], summary.places[i]);
        for (size_t i = 0; i < globals_; ++i)
            variables_[i].read = summary_.places[i];
    }

    const TreeFacts& facts_;
    std::unordered_set<std::string_view> reached_; ///< functions that main calls, directly or indirectly
    bool whole_ = false;                           ///< the text has no main
    std::vector<Loop> loops_;
    State exits_;           ///< merged state of all returns so far
    size_t parameters_ = 0; ///< first parameter in live_
    bool returns_ = false;  ///< the function has a return statement
    int calls_ = 0;         ///< current call depth
    std::unordered_map<NodeId, Summary> summaries_;
    Summary unfollowed_;
    Assignment result_;
};

} // namespace

Assignment find_assignment(const ParsedText& text, const TreeFacts& facts, Shapes& shapes) {
    return Follower(text, facts, shapes).run();
}

} // namespace tidemark::glsl
