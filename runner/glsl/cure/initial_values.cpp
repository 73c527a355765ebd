#include "glsl/cure/initial_values.hpp"

#include "glsl/syntax/types.hpp"

#include <fmt/format.h>

namespace tidemark::glsl {
namespace {

/// `0.0`, `vec3(0.0)`, `false`; nothing for what is no number, vector or matrix.
std::optional<std::string> zero_of(std::string_view type) {
    const auto value = value_type(type);
    if (!value)
        return std::nullopt;
    const char* const zero = value->base == 'f'   ? "0.0"
                             : value->base == 'b' ? "false"
                             : value->base == 'u' ? "0u"
                                                  : "0";
    return value->scalar() ? zero : fmt::format("{}({})", type, zero);
}

/// k_no_node of a prototype.
NodeId body_of_function(const ParsedText& text, NodeId function) {
    const SyntaxTree& tree = text.tree();
    for (const NodeId part : tree.children(function))
        if (tree[part].kind == NodeKind::block)
            return part;
    return k_no_node;
}

std::optional<Wrap> at_brace(const ParsedText& text, size_t word, std::string front, std::string behind) {
    const Word& brace = text.words()[word];
    if (brace.from_macro() || text.spelled(word).file.empty())
        return std::nullopt;
    return wrapped(text, {brace.spelled, brace.spelled}, std::move(front), std::move(behind));
}

std::optional<Wrap> where_declared(const ParsedText& text, NodeId declarator) {
    const SyntaxTree& tree = text.tree();
    const NodeId type = tree.child(tree[declarator].parent, 0);
    const auto zero = zero_of(type_name(text, type));
    if (!zero || tree.child_count(declarator) > 0 || dimensions(text, type, declarator) > 0)
        return std::nullopt;
    const auto written = written_for(text, declarator, declarator);
    return written ? std::optional(wrapped(text, *written, "", " = " + *zero)) : std::nullopt;
}

/// The first of what the function does.
std::optional<Wrap> where_it_begins(const ParsedText& text, NodeId parameter) {
    const SyntaxTree& tree = text.tree();
    const NodeId type = tree.child(parameter, 0);
    const NodeId body = body_of_function(text, tree.around(parameter, NodeKind::function));
    const auto zero = zero_of(type_name(text, type));
    if (!zero || body == k_no_node || dimensions(text, type, parameter) > 0)
        return std::nullopt;
    return at_brace(text, tree[body].begin, "", fmt::format(" {} = {};", text.word_of(parameter), *zero));
}

std::optional<Wrap> where_it_ends(const ParsedText& text, NodeId function) {
    const SyntaxTree& tree = text.tree();
    const auto zero = zero_of(type_name(text, tree.child(function, 0)));
    const NodeId body = body_of_function(text, function);
    if (!zero || body == k_no_node)
        return std::nullopt;
    return at_brace(text, text.tree()[body].end - 1, fmt::format("return {}; ", *zero), "");
}

} // namespace

std::optional<Cure> initial_value(const ParsedText& text, const Unassigned& fault) {
    using Why = Unassigned::Why;
    const bool is_function = fault.why == Why::no_return;
    const bool is_parameter = text.tree()[fault.what].kind == NodeKind::parameter;
    auto wrap = is_function    ? where_it_ends(text, fault.what)
                : is_parameter ? where_it_begins(text, fault.what)
                               : where_declared(text, fault.what);
    if (!wrap)
        return std::nullopt;
    return Cure{{*std::move(wrap)},
                fmt::format("{} {}, as on ShaderToy's site", text.word_of(fault.what),
                            is_function ? "gives 0 back where no `return` is met" : "begins with 0")};
}

} // namespace tidemark::glsl
