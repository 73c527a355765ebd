#include "glsl/specialise/steps.hpp"

#include "glsl/syntax/tree_facts.hpp"

namespace tidemark::glsl {
namespace {

class StepFinder {
public:
    StepFinder(const ParsedText& text, const Variables& locals, const Variables& globals,
               const TypeOfCall& type_of_own)
        : text_(text), tree_(text.tree()), locals_(locals), globals_(globals), type_of_own_(type_of_own) {}

    std::optional<ValueType> walk(NodeId id) {
        const std::string_view word = text_.word_of(id);
        switch (tree_[id].kind) {
        case NodeKind::literal: return type_of_literal(word);
        case NodeKind::name: return type_of_name(word);
        case NodeKind::parenthesis: return walk(tree_.child(id, 0));
        case NodeKind::prefix: return word == "-" || word == "+" ? walk(tree_.child(id, 0)) : std::nullopt;
        case NodeKind::member: {
            const auto of = walk(tree_.child(id, 0));
            return of ? type_of_member(*of, word) : std::nullopt;
        }
        case NodeKind::binary: return word == "&&" || word == "||" ? std::nullopt : operation(id);
        case NodeKind::call: return call(id);
        default: return std::nullopt;
        }
    }

    std::vector<Step> take() { return std::move(steps_); }

private:
    std::optional<ValueType> type_of_name(std::string_view name) const {
        auto found = locals_.find(name);
        if (found == locals_.end() && (found = globals_.find(name)) == globals_.end())
            return std::nullopt;
        const Variable& variable = found->second;
        return variable.times == 1 && dimensions(text_, variable.type, variable.declared) == 0
                   ? value_type(type_name(text_, variable.type))
                   : std::nullopt;
    }

    std::optional<ValueType> step(NodeId id, std::optional<ValueType> type) {
        if (type && type->base == 'f')
            steps_.push_back({id, *type});
        return type;
    }

    std::optional<ValueType> operation(NodeId id) {
        const auto left = walk(tree_.child(id, 0));
        const auto right = walk(tree_.child(id, 1));
        return left && right ? step(id, type_of_operation(text_.word_of(id), *left, *right)) : std::nullopt;
    }

    std::optional<ValueType> call(NodeId id) {
        const std::vector<NodeId> parts = tree_.children(id);
        std::vector<ValueType> types;
        for (size_t i = 1; i < parts.size(); ++i)
            if (const auto type = walk(parts[i]))
                types.push_back(*type);
        if (const auto own = type_of_own_(id))
            return step(id, own);
        const std::string_view callee = called_name(text_, id);
        if (const auto built = value_type(callee))
            return step(id, built);
        const PureBuiltin* builtin = find_pure_builtin(callee);
        return builtin && types.size() + 1 == parts.size() ? step(id, type_of_call(*builtin, types))
                                                           : std::nullopt;
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const Variables& locals_;
    const Variables& globals_;
    const TypeOfCall& type_of_own_;
    std::vector<Step> steps_;
};

} // namespace

std::vector<Step> find_steps(const ParsedText& text, NodeId expression, const Variables& locals,
                             const Variables& globals, const TypeOfCall& type_of_own) {
    StepFinder finder(text, locals, globals, type_of_own);
    finder.walk(expression);
    return finder.take();
}

} // namespace tidemark::glsl
