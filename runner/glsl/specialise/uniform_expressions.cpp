#include "glsl/specialise/uniform_expressions.hpp"

#include "glsl/syntax/builtin_functions.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <algorithm>

namespace tidemark::glsl {
namespace {

/// Longest chain of calls that is followed.
constexpr int k_deepest_calls = 60;

} // namespace

UniformExpressions::UniformExpressions(const ParsedText& text, const std::vector<Global>& globals)
    : text_(text), tree_(text.tree()) {
    read_globals(globals);
}

/// Collects numeric uniforms and constants; leaves names with several meanings.
void UniformExpressions::read_globals(const std::vector<Global>& globals) {
    globals_ = find_global_variables(text_, globals);
    for (const Global& global : globals)
        if (tree_[global.node].kind == NodeKind::function)
            functions_[text_.word_of(global.node)].push_back(&global);
    for (const Global& global : globals) { // a constant may use those before it
        if (tree_[global.node].kind != NodeKind::declaration)
            continue;
        const NodeId type = tree_.child(global.node, 0);
        const auto numeric = value_type(type_name(text_, type));
        const bool uniform = has_qualifier(text_, type, "uniform");
        if (!numeric || (!uniform && !has_qualifier(text_, type, "const")))
            continue;
        for (NodeId name = tree_[type].next; name != k_no_node; name = tree_[name].next)
            if (globals_[text_.word_of(name)].times == 1 && dimensions(text_, type, name) == 0 &&
                !functions_.contains(text_.word_of(name)))
                settled_[text_.word_of(name)] = {*numeric, uniform, false};
    }
}

void UniformExpressions::enter(const Global& function) {
    first_ = function.first;
    locals_ = find_variables(text_, function.first, function.node);
    written_.clear();
    aliases_.clear();
    find_written(function.first, function.node);
    values_.assign(function.node - function.first + 1, std::nullopt);
    for (NodeId id = function.first; id <= function.node; ++id) { // children come before their parents
        if (is_expression(tree_[id].kind))
            values_[id - first_] = evaluate(id);
        else if (tree_[id].kind == NodeKind::declaration)
            find_aliases(id);
    }
}

auto UniformExpressions::value(NodeId expression) const -> Value {
    return expression >= first_ && expression - first_ < values_.size() ? values_[expression - first_]
                                                                        : std::nullopt;
}

auto UniformExpressions::alias(std::string_view name) const -> const Alias* {
    const auto found = aliases_.find(name);
    return found == aliases_.end() ? nullptr : &found->second;
}

bool UniformExpressions::writes_through_arguments(std::string_view name) const {
    const auto found = functions_.find(name);
    if (found == functions_.end())
        return builtin_written_arguments(name) != 0;
    for (const Global* function : found->second)
        for (const NodeId part : tree_.children(function->node))
            if (tree_[part].kind == NodeKind::parameter) {
                const NodeId type = tree_.child(part, 0);
                if (has_qualifier(text_, type, "out") || has_qualifier(text_, type, "inout"))
                    return true;
            }
    return false;
}

void UniformExpressions::find_written(NodeId first, NodeId last) {
    const auto write = [&](NodeId target) {
        if (const NodeId base = base_of(tree_, target); tree_[base].kind == NodeKind::name)
            written_.insert(text_.word_of(base));
    };
    for (NodeId id = first; id <= last; ++id)
        if (is_change(text_, id))
            write(tree_.child(id, 0));
        else if (tree_[id].kind == NodeKind::call && writes_through_arguments(called_name(text_, id)))
            for (const NodeId argument : tree_.children(id))
                write(argument);
}

void UniformExpressions::find_aliases(NodeId declaration) {
    const NodeId type = tree_.child(declaration, 0);
    const auto numeric = value_type(type_name(text_, type));
    for (NodeId name = tree_[type].next; numeric && name != k_no_node; name = tree_[name].next) {
        const std::string_view word = text_.word_of(name);
        const NodeId initial = tree_.child(name, 0);
        if (initial == k_no_node || dimensions(text_, type, name) > 0 || locals_[word].times != 1 ||
            written_.contains(word) || globals_.contains(word) || functions_.contains(word))
            continue;
        const Value known = value(initial);
        if (known && (known->type == *numeric || (known->type.base == 'i' && numeric->base == 'f')))
            aliases_[word] = {initial, *numeric};
    }
}

/// Returns whether the name is the function in a call, which is not a value.
bool UniformExpressions::is_callee(NodeId name) const {
    const NodeId parent = tree_[name].parent;
    return tree_[parent].kind == NodeKind::call && tree_[parent].first_child == name;
}

auto UniformExpressions::evaluate(NodeId expression) const -> Value {
    const auto child = [&](size_t index) { return value(tree_.child(expression, index)); };
    switch (tree_[expression].kind) {
    case NodeKind::literal: {
        const auto type = type_of_literal(text_.word_of(expression));
        return type ? Value(FrameValue{*type}) : std::nullopt;
    }
    case NodeKind::name: return is_callee(expression) ? std::nullopt : name(text_.word_of(expression));
    case NodeKind::parenthesis: return child(0);
    case NodeKind::prefix: {
        const std::string_view op = text_.word_of(expression);
        return op == "-" || op == "+" ? child(0) : std::nullopt;
    }
    case NodeKind::binary: {
        const Value left = child(0);
        const Value right = child(1);
        if (!left || !right)
            return std::nullopt;
        const auto type = type_of_operation(text_.word_of(expression), left->type, right->type);
        return type ? Value({*type, left->uniform || right->uniform, left->costly || right->costly})
                    : std::nullopt;
    }
    case NodeKind::member: {
        const Value of = child(0);
        const auto type = of ? type_of_member(of->type, text_.word_of(expression)) : std::nullopt;
        return type ? Value({*type, of->uniform, of->costly}) : std::nullopt;
    }
    case NodeKind::call: return call(expression);
    default: return std::nullopt;
    }
}

auto UniformExpressions::name(std::string_view name) const -> Value {
    if (const Alias* known = alias(name)) {
        Value found = value(known->value);
        found->type = known->type;
        return found;
    }
    if (locals_.contains(name))
        return std::nullopt;
    const auto found = settled_.find(name);
    return found == settled_.end() ? std::nullopt : Value(found->second);
}

auto UniformExpressions::call(NodeId call) const -> Value {
    std::vector<ValueType> types;
    bool uniform = false;
    bool costly = false;
    const std::string_view callee = called_name(text_, call);
    if (callee.empty() || locals_.contains(callee))
        return std::nullopt;
    for (NodeId argument = tree_[tree_.child(call, 0)].next; argument != k_no_node;
         argument = tree_[argument].next) {
        const Value known = value(argument);
        if (!known)
            return std::nullopt;
        types.push_back(known->type);
        uniform = uniform || known->uniform;
        costly = costly || known->costly;
    }
    Value result = call_of(callee, types);
    if (result) {
        result->uniform = result->uniform || uniform;
        result->costly = result->costly || costly;
    }
    return result;
}

auto UniformExpressions::call_of(std::string_view callee, std::span<const ValueType> arguments) const
    -> Value {
    if (functions_.contains(callee)) {
        const auto pure = pure_function(callee);
        return pure ? Value({pure->type, pure->uniform, pure->costly}) : std::nullopt;
    }
    if (const auto built = value_type(callee))
        return FrameValue{*built};
    const BuiltinFunction* builtin = find_builtin(callee);
    const auto type = builtin && builtin->is(Trait::pure) ? type_of_call(*builtin, arguments) : std::nullopt;
    return type ? Value({*type, false, builtin->is(Trait::costly)}) : std::nullopt;
}

std::optional<PureFunction> UniformExpressions::pure_function(std::string_view name) const {
    const auto known = pure_.find(name);
    if (known != pure_.end())
        return known->second;
    pure_[name] = std::nullopt; // the result for a recursive call
    const Global* definition = nullptr;
    for (const Global* function : functions_.at(name))
        for (const NodeId part : tree_.children(function->node))
            if (tree_[part].kind == NodeKind::block) {
                if (definition)
                    return std::nullopt; // overloads
                definition = function;
            }
    if (!definition || writes_through_arguments(name) || functions_open_ >= k_deepest_calls)
        return std::nullopt;
    ++functions_open_;
    const auto pure = examine(*definition);
    --functions_open_;
    pure_[name] = pure;
    return pure;
}

/// Returns nothing unless every name is a local variable, constant during the frame, or a function that only
/// computes, and there is no loop: a loop might not end where the author does not call it.
std::optional<PureFunction> UniformExpressions::examine(const Global& function) const {
    const NodeId type = tree_.child(function.node, 0);
    const auto result = value_type(type_name(text_, type));
    if (!result || dimensions(text_, type, k_no_node) > 0)
        return std::nullopt;
    PureFunction pure{*result};
    const Variables locals = find_variables(text_, function.first, function.node);
    for (NodeId id = function.first; id <= function.node; ++id) {
        if (is_loop(tree_[id].kind) || (tree_[id].kind == NodeKind::jump && text_.word_of(id) == "discard"))
            return std::nullopt;
        if (tree_[id].kind == NodeKind::call && called_name(text_, id).empty())
            return std::nullopt;
        if (tree_[id].kind != NodeKind::name)
            continue;
        const std::string_view name = text_.word_of(id);
        if (!is_callee(id)) {
            const auto global = settled_.find(name);
            const bool settled = global != settled_.end();
            // A local variable's name may be a global one elsewhere in the function.
            const bool local = locals.contains(name) && !globals_.contains(name);
            if (!local && !settled && name != "true" && name != "false")
                return std::nullopt;
            pure.uniform = pure.uniform || (settled && global->second.uniform);
        } else if (functions_.contains(name)) {
            const auto called = pure_function(name);
            if (!called)
                return std::nullopt;
            pure.uniform = pure.uniform || called->uniform;
            pure.costly = pure.costly || called->costly;
        } else if (const BuiltinFunction* builtin = find_builtin(name); builtin && builtin->is(Trait::pure)) {
            pure.costly = pure.costly || builtin->is(Trait::costly);
        } else if (!value_type(name)) {
            return std::nullopt;
        }
    }
    return pure;
}

} // namespace tidemark::glsl
