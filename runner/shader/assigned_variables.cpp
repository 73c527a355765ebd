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

/// Parts that a path has assigned, by index in the stack of live variables.
struct State {
    std::vector<Slots> set;
    bool reached = true;

    /// Returns the state of unreachable code; meeting it leaves the other state unchanged.
    static State nowhere(size_t depth) { return {std::vector<Slots>(depth, ~Slots(0)), false}; }

    void meet(const State& other) {
        const size_t size = std::min(set.size(), other.set.size());
        if (!reached && other.reached) {
            *this = other;
            set.resize(size);
        }
        for (size_t i = 0; i < size && other.reached; ++i)
            set[i] &= other.set[i];
    }
    /// Meets a state of deeper nesting, whose inner variables end here.
    void meet_inner(State inner) {
        inner.set.resize(set.size());
        meet(inner);
    }
};

/// Effect of a call on global variables, by their index.
struct Summary {
    std::vector<Slots> reads;   ///< read before the function assigns them
    std::vector<NodeId> places; ///< first such read of each
    std::vector<Slots> assigns; ///< on every path
};

/// Follows the paths through a text.
class Follower {
public:
    Follower(const ParsedText& text, const TreeFacts& facts, Shapes& shapes)
        : text_(text), tree_(text.tree()), facts_(facts), shapes_(shapes),
          reached_(functions_of_main(text, facts)) {}

    Assignment run() {
        for (NodeId part = tree_[0].first_child; part != k_no_node; part = tree_[part].next)
            if (tree_[part].kind == NodeKind::declaration)
                global(part);
        size_t functions = 0;
        for (const auto& [name, overloads] : facts_.functions)
            functions += overloads.definitions.size();
        if (here_.live.size() * functions > k_most_followed)
            doubt_globals();
        globals_ = here_.live.size();
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
    struct Scope {
        size_t depth = 0; ///< live variables outside of it
        std::unordered_map<std::string_view, size_t> places;
    };
    struct Loop {
        State breaks;
        State continues;
        bool is_switch = false;
    };
    /// Everything that is known inside one function.
    struct Inside {
        std::vector<size_t> live{}; ///< indices of the variables that are visible here, globals first
        std::vector<Scope> scopes{};
        State state{};
        Summary summary{};
        std::vector<Loop> loops{};
        State exits{};         ///< merged state of all returns so far
        size_t parameters = 0; ///< first parameter in live
        bool returns = false;  ///< the function has a return statement
    };
    /// Returns the start of a function, where only globals are visible.
    Inside entered() const {
        Inside inside{.state = {std::vector<Slots>(globals_), true},
                      .summary = empty_summary(),
                      .parameters = globals_};
        for (size_t i = 0; i < globals_; ++i)
            inside.live.push_back(i);
        return inside;
    }
    /// Returns the summary of a function that reads and assigns nothing.
    Summary empty_summary() const {
        return {std::vector<Slots>(globals_), std::vector<NodeId>(globals_, k_no_node),
                std::vector<Slots>(globals_)};
    }
    State nowhere() const { return State::nowhere(here_.live.size()); }

    static constexpr size_t k_untracked = size_t(-1);

    /// Declares a variable. Only those that are `unset` (declared without a value) are tracked.
    void declare(NodeId type, NodeId declared, bool unset) {
        size_t place = k_untracked;
        const Shape* const shape = unset ? &shapes_.of(type, declared) : nullptr;
        if (shape && shape->can_be_zero()) {
            place = here_.live.size();
            here_.live.push_back(variables_.size());
            variables_.push_back({.type = type, .declared = declared, .shape = shape, .runs = runs_});
            here_.state.set.push_back(here_.state.reached ? 0 : ~Slots(0));
        }
        (here_.scopes.empty() ? outermost_ : here_.scopes.back()).places[text_.word_of(declared)] = place;
    }
    bool has_value(NodeId declared) const {
        const auto parts = tree_.children(declared);
        return std::ranges::any_of(parts, [&](NodeId part) { return !is_bracket(text_, part); });
    }

    struct Found {
        size_t place = k_untracked;
        Part part;
    };
    Found find(NodeId id) {
        const NodeId base = base_of(tree_, id);
        Found found;
        if (tree_[base].kind == NodeKind::name)
            found.place = place_of(text_.word_of(base));
        if (found.place != k_untracked)
            found.part = shapes_.part_of(*variable(found.place).shape, id);
        return found;
    }
    size_t place_of(std::string_view name) const {
        for (auto scope = here_.scopes.rbegin(); scope != here_.scopes.rend(); ++scope)
            if (const auto found = scope->places.find(name); found != scope->places.end())
                return found->second;
        const auto found = outermost_.places.find(name);
        return found == outermost_.places.end() ? k_untracked : found->second;
    }
    UnsetVariable& variable(size_t place) { return variables_[here_.live[place]]; }

    void read(NodeId id) {
        const Found found = find(id);
        if (found.place != k_untracked)
            need(found.place, found.part.slots, id);
    }
    /// Records a read of some `slots` of the variable at `place`.
    void need(size_t place, Slots slots, NodeId at) {
        const Slots missing = slots & ~here_.state.set[place];
        if (!here_.state.reached || missing == 0)
            return;
        if (place < globals_)
            here_.summary.reads[place] |= missing;
        NodeId& first = place < globals_ ? here_.summary.places[place] : variable(place).read;
        first = first == k_no_node ? at : first;
    }
    /// Records a write; `doubtful` if it may not happen.
    void write(NodeId id, bool doubtful = false) {
        const Found found = find(id);
        if (found.place == k_untracked)
            return;
        variable(found.place).written = true;
        if (doubtful)
            variable(found.place).doubtful = true;
        else if (found.part.exact)
            here_.state.set[found.place] |= found.part.slots;
    }

    void open() { here_.scopes.push_back({here_.live.size(), {}}); }
    void close() {
        here_.live.resize(here_.scopes.back().depth);
        here_.state.set.resize(here_.scopes.back().depth);
        here_.scopes.pop_back();
    }

    bool is_definition(NodeId id) const {
        return tree_[id].kind == NodeKind::function && text_.word(tree_[id].end - 1) == "}";
    }

    /// Marks all globals as possibly read before they have a value.
    void doubt_globals() {
        for (UnsetVariable& variable : variables_) {
            variable.read = variable.declared;
            variable.doubtful = true;
        }
        outermost_.places.clear(); // follows none of them
        here_ = {};
    }

    void global(NodeId id) {
        const NodeId type = tree_.child(id, 0);
        for (NodeId part = tree_[type].next; part != k_no_node; part = tree_[part].next) {
            const size_t before = here_.live.size();
            declare(type, part, !is_given(text_, type) && !has_value(part));
            if (here_.live.size() > before)
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
        Inside outer = std::exchange(here_, entered());
        ++calls_;
        follow(function);
        --calls_;
        here_.exits.set.resize(globals_);
        here_.summary.assigns = here_.exits.set;
        Summary& summary = summaries_[function] = std::move(here_.summary);
        here_ = std::move(outer);
        return summary;
    }

    void follow(NodeId function) {
        open();
        const bool outer_runs = std::exchange(runs_, whole_ || reached_.contains(text_.word_of(function)));
        NodeId body = k_no_node;
        for (NodeId part = tree_[function].first_child; part != k_no_node; part = tree_[part].next) {
            if (tree_[part].kind == NodeKind::parameter) {
                const NodeId type = tree_.child(part, 0);
                const size_t before = here_.live.size();
                const bool named = tree_[part].word >= tree_[type].end;
                declare(type, part, named && has_qualifier(text_, type, "out"));
                if (here_.live.size() > before)
                    variables_.back().parameter = true;
            } else if (tree_[part].kind == NodeKind::block) {
                body = part;
            }
        }
        here_.exits = nowhere();
        walk(body);
        const bool falls = here_.state.reached;
        exit(body);
        if (falls && runs_ && here_.returns && type_name(text_, tree_.child(function, 0)) != "void")
            result_.without_return.push_back(function);
        runs_ = outer_runs;
        close();
    }

    /// Leaves the function: records `out` parameters without a value, and merges the state into the exits.
    void exit(NodeId at) {
        if (!here_.state.reached)
            return;
        for (size_t place = here_.parameters; place < here_.exits.set.size(); ++place) {
            UnsetVariable& parameter = variable(place);
            if ((all_slots(parameter.shape->slots) & ~here_.state.set[place]) != 0 &&
                parameter.left == k_no_node)
                parameter.left = at;
        }
        here_.exits.meet_inner(here_.state);
        here_.state = nowhere();
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
            here_.state.set[i] |= all.assigns[i];
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
        State before = here_.state;
        scoped(yes);
        std::swap(before, here_.state);
        scoped(no);
        here_.state.meet(before);
    }

    void choose(NodeId id) {
        walk(tree_.child(id, 0));
        branch(tree_.child(id, 1), tree_.child(id, 2));
    }

    void body_of_loop(NodeId body) {
        here_.loops.push_back({nowhere(), nowhere(), false});
        scoped(body);
        here_.state.meet(here_.loops.back().continues);
    }

    /// Sets the state after a loop: merges all breaks with `out`, the state in which the condition was false.
    void leave_loop(const State& out) {
        State behind = here_.loops.back().breaks;
        behind.meet(out);
        here_.loops.pop_back();
        here_.state = std::move(behind);
    }

    void loop_for(NodeId id) {
        open();
        walk(tree_.child(id, 0));
        const NodeId condition = tree_.child(id, 1);
        const bool endless = is_always_true(text_, condition);
        const bool entered = endless || enters_surely(text_, shapes_, id);
        walk(condition);
        State skipped = entered ? nowhere() : here_.state;
        body_of_loop(tree_.child(id, 3));
        walk(tree_.child(id, 2));
        walk(condition);
        if (!endless)
            skipped.meet(here_.state);
        leave_loop(skipped);
        for (const NodeId filled : filled_arrays(text_, facts_, id))
            if (const Found found = find(filled);
                found.place != k_untracked && found.part.exact && found.part.shape &&
                fills(text_, shapes_, id, variable(found.place).declared, *found.part.shape, filled))
                here_.state.set[found.place] |= found.part.slots;
        close();
    }

    void loop_while(NodeId id) {
        open();
        const NodeId condition = tree_.child(id, 0);
        walk(condition);
        const State skipped = is_always_true(text_, condition) ? nowhere() : here_.state;
        body_of_loop(tree_.child(id, 1));
        leave_loop(skipped); // later iterations have assigned no less
        close();
    }

    void loop_do(NodeId id) {
        body_of_loop(tree_.child(id, 0));
        const NodeId condition = tree_.child(id, 1);
        walk(condition);
        const State out = is_always_true(text_, condition) ? nowhere() : here_.state;
        leave_loop(out);
    }

    /// Merges at each label the state after the selector with the state at the end of the preceding
    /// statement.
    void switch_on(NodeId id) {
        walk(tree_.child(id, 0));
        State chosen = here_.state;
        bool has_default = false;
        here_.loops.push_back({nowhere(), nowhere(), true});
        open();
        here_.state = nowhere();
        const NodeId block = tree_.child(id, 1);
        for (NodeId part = tree_[block].first_child; part != k_no_node; part = tree_[part].next) {
            if (tree_[part].kind == NodeKind::label) {
                State entry = chosen; // a jump over a declaration leaves its variable without a value
                entry.set.resize(here_.live.size(), 0);
                here_.state.meet(entry);
                has_default = has_default || text_.word_of(part) == "default";
            }
            walk(part);
        }
        close();
        State behind = here_.loops.back().breaks;
        here_.loops.pop_back();
        behind.meet(here_.state);
        if (!has_default)
            behind.meet(chosen);
        here_.state = std::move(behind);
    }

    void jump(NodeId id) {
        const std::string_view word = text_.word_of(id);
        for (auto loop = here_.loops.rbegin(); word != "discard" && loop != here_.loops.rend(); ++loop) {
            if (word == "continue" && loop->is_switch)
                continue;
            (word == "break" ? loop->breaks : loop->continues).meet_inner(here_.state);
            break;
        }
        here_.state = nowhere();
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
            here_.returns = true;
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
        here_ = entered();
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
            variables_[i].read = here_.summary.places[i];
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    Shapes& shapes_;
    std::unordered_set<std::string_view> reached_; ///< functions that main calls, directly or indirectly
    bool whole_ = false;                           ///< the text has no main
    bool runs_ = true;                             ///< the current function is reached from main
    std::vector<UnsetVariable> variables_{};
    size_t globals_ = 0; ///< tracked ones
    Scope outermost_{};
    Inside here_{};
    int calls_ = 0; ///< current call depth
    std::unordered_map<NodeId, Summary> summaries_{};
    Summary unfollowed_{};
    Assignment result_{};
};

} // namespace

Assignment find_assignment(const ParsedText& text, const TreeFacts& facts, Shapes& shapes) {
    return Follower(text, facts, shapes).run();
}

} // namespace tidemark::glsl
