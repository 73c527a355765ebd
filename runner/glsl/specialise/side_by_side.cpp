#include "glsl/specialise/side_by_side.hpp"

#include "glsl/specialise/only_read.hpp"
#include "glsl/specialise/steps.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>

namespace tidemark::glsl {
namespace {

/// More chains than this at once do not fit a processor's registers.
constexpr size_t k_most_calls = 4;
/// Lines that call lines that call lines …
constexpr int k_deepest = 60;

/// A function whose statements run one after the other, each once, to a result that is its only effect.
struct Line {
    const Global* function = nullptr;
    ValueType type;
    std::vector<NodeId> parameters{};
    std::vector<NodeId> statements{}; ///< without the last, which returns
    NodeId result = k_no_node;
    Variables locals{};
    int depth = 0; ///< of the lines that it calls
};

/// An expression of calls of one line and nothing else.
struct Site {
    const Line* line = nullptr;
    std::vector<NodeId> calls{};
    ValueType type{};
    std::string before{}, between{}, after{}; ///< the results: `min(`, `, `, `)`
};

/// Where steps begin that have variables: the widest so far.
struct NumberedStep {
    size_t end = 0; ///< word
    size_t number = 0;
    ValueType type;
};
using StepNumbers = std::unordered_map<size_t, NumberedStep>;

class SideBySide {
public:
    SideBySide(const ParsedText& text, WordEdits& edits)
        : text_(text), tree_(text.tree()), edits_(edits), globals_(find_globals(text)),
          only_read_(text, globals_), variables_(find_global_variables(text, globals_)) {
        for (const MacroLine& macro : text.preprocessed().macros)
            macros_.insert(macro.name);
    }

    int run() {
        for (const Global& global : globals_) {
            if (tree_[global.node].kind != NodeKind::function)
                continue;
            if (edits_.begins_alone(tree_[global.node].begin))
                pair_calls_in(global);
            if (auto line = line_of(global))
                lines_.emplace(global.names[0], *std::move(line));
        }
        return count_;
    }

private:
    // ---- Lines ----------------------------------------------------------------------------------

    /// What a macro would take for its own cannot be said again.
    bool can_be_said(size_t begin, size_t end) const {
        return std::none_of(
            text_.words().begin() + long(begin), text_.words().begin() + long(end), [&](const Word& word) {
                return word.kind == text::TokenKind::identifier && macros_.contains(word.text);
            });
    }

    std::optional<Line> line_of(const Global& function) const {
        const Reader& reader = *only_read_.function(function.names[0]);
        const std::vector<NodeId> parts = tree_.children(function.node);
        const auto type = value_type(type_name(text_, parts[0]));
        if (reader.last != &function || reader.definitions != 1 || !reader.only_reads() || !reader.costly ||
            !type || dimensions(text_, parts[0], k_no_node) > 0 ||
            !can_be_said(tree_[function.node].begin, tree_[function.node].end))
            return std::nullopt;
        Line line{&function, *type};
        line.locals = find_variables(text_, function.first, function.node);
        for (const auto& [name, variable] : line.locals)
            if (variable.times != 1 || only_read_.is_global_variable(name) || only_read_.function(name))
                return std::nullopt;
        for (const NodeId part : parts)
            if (tree_[part].kind == NodeKind::parameter && !add_parameter(part, line))
                return std::nullopt;
        return add_statements(parts.back(), line) ? std::optional(std::move(line)) : std::nullopt;
    }

    bool add_parameter(NodeId parameter, Line& line) const {
        const NodeId type = tree_.child(parameter, 0);
        line.parameters.push_back(parameter);
        return tree_[parameter].word >= tree_[type].end && !has_qualifier(text_, type, "out") &&
               !has_qualifier(text_, type, "inout");
    }

    bool add_statements(NodeId block, Line& line) const {
        line.statements = tree_.children(block);
        if (line.statements.empty() || tree_[line.statements.back()].kind != NodeKind::give_back)
            return false;
        line.result = tree_.child(line.statements.back(), 0);
        line.statements.pop_back();
        for (const NodeId statement : line.statements)
            if (tree_[statement].kind != NodeKind::declaration &&
                tree_[statement].kind != NodeKind::expression)
                return false;
        for (NodeId id = line.function->first; id <= line.function->node; ++id)
            if (const Line* called = called_line(id))
                line.depth = std::max(line.depth, called->depth + 1);
        return line.result != k_no_node && line.depth < k_deepest;
    }

    NodeId inside(NodeId expression) const {
        while (tree_[expression].kind == NodeKind::parenthesis)
            expression = tree_.child(expression, 0);
        return expression;
    }

    /// The line that an expression is a call of.
    const Line* called_line(NodeId expression) const {
        expression = inside(expression);
        if (tree_[expression].kind != NodeKind::call)
            return nullptr;
        const auto found = lines_.find(called_name(text_, expression));
        return found != lines_.end() && tree_.child_count(expression) == found->second.parameters.size() + 1
                   ? &found->second
                   : nullptr;
    }

    // ---- Expressions of calls -------------------------------------------------------------------

    void pair_calls_in(const Global& function) {
        declarations_.clear();
        for (NodeId id = function.node; id >= function.first;) { // parents first
            if (const auto site = site_at(id)) {
                edits_.replace(tree_[id].begin, tree_[id].end, replacement(*site));
                ++count_;
                while (tree_[id].first_child != k_no_node)
                    id = tree_[id].first_child;
            }
            --id;
        }
        if (!declarations_.empty())
            edits_.insert(tree_[function.node].begin, declarations_);
    }

    std::optional<Site> site_at(NodeId id) const {
        std::vector<NodeId> parts = tree_.children(id);
        if (tree_[id].kind == NodeKind::call)
            parts.erase(parts.begin());
        else if (tree_[id].kind != NodeKind::binary)
            return std::nullopt;
        if (parts.size() < 2 || parts.size() > k_most_calls)
            return std::nullopt;
        Site site{called_line(parts[0])};
        if (!site.line || !edits_.stands_alone(tree_[id].begin, tree_[id].end) ||
            !can_be_said(tree_[id].begin, tree_[id].end) ||
            !std::all_of(parts.begin(), parts.end(), [&](NodeId part) {
                return called_line(part) == site.line && changes_nothing(part);
            }))
            return std::nullopt;
        for (const NodeId part : parts)
            site.calls.push_back(inside(part));
        return combine(id, site) ? std::optional(std::move(site)) : std::nullopt;
    }

    bool changes_nothing(NodeId expression) const {
        NodeId first = expression;
        while (tree_[first].first_child != k_no_node)
            first = tree_[first].first_child;
        return only_read_.changes_only(first, expression, {});
    }

    /// `a + b`, or a call of a constructor or of a built-in function.
    bool combine(NodeId id, Site& site) const {
        const std::vector<ValueType> types(site.calls.size(), site.line->type);
        std::optional<ValueType> type;
        if (tree_[id].kind == NodeKind::binary) {
            type = type_of_operation(text_.word_of(id), types[0], types[1]);
            site.between = fmt::format(" {} ", text_.word_of(id));
        } else if (const std::string_view callee = called_name(text_, id); !only_read_.function(callee)) {
            const PureBuiltin* builtin = find_pure_builtin(callee);
            type = builtin ? type_of_call(*builtin, types) : value_type(callee);
            site.before = fmt::format("{}(", callee);
            site.between = ", ";
            site.after = ')';
        }
        site.type = type.value_or(ValueType{});
        return type.has_value();
    }

    // ---- What is written ------------------------------------------------------------------------

    std::string own_name(size_t call, std::string_view name) const {
        return fmt::format("tidemark{}{}", call, name);
    }

    static std::string step_name(size_t call, size_t number) {
        return fmt::format("tidemark_step{}_{}", call, number);
    }

    static std::vector<std::string> results(size_t calls) {
        std::vector<std::string> names;
        for (size_t call = 0; call < calls; ++call)
            names.push_back(fmt::format("tidemark_result{}", call));
        return names;
    }

    std::string spell(const Line& line, NodeId node, size_t call) const {
        return spell(line, node, call, {});
    }

    /// Words of a line, with the variables of one of the calls; where a step begins that has one, its
    /// variable.
    std::string spell(const Line& line, NodeId node, size_t call, const StepNumbers& numbers) const {
        std::string spelled;
        for (size_t i = tree_[node].begin; i < tree_[node].end; ++i) {
            spelled += spelled.empty() ? "" : " ";
            if (const auto step = numbers.find(i); step != numbers.end()) {
                spelled += step_name(call, step->second.number);
                i = step->second.end - 1;
                continue;
            }
            const Word& word = text_.words()[i];
            const bool own = word.kind == text::TokenKind::identifier && line.locals.contains(word.text) &&
                             !text_.words()[i - 1].is(".");
            spelled += own ? own_name(call, word.text) : std::string(word.text);
        }
        return spelled;
    }

    /// Of all calls, one call after the other.
    std::vector<std::string> parameters(const Line& line, size_t calls, bool with_types) const {
        std::vector<std::string> list;
        for (size_t call = 0; call < calls; ++call)
            for (const NodeId parameter : line.parameters)
                list.push_back(with_types ? spell(line, parameter, call)
                                          : own_name(call, text_.word_of(parameter)));
        return list;
    }

    /// In place of an expression: a call of what works out the results and puts them together.
    std::string replacement(const Site& site) {
        std::vector<std::string> arguments;
        for (const NodeId call : site.calls)
            for (NodeId each = tree_[tree_.child(call, 0)].next; each != k_no_node; each = tree_[each].next) {
                std::vector<std::string_view> words;
                for (size_t i = tree_[each].begin; i < tree_[each].end; ++i)
                    words.push_back(text_.word(i));
                arguments.push_back(fmt::format("{}", fmt::join(words, " ")));
            }
        return fmt::format("{}({})", together(site), fmt::join(arguments, ", "));
    }

    std::string together(const Site& site) {
        const size_t calls = site.calls.size();
        const std::string turns = in_turns(*site.line, calls);
        std::string& name = names_[turns + site.before + site.between];
        if (!name.empty())
            return name;
        name = fmt::format("tidemark_together{}", names_.size());
        std::vector<std::string> passed = parameters(*site.line, calls, false);
        const std::vector<std::string> values = results(calls);
        passed.insert(passed.end(), values.begin(), values.end());
        declarations_ +=
            fmt::format("{} {}({}) {{ {} {}; {}({}); return {}{}{}; }} ", to_string(site.type), name,
                        fmt::join(parameters(*site.line, calls, true), ", "), to_string(site.line->type),
                        fmt::join(values, ", "), turns, fmt::join(passed, ", "), site.before,
                        fmt::join(values, site.between), site.after);
        return name;
    }

    /// The function that runs a line for so many calls and gives their results.
    std::string in_turns(const Line& line, size_t calls) {
        std::string& name = names_[fmt::format("{} {}", line.function->node, calls)];
        if (!name.empty())
            return name;
        name = fmt::format("tidemark_in_turns{}", names_.size());
        std::string body;
        StepNumbers numbers;
        for (const NodeId statement : line.statements) {
            body += steps_in_turns(line, value_of(statement), calls, numbers);
            for (size_t call = 0; call < calls; ++call)
                body += spell(line, statement, call, numbers) + ' ';
        }
        body += steps_in_turns(line, line.result, calls, numbers);
        for (size_t call = 0; call < calls; ++call)
            body += fmt::format("{} = {}; ", results(calls)[call], spell(line, line.result, call, numbers));
        std::vector<std::string> list = parameters(line, calls, true);
        for (const std::string& result : results(calls))
            list.push_back(fmt::format("out {} {}", to_string(line.type), result));
        declarations_ += fmt::format("void {}({}) {{ {} }} ", name, fmt::join(list, ", "), body);
        return name;
    }

    /// The expression of a statement that can be taken apart: that of a variable, or what one is set to.
    NodeId value_of(NodeId statement) const {
        const NodeId first = tree_.child(statement, 0);
        NodeId value = k_no_node;
        if (tree_[statement].kind == NodeKind::expression && tree_[first].kind == NodeKind::assign) {
            value = tree_.child(first, 1);
        } else if (tree_[statement].kind == NodeKind::declaration && tree_.child_count(statement) == 2 &&
                   !has_qualifier(text_, first, "const")) {
            const NodeId declarator = tree_.child(statement, 1);
            value = dimensions(text_, first, declarator) == 0 ? tree_.child(declarator, 0) : k_no_node;
        }
        return value != k_no_node && changes_nothing(value) ? value : k_no_node;
    }

    /// Variables for the steps of an expression, each for every call before the next.
    std::string steps_in_turns(const Line& line, NodeId value, size_t calls, StepNumbers& numbers) {
        if (value == k_no_node || !changes_nothing(value))
            return {};
        std::string text;
        for (const Step& step : find_steps(text_, value, line.locals, variables_,
                                           [this](NodeId call) { return type_of_own(call); })) {
            const Line* called = called_line(step.node);
            const auto operand = called ? std::nullopt : operand_like(step, numbers);
            const size_t number = operand ? *operand : next_step_++;
            if (called)
                text += call_in_turns(line, *called, step.node, calls, number, numbers);
            for (size_t call = 0; call < calls && !called; ++call)
                text += fmt::format("{} {} = {}; ", operand ? "" : to_string(step.type),
                                    step_name(call, number), spell(line, step.node, call, numbers));
            numbers[tree_[step.node].begin] = {tree_[step.node].end, number, step.type};
        }
        return text;
    }

    /// The variable of an operand of the step's type: nobody else needs it. One that is set twice is not put
    /// back into the expression that it came from, as Mesa's compiler does with those that are set and read
    /// once.
    std::optional<size_t> operand_like(const Step& step, const StepNumbers& numbers) const {
        for (size_t i = tree_[step.node].begin; i < tree_[step.node].end; ++i)
            if (const auto operand = numbers.find(i); operand != numbers.end()) {
                if (operand->second.type == step.type)
                    return operand->second.number;
                i = operand->second.end - 1;
            }
        return std::nullopt;
    }

    std::string call_in_turns(const Line& line, const Line& called, NodeId node, size_t calls, size_t number,
                              const StepNumbers& numbers) {
        std::vector<std::string> arguments;
        std::vector<std::string> values;
        const std::vector<NodeId> parts = tree_.children(node);
        for (size_t call = 0; call < calls; ++call) {
            values.push_back(step_name(call, number));
            for (size_t i = 1; i < parts.size(); ++i)
                arguments.push_back(spell(line, parts[i], call, numbers));
        }
        arguments.insert(arguments.end(), values.begin(), values.end());
        return fmt::format("{} {}; {}({}); ", to_string(called.type), fmt::join(values, ", "),
                           in_turns(called, calls), fmt::join(arguments, ", "));
    }

    std::optional<ValueType> type_of_own(NodeId call) const {
        const Reader* own = only_read_.function(called_name(text_, call));
        return own && own->definitions == 1 ? value_type(type_name(text_, tree_.child(own->last->node, 0)))
                                            : std::nullopt;
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    WordEdits& edits_;
    std::vector<Global> globals_;
    OnlyRead only_read_;
    std::unordered_set<std::string_view> macros_;
    Variables variables_;                              ///< global
    std::unordered_map<std::string_view, Line> lines_; ///< that stand before the function in hand
    std::map<std::string, std::string> names_;         ///< of functions that were written, by what they are
    std::string declarations_;                         ///< in front of the function in hand
    size_t next_step_ = 0;
    int count_ = 0;
};

} // namespace

int run_side_by_side(const ParsedText& text, WordEdits& edits) {
    return SideBySide(text, edits).run();
}

} // namespace tidemark::glsl
