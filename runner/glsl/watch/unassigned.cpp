#include "glsl/watch/unassigned.hpp"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace tidemark::glsl {
namespace {

struct Event {
    NodeId at;
    size_t order; ///< of evaluation, but for loops that begin anew
    bool writes;
};

struct Variable {
    NodeId declared;
    bool begins_without = false; ///< a value; and can be written to
    bool parameter = false;
    bool global = false;
    std::vector<Event> events{};
};

/// Walks the text as it is evaluated and notes who reads and writes what.
class Walker {
public:
    Walker(const ParsedText& text, const TreeFacts& facts)
        : text_(text), tree_(text.tree()), facts_(facts), reached_(functions_of_main(text, facts)) {}

    std::vector<Variable> run() {
        scopes_.emplace_back();
        for (NodeId part = tree_[0].first_child; part != k_no_node; part = tree_[part].next)
            if (tree_[part].kind == NodeKind::function)
                function(part);
            else
                walk(part);
        return std::move(variables_);
    }

private:
    void each(NodeId id) {
        for (NodeId child = tree_[id].first_child; child != k_no_node; child = tree_[child].next)
            walk(child);
    }

    void scoped(NodeId id) {
        scopes_.emplace_back();
        each(id);
        scopes_.pop_back();
    }

    void function(NodeId id) {
        if (text_.word(tree_[id].end - 1) != "}" || !reached_.contains(text_.word_of(id)))
            return;
        scopes_.emplace_back();
        for (NodeId part = tree_[id].first_child; part != k_no_node; part = tree_[part].next) {
            if (tree_[part].kind == NodeKind::parameter) {
                const NodeId type = tree_.child(part, 0);
                declare(type, part);
                variables_.back().begins_without = has_qualifier(text_, type, "out");
                variables_.back().parameter = true;
            } else if (tree_[part].kind == NodeKind::block) {
                walk(part);
            }
        }
        scopes_.pop_back();
    }

    void declare(NodeId type, NodeId declared) {
        scopes_.back()[text_.word_of(declared)] = variables_.size();
        Variable& variable = variables_.emplace_back();
        variable.declared = declared;
        variable.global = scopes_.size() == 1;
        const TypeClass kind = class_of_type(type_name(text_, type));
        variable.begins_without =
            kind != TypeClass::sampler && kind != TypeClass::nothing && !is_given(text_, type);
    }

    void declaration(NodeId id) {
        const NodeId type = tree_.child(id, 0);
        for (NodeId part = tree_[type].next; part != k_no_node; part = tree_[part].next) {
            each(part);
            declare(type, part);
            for (const NodeId inside : tree_.children(part))
                if (!is_bracket(text_, inside))
                    variables_.back().begins_without = false;
        }
    }

    void loop_for(NodeId id) {
        scopes_.emplace_back();
        for (const size_t part : {0, 1, 3, 2}) // the step comes behind the body
            walk(tree_.child(id, part));
        scopes_.pop_back();
    }

    void call(NodeId id) {
        const NodeId callee = tree_.child(id, 0);
        const std::string_view name = called_name(text_, id);
        if (tree_[callee].kind == NodeKind::member)
            return; // .length()
        std::vector<NodeId> written;
        size_t index = 0;
        for (NodeId part = tree_[callee].next; part != k_no_node; part = tree_[part].next, ++index)
            if (!name.empty() && facts_.writes_argument(name, index)) {
                written.push_back(part);
                indices(part);
            } else {
                walk(part);
            }
        // `inout` reads, too: but overloads are told apart by no one here, so that it is not held against it.
        for (const NodeId part : written)
            note(part, true);
    }

    void assign(NodeId id) {
        const NodeId target = tree_.child(id, 0);
        walk(tree_.child(id, 1));
        if (text_.word_of(id) == "=")
            indices(target);
        else
            walk(target);
        note(target, true);
    }

    /// What a place is found by is read, whatever becomes of the place.
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

    void note(NodeId place, bool writes) {
        place = base_of(tree_, place);
        if (tree_[place].kind != NodeKind::name)
            return;
        for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope)
            if (const auto found = scope->find(text_.word_of(place)); found != scope->end()) {
                variables_[found->second].events.push_back({place, order_++, writes});
                return;
            }
    }

    void walk(NodeId id) {
        if (id == k_no_node)
            return;
        switch (tree_[id].kind) {
        case NodeKind::name: return note(id, false);
        case NodeKind::assign: return assign(id);
        case NodeKind::call: return call(id);
        case NodeKind::declaration: return declaration(id);
        case NodeKind::loop_for: return loop_for(id);
        case NodeKind::block:
        case NodeKind::loop_while: return scoped(id);
        case NodeKind::type:
        case NodeKind::structure:
        case NodeKind::other: return;
        case NodeKind::prefix:
        case NodeKind::postfix:
            each(id);
            if (text_.word_of(id) == "++" || text_.word_of(id) == "--")
                note(tree_.child(id, 0), true);
            return;
        default: return each(id);
        }
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    std::unordered_set<std::string_view> reached_;
    std::vector<std::unordered_map<std::string_view, size_t>> scopes_;
    std::vector<Variable> variables_;
    size_t order_ = 0;
};

/// Whether whoever enters `loop` comes to `id` before the first iteration ends, or leaves the loop for good.
bool is_certain(const ParsedText& text, NodeId id, NodeId loop) {
    const SyntaxTree& tree = text.tree();
    for (size_t i = tree[loop].begin; i < tree[loop].end; ++i)
        if (text.word(i) == "continue")
            return false;
    for (NodeId below = id, node = tree[id].parent; below != loop; below = node, node = tree[node].parent) {
        const bool first = below == tree.child(node, 0);
        const std::string_view word = text.word_of(node);
        switch (tree[node].kind) {
        case NodeKind::if_else:
        case NodeKind::conditional:
        case NodeKind::switch_on:
        case NodeKind::loop_while:
            if (!first && node != loop)
                return false;
            break;
        case NodeKind::loop_for:
            if (node != loop && !first && below != tree.child(node, 1))
                return false;
            break;
        case NodeKind::binary:
            if (!first && (word == "&&" || word == "||"))
                return false;
            break;
        default: break;
        }
    }
    return true;
}

/// Whether some way leads from the write to the read.
bool may_reach(const ParsedText& text, const Variable& variable, const Event& write, const Event& read) {
    const SyntaxTree& tree = text.tree();
    NodeId both = write.at;
    NodeId branch = both; // of the node that holds both, on the write's side
    while (!tree.is_within(read.at, both)) {
        branch = both;
        both = tree[both].parent;
    }
    for (NodeId around = both; around != k_no_node && !tree.is_within(variable.declared, around);
         around = tree[around].parent)
        if (is_loop(tree[around].kind)) // one iteration may write what a later one reads
            return write.order < read.order || !is_certain(text, read.at, around);
    if (write.order > read.order)
        return false;
    const bool chooses = tree[both].kind == NodeKind::if_else || tree[both].kind == NodeKind::conditional;
    const NodeId condition = tree.child(both, 0);
    return !chooses || branch == condition || tree.is_within(read.at, condition);
}

} // namespace

std::vector<Unassigned> find_unassigned(const ParsedText& text, const TreeFacts& facts) {
    std::vector<Unassigned> found;
    for (const Variable& variable : Walker(text, facts).run()) {
        if (!variable.begins_without)
            continue;
        const auto writes = [](const Event& event) { return event.writes; };
        if (variable.global && std::ranges::any_of(variable.events, writes))
            continue; // in which order functions run is not followed
        const auto unset = std::ranges::find_if(variable.events, [&](const Event& read) {
            return !read.writes && std::ranges::none_of(variable.events, [&](const Event& write) {
                return write.writes && may_reach(text, variable, write, read);
            });
        });
        if (unset != variable.events.end())
            found.push_back({variable.declared, unset->at});
        else if (variable.parameter && std::ranges::none_of(variable.events, writes))
            found.push_back({variable.declared, k_no_node});
    }
    return found;
}

} // namespace tidemark::glsl
