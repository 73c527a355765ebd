#include "glsl/analysis/call_paths.hpp"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace tidemark::glsl {
namespace {

std::string_view function_around(const ParsedText& text, NodeId id) {
    const NodeId function = text.tree().around(id, NodeKind::function);
    return function == k_no_node ? std::string_view{} : text.word_of(function);
}

void add_loops_around(const ParsedText& text, NodeId id, std::vector<NodeId>& loops) {
    const SyntaxTree& tree = text.tree();
    for (NodeId around = id; around != k_no_node; around = tree[around].parent)
        if (is_loop(tree[around].kind) && std::find(loops.begin(), loops.end(), around) == loops.end())
            loops.push_back(around);
}

} // namespace

CallPaths find_call_paths(const ParsedText& text, const TreeFacts& facts, NodeId operation) {
    const SyntaxTree& tree = text.tree();
    std::unordered_map<std::string_view, std::vector<NodeId>> calls_of;
    for (NodeId id = 1; id < tree.nodes.size(); ++id)
        if (tree[id].kind == NodeKind::call)
            if (const auto* function = facts.function(called_name(text, id));
                function && !function->returns_array)
                calls_of[called_name(text, id)].push_back(id);
    CallPaths reach;
    add_loops_around(text, operation, reach.loops);
    std::vector<std::string_view> open{function_around(text, operation)};
    std::unordered_set<std::string_view> seen(open.begin(), open.end());
    while (!open.empty()) {
        const std::string_view name = open.back();
        open.pop_back();
        for (const NodeId call : calls_of[name]) {
            reach.calls.push_back(call);
            add_loops_around(text, call, reach.loops);
            if (const auto caller = function_around(text, call); seen.insert(caller).second)
                open.push_back(caller);
        }
    }
    std::sort(reach.calls.begin(), reach.calls.end());
    return reach;
}

} // namespace tidemark::glsl
