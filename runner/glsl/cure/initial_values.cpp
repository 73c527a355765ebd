#include "glsl/cure/initial_values.hpp"

#include "glsl/flow/zero_value.hpp"

#include <fmt/format.h>

namespace tidemark::glsl {
namespace {

/// Writes the zero of a variable, of a parameter or of a function's result.
class Zeros {
public:
    Zeros(const ParsedText& text, const TreeFacts& facts) : text_(text), facts_(facts), shapes_(text) {}

    std::optional<Wrap> where_declared(NodeId declarator) {
        const auto zero = zero_of(tree().child(tree()[declarator].parent, 0), declarator);
        const auto written = zero ? written_for(text_, declarator, declarator) : std::nullopt;
        return written ? std::optional(wrapped(text_, *written, "", " = " + *zero)) : std::nullopt;
    }

    /// Sets the parameter at the start of the function's body.
    std::optional<Wrap> where_it_begins(NodeId parameter) {
        const NodeId body = body_of_function(text_, tree().around(parameter, NodeKind::function));
        const auto zero = zero_of(tree().child(parameter, 0), parameter);
        if (!zero || body == k_no_node)
            return std::nullopt;
        return at_word(text_, tree()[body].begin, "",
                       fmt::format(" {} = {};", text_.word_of(parameter), *zero));
    }

    std::optional<Wrap> where_it_ends(NodeId function) {
        const NodeId body = body_of_function(text_, function);
        const auto zero = zero_of(tree().child(function, 0), k_no_node);
        if (!zero || body == k_no_node)
            return std::nullopt;
        return at_word(text_, tree()[body].end - 1, fmt::format("return {}; ", *zero), "");
    }

private:
    const SyntaxTree& tree() const { return text_.tree(); }
    std::optional<std::string> zero_of(NodeId type, NodeId declared) {
        return zero_value(shapes_.of(type, declared), facts_);
    }

    const ParsedText& text_;
    const TreeFacts& facts_;
    Shapes shapes_;
};

} // namespace

std::optional<Cure> initial_value(const ParsedText& text, const TreeFacts& facts, const Unassigned& fault) {
    const bool is_function = fault.why == Unassigned::Why::no_return;
    const bool is_parameter = text.tree()[fault.what].kind == NodeKind::parameter;
    Zeros zeros(text, facts);
    auto wrap = is_function    ? zeros.where_it_ends(fault.what)
                : is_parameter ? zeros.where_it_begins(fault.what)
                               : zeros.where_declared(fault.what);
    if (!wrap)
        return std::nullopt;
    return Cure{{*std::move(wrap)},
                fmt::format("{} {}, as on ShaderToy's site", text.word_of(fault.what),
                            is_function ? "gives 0 back where no `return` is met" : "begins with 0")};
}

} // namespace tidemark::glsl
