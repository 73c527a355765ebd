#include "glsl/specialise/only_read.hpp"

#include "glsl/specialise/value_types.hpp"

#include <algorithm>

namespace tidemark::glsl {
namespace {

/// Built-in functions that others see the effect of.
bool has_effects(std::string_view builtin) {
    return builtin.starts_with("image") || builtin.starts_with("atomic") ||
           builtin.find("arrier") != std::string_view::npos || builtin.starts_with("Emit") ||
           builtin.starts_with("End");
}

} // namespace

/// In the order of the text: of what a function calls and is defined later, nothing is known.
OnlyRead::OnlyRead(const ParsedText& text, const std::vector<Global>& globals)
    : text_(text), tree_(text.tree()), facts_(find_facts(text)) {
    std::vector<const Global*> definitions;
    for (const Global& global : globals) {
        const Node& node = tree_[global.node];
        if (node.kind != NodeKind::function) {
            variables_.insert(global.names.begin(), global.names.end());
            continue;
        }
        Reader& reader = functions_[global.names[0]];
        const auto parts = tree_.children(global.node);
        if (tree_[parts.back()].kind != NodeKind::block)
            continue; // a prototype
        ++reader.definitions;
        definitions.push_back(&global);
    }
    for (const Global* function : definitions)
        look_at(*function);
}

const Reader* OnlyRead::function(std::string_view name) const {
    const auto found = functions_.find(name);
    return found == functions_.end() ? nullptr : &found->second;
}

void OnlyRead::look_at(const Global& function) {
    bool costly = false;
    for (NodeId id = function.first; id <= function.node; ++id) {
        if (tree_[id].kind != NodeKind::call)
            continue;
        const Reader* own = this->function(called_name(text_, id));
        const PureBuiltin* builtin = own ? nullptr : find_pure_builtin(called_name(text_, id));
        costly = costly || (own && own->costly) || (builtin && builtin->costly);
    }
    const bool reads =
        changes_only(function.first, function.node, find_variables(text_, function.first, function.node));
    Reader& reader = functions_[function.names[0]];
    reader.known += reads;
    reader.costly = reader.costly || costly;
    reader.last = &function;
}

/// By name: a global variable may be meant outside the scope of the local one.
bool OnlyRead::is_local(NodeId target, const Variables& locals) const {
    target = base_of(tree_, target);
    return tree_[target].kind == NodeKind::name && locals.contains(text_.word_of(target)) &&
           !is_global_variable(text_.word_of(target));
}

bool OnlyRead::may_call(NodeId call, const Variables& locals) const {
    const std::string_view callee = called_name(text_, call); // of an array's constructor and .length() none
    const Reader* own = function(callee);
    if (own ? !own->only_reads() : has_effects(callee))
        return false;
    const std::vector<NodeId> parts = tree_.children(call);
    for (size_t i = 1; i < parts.size(); ++i)
        if (facts_.writes_argument(callee, i - 1) && !is_local(parts[i], locals))
            return false;
    return true;
}

bool OnlyRead::changes_only(NodeId first, NodeId last, const Variables& locals) const {
    for (NodeId id = first; id <= last; ++id) {
        if (is_change(text_, id) && !is_local(tree_.child(id, 0), locals))
            return false;
        if (tree_[id].kind == NodeKind::call && !may_call(id, locals))
            return false;
        if (tree_[id].kind == NodeKind::jump && text_.word_of(id) == "discard")
            return false;
    }
    return true;
}

} // namespace tidemark::glsl
