#include "glsl/cut/work_estimate.hpp"

#include "glsl/flow/loop_bound.hpp"
#include "glsl/syntax/builtin_functions.hpp"

#include <algorithm>
#include <functional>

namespace tidemark::glsl {
namespace {

constexpr double k_unknown_turns = 16, k_texture = 8, k_costly = 4;
/// Upper limit of an estimate; recursion or nested loops would make it infinite.
constexpr double k_most = 1e12;

double turns_of(const ParsedText& text, NodeId loop) {
    const auto bound = loop_bound(text, loop);
    return bound && bound->number != k_no_node ? std::max(1.0, bound->turns) : k_unknown_turns;
}

bool calls_function(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    return text.tree()[id].kind == NodeKind::call && facts.function(called_name(text, id));
}

} // namespace

WorkEstimate::WorkEstimate(const ParsedText& text, const TreeFacts& facts)
    : text_(text), tree_(text.tree()), facts_(facts), once_(tree_.nodes.size()), times_(tree_.nodes.size()) {
    add_up();
    add_up(); // functions called before their definition are known now
    count_times();
}

double WorkEstimate::own(NodeId id) const {
    switch (tree_[id].kind) {
    case NodeKind::prefix:
    case NodeKind::postfix:
    case NodeKind::binary:
    case NodeKind::assign:
    case NodeKind::conditional: return 1;
    case NodeKind::call: {
        const std::string_view name = called_name(text_, id);
        const auto known = functions_.find(name);
        if (known != functions_.end())
            return known->second;
        const BuiltinFunction* const function = find_builtin(name);
        if (!function)
            return 0;
        return name.starts_with("tex") ? k_texture : function->is(Trait::costly) ? k_costly : 1;
    }
    default: return 0;
    }
}

/// Sums bottom-up: children come before their parents.
void WorkEstimate::add_up() {
    for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
        double sum = own(id);
        for (NodeId child = tree_[id].first_child; child != k_no_node; child = tree_[child].next)
            sum += once_[child];
        once_[id] = std::min(k_most, is_loop(tree_[id].kind) ? sum * turns_of(text_, id) : sum);
        if (tree_[id].kind == NodeKind::function)
            functions_[text_.word_of(id)] = std::max(functions_[text_.word_of(id)], once_[id]);
    }
}

/// Counts how often each node runs in one call of its function, then how often each function is called.
void WorkEstimate::count_times() {
    std::unordered_map<std::string_view, std::vector<NodeId>> sites; // by the name that is called
    for (NodeId id = NodeId(tree_.nodes.size()) - 1; id > 0; --id) {
        const NodeId parent = tree_[id].parent;
        const bool inside = parent != k_no_node && tree_[id].kind != NodeKind::function;
        times_[id] =
            !inside ? 1 : times_[parent] * (is_loop(tree_[parent].kind) ? turns_of(text_, parent) : 1);
        if (calls_function(text_, facts_, id))
            sites[called_name(text_, id)].push_back(id);
    }
    std::unordered_map<std::string_view, double> calls{{"main", 1.0}};
    const std::function<double(NodeId)> calls_of = [&](NodeId function) {
        const std::string_view name = function == k_no_node ? "" : text_.word_of(function);
        const auto [known, fresh] = calls.emplace(name, 0.0); // stays 0 for a recursive call
        if (!fresh)
            return known->second;
        double sum = 0;
        for (const NodeId site : sites[name])
            sum += times_[site] * calls_of(tree_.around(site, NodeKind::function));
        return calls[name] = std::min(k_most, sum);
    };
    std::vector<double> in_all(times_.size());
    for (NodeId id = 1; id < tree_.nodes.size(); ++id)
        in_all[id] = times_[id] * calls_of(tree_.around(id, NodeKind::function));
    times_ = std::move(in_all);
}

} // namespace tidemark::glsl
