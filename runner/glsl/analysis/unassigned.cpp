#include "glsl/analysis/unassigned.hpp"

namespace tidemark::glsl {

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
