// Does the operations of one line a second time, with operands that no compiler knows to be the same.

#include "base/error.hpp"
#include "shader/lens_text.hpp"
#include "shader/loops.hpp"
#include "shader/source_edits.hpp"
#include "shader/variables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::glsl {
namespace {

/// GLSL: `$shift(v)` is v plus a zero; `$keep(v)` a float that needs all components of v; `$add(v, k)` is v
/// plus k times the zero.
constexpr std::string_view k_scalar_functions = R"(uniform float $zero;
uniform int $nought;
float $shift(float v) { return v + $zero; }
int $shift(int v) { return v + $nought; }
uint $shift(uint v) { return v + uint($nought); }
bool $shift(bool v) { return v; }
float $keep(float v) { return v; }
float $keep(int v) { return float(v); }
float $keep(uint v) { return float(v); }
float $keep(bool v) { return float(v); }
float $add(float v, float k) { return v + $zero * k; }
int $add(int v, float k) { return v + $nought * int(k); }
uint $add(uint v, float k) { return v + uint($nought) * uint(k); }
bool $add(bool v, float k) { return v != ($zero * k > 0.5); }
)";

std::string twice_functions(std::string_view prefix) {
    constexpr std::string_view k_parts[] = {"v.x", "v.x + v.y", "v.x + v.y + v.z", "v.x + v.y + v.z + v.w"};
    std::string text = spell(k_scalar_functions, prefix);
    for (size_t i = 0; i < std::size(k_vectors); ++i) {
        const size_t last = i % 4;
        if (last == 0)
            continue;
        const std::string_view type = k_vectors[i];
        if (type.starts_with('b')) {
            text += fmt::format("{0} {1}shift({0} v) {{ return v; }}\n"
                                "float {1}keep({0} v) {{ return float(all(v)); }}\n",
                                type, prefix);
            continue;
        }
        const std::string_view zero = type.starts_with('i')   ? "$nought"
                                      : type.starts_with('u') ? "uint($nought)"
                                                              : "$zero";
        const std::string_view number = type.starts_with('i')   ? "int(k)"
                                        : type.starts_with('u') ? "uint(k)"
                                                                : "k";
        text += spell(fmt::format("{0} $shift({0} v) {{ return v + {1}; }}\n"
                                  "float $keep({0} v) {{ return float({2}); }}\n"
                                  "{0} $add({0} v, float k) {{ return v + {1} * {3}; }}\n",
                                  type, zero, k_parts[last], number),
                      prefix);
    }
    for (const std::string_view type : std::span(k_matrices).first<k_square_matrices>()) {
        std::string columns;
        for (int i = 0; i < type.back() - '0'; ++i)
            columns += fmt::format("{}$keep(v[{}])", i == 0 ? "" : " + ", i);
        text += spell(fmt::format("{0} $shift({0} v) {{ return v + $zero; }}\n"
                                  "float $keep({0} v) {{ return {1}; }}\n"
                                  "{0} $add({0} v, float k) {{ return v + $zero * k; }}\n",
                                  type, columns),
                      prefix);
    }
    return text;
}

/// Returns what precedes the text.
std::string headers_of(const ParsedText& text) {
    return text.headers() + (text.is_es() ? "precision highp float;\nprecision highp int;\n" : "");
}

/// Returns whether one shifted operand is enough for the function to be computed anew.
bool needs_one_operand(std::string_view name) {
    constexpr std::string_view k_names[] = {"min", "max", "dot", "step", "distance", "cross"};
    return std::ranges::find(k_names, name) != std::end(k_names);
}

class TwiceWriter {
public:
    TwiceWriter(const ParsedText& text, const TreeFacts& facts, const WorkText& counted,
                const SourceLocation& place, bool uniforms_are_known)
        : text_(text), tree_(text.tree()), facts_(facts), counted_(counted), place_(place),
          known_(find_known(text, facts, uniforms_are_known ? KnownTo::frame : KnownTo::compilers)),
          prefix_(fresh_prefix(text)) {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            if (tree_[id].kind == NodeKind::declarator &&
                tree_[tree_[tree_[id].parent].parent].kind == NodeKind::loop_for)
                counters_.insert(text_.word_of(id));
    }

    Result<LineTwice> run() {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            if (is_on_line(id))
                result_.work += counted_.own[id];
        for (const NodeId function : tree_.children(0))
            if (tree_[function].kind == NodeKind::function)
                visit(function);
        if (result_.repeated <= 0 || result_.repeated < 0.5 * result_.work)
            return fail(ErrorCode::load, "the line's operations cannot be repeated");
        result_.text = written(&Around::after);
        result_.control = written(&Around::after_control);
        return std::move(result_);
    }

private:
    /// Words around a node: the same ones precede it in both texts.
    struct Around {
        std::string before, after, after_control;
    };

    std::string written(std::string Around::*after) const {
        SourceRewriter edits(text_);
        for (const auto& [node, wraps] : wraps_)
            for (const Around& each : wraps)
                edits.wrap(node, each.before, each.*after);
        return headers_of(text_) + twice_functions(prefix_) + temporaries_ + edits.text();
    }

    /// A second computation of an expression.
    struct Copy {
        std::string words;
        bool shifted = false; ///< it differs from the first one, for compilers
        double covered = 0;   ///< counted work of its operations
    };

    /// Wraps of nodes that a copy needs, kept only if the copy succeeds.
    struct Draft {
        std::vector<std::pair<NodeId, std::string>>
            saved;                     ///< nodes with the variables that keep their values
        std::set<std::string> shifted; ///< operands
        bool possible = true;
    };

    bool is_on_line(NodeId id) const {
        if (counted_.own[id] <= 0)
            return false;
        const SourceLocation at = text_.used(tree_[id].word);
        return at.line == place_.line && at.file == place_.file;
    }

    NodeId bare(NodeId id) const { return without_brackets(tree_, id); }

    /// Returns whether the node is a variable or a part of one, without operations.
    bool is_plain_place(NodeId id) const {
        for (id = bare(id); tree_[id].kind == NodeKind::member || tree_[id].kind == NodeKind::index;
             id = bare(tree_.child(id, 0)))
            if (tree_[id].kind == NodeKind::index)
                for (NodeId each = tree_.child(id, 1);
                     each != k_no_node && tree_.is_within(each, tree_.child(id, 1)); --each)
                    if (tree_[each].kind == NodeKind::call || is_change(text_, each))
                        return false;
        return tree_[id].kind == NodeKind::name;
    }

    double size_of(NodeId id) const {
        const auto type = expression_type(text_, facts_, id);
        return type ? double(type->columns * type->rows) : 1.0;
    }

    bool is_sampler(NodeId id) const {
        const auto found = facts_.names.find(text_.word_of(base_of(tree_, bare(id))));
        return found != facts_.names.end() && found->second.sampler;
    }

    /// Finds the operations of the line that are inside no other one, and repeats them.
    void visit(NodeId id) {
        const NodeKind kind = tree_[id].kind;
        if (is_expression(kind) && must_stay_constant(text_, id))
            return;
        if (kind == NodeKind::loop_for || kind == NodeKind::loop_while || kind == NodeKind::loop_do)
            return visit(body_of_loop(tree_, id)); // a changed head may not be unrolled
        if (is_expression(kind) && is_on_line(id) && !calls_authors_function(text_, facts_, id) &&
            !known_[id] && repeat(id))
            return;
        for (const NodeId child : tree_.children(id))
            visit(child);
    }

    /// Returns false if the operation stays as it is.
    bool repeat(NodeId id) {
        Draft draft;
        NodeId value = id;
        Copy again;
        if (tree_[id].kind == NodeKind::assign) {
            const NodeId target = tree_.child(id, 0);
            value = tree_.child(id, 1);
            if (text_.word_of(id) == "=" || !is_plain_place(target))
                return false;
            const std::string op(text_.word_of(id).substr(0, text_.word_of(id).size() - 1));
            again = operation(target, op, value, draft);
            again.covered += counted_.own[id];
        } else if (is_change(text_, id)) {
            return false;
        } else {
            again = copy(id, true, draft);
        }
        if (!draft.possible || !again.shifted || again.covered <= 0)
            return false;
        result_.repeated += again.covered;
        std::string operands;
        for (const std::string& operand : draft.shifted)
            operands += fmt::format("{}{}keep({})", operands.empty() ? "" : "+", prefix_, operand);
        for (auto& [node, name] : draft.saved)
            wraps_[node].push_back({"(" + name + "=", ")", ")"});
        wraps_[value].push_back({prefix_ + "add(", fmt::format(",{}keep({}))", prefix_, again.words),
                                 fmt::format(",{})", operands)});
        for (const auto& [node, name] : draft.saved)
            for (const NodeId child : tree_.children(node))
                visit(child);
        return true;
    }

    /// Repeats `left op right`.
    Copy operation(NodeId left, std::string_view op, NodeId right, Draft& draft) {
        const bool both = op == "/" || op == "%";
        const bool left_is_place = is_operand(left), right_is_place = is_operand(right);
        Copy first, second;
        if (both) {
            first = copy(left, true, draft);
            second = copy(right, true, draft);
        } else if (left_is_place && right_is_place) {
            const bool prefers_right =
                known_[bare(left)] || (!known_[bare(right)] && size_of(right) < size_of(left));
            first = copy(left, !prefers_right, draft);
            second = copy(right, prefers_right || !first.shifted, draft);
        } else {
            first = copy(left, !left_is_place, draft);
            second = copy(right, !right_is_place, draft);
            if (!first.shifted && !second.shifted)
                first = copy(left, true, draft);
        }
        return {fmt::format("({} {} {})", first.words, op, second.words), first.shifted || second.shifted,
                first.covered + second.covered};
    }

    /// Returns whether a copy takes the value as it is, without repeating operations.
    bool is_operand(NodeId id) const {
        const NodeId inner = bare(id);
        return known_[inner] || is_plain_place(inner) || !is_repeatable(inner);
    }

    /// Returns whether the node is an operation of the line, or has no work of its own.
    bool is_repeatable(NodeId id) const {
        if (counted_.repeated[id] || calls_authors_function(text_, facts_, id) || is_change(text_, id) ||
            tree_[id].kind == NodeKind::comma)
            return false;
        const NodeKind kind = tree_[id].kind;
        if (kind == NodeKind::member || kind == NodeKind::parenthesis)
            return true;
        if (kind == NodeKind::call)
            return is_on_line(id) ||
                   (counted_.own[id] == 0 && tree_[tree_.child(id, 0)].kind == NodeKind::name);
        return (kind == NodeKind::binary || kind == NodeKind::prefix || kind == NodeKind::conditional) &&
               is_on_line(id);
    }

    Copy copy(NodeId id, bool shift, Draft& draft) {
        const NodeKind kind = tree_[id].kind;
        if (kind == NodeKind::parenthesis)
            return copy(tree_.child(id, 0), shift, draft);
        if (known_[id] || kind == NodeKind::literal || is_sampler_name(id))
            return {"(" + words_of(text_, id) + ")"};
        if (is_plain_place(id))
            return operand(id, words_of(text_, id), shift, draft);
        if (!is_repeatable(id))
            return saved(id, shift, draft);
        Copy result = rebuilt(id, shift, draft);
        if (is_on_line(id))
            result.covered += counted_.own[id];
        return result;
    }

    bool is_sampler_name(NodeId id) const { return is_plain_place(id) && is_sampler(id); }

    Copy operand(NodeId id, const std::string& words, bool shift, Draft& draft) const {
        if (!shift || (tree_[bare(id)].kind == NodeKind::name && counters_.contains(text_.word_of(bare(id)))))
            return {"(" + words + ")"};
        const auto type = expression_type(text_, facts_, id);
        if (type && type->base == 'b')
            return {"(" + words + ")"};
        std::string shifted = fmt::format("{}shift({})", prefix_, words);
        draft.shifted.insert(shifted);
        return {std::move(shifted), true};
    }

    /// Returns the value that the first computation has of the node, kept in a variable.
    Copy saved(NodeId id, bool shift, Draft& draft) {
        const auto known = std::ranges::find(draft.saved, id, &std::pair<NodeId, std::string>::first);
        if (known != draft.saved.end())
            return operand(id, known->second, shift, draft);
        const auto type = expression_type(text_, facts_, id);
        if (!type) {
            draft.possible = false;
            return {};
        }
        std::string name = fmt::format("{}t{}", prefix_, variables_++);
        temporaries_ += fmt::format("{} {};\n", to_string(*type), name);
        draft.saved.emplace_back(id, name);
        return operand(id, name, shift, draft);
    }

    Copy rebuilt(NodeId id, bool shift, Draft& draft) {
        switch (tree_[id].kind) {
        case NodeKind::binary:
            return operation(tree_.child(id, 0), text_.word_of(id), tree_.child(id, 1), draft);
        case NodeKind::prefix: {
            Copy inner = copy(tree_.child(id, 0), shift, draft);
            inner.words = fmt::format("({}{})", text_.word_of(id), inner.words);
            return inner;
        }
        case NodeKind::member: {
            Copy inner = copy(tree_.child(id, 0), shift, draft);
            inner.words += fmt::format(".{}", text_.word_of(id));
            return inner;
        }
        case NodeKind::conditional: {
            const Copy condition = copy(tree_.child(id, 0), true, draft);
            const Copy yes = copy(tree_.child(id, 1), true, draft),
                       no = copy(tree_.child(id, 2), true, draft);
            return {fmt::format("({} ? {} : {})", condition.words, yes.words, no.words),
                    condition.shifted || yes.shifted || no.shifted,
                    condition.covered + yes.covered + no.covered};
        }
        default: return rebuilt_call(id, shift, draft);
        }
    }

    Copy rebuilt_call(NodeId id, bool shift, Draft& draft) {
        const std::string_view name = called_name(text_, id);
        const bool one = needs_one_operand(name);
        const bool constructs = counted_.own[id] == 0;
        Copy result;
        std::string arguments;
        for (size_t i = 1; i < tree_.child_count(id); ++i) {
            const NodeId child = tree_.child(id, i);
            const bool wanted = constructs ? shift : !one || !result.shifted || !is_operand(child);
            const Copy each = copy(child, wanted, draft);
            arguments += (i == 1 ? "" : ", ") + each.words;
            result.shifted = result.shifted || each.shifted;
            result.covered += each.covered;
        }
        result.words = fmt::format("{}({})", name, arguments);
        return result;
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    const WorkText& counted_;
    const SourceLocation& place_;
    std::vector<bool> known_;
    std::string prefix_;
    std::set<std::string_view> counters_;         ///< variables of heads of loops, which compilers may know
    std::map<NodeId, std::vector<Around>> wraps_; ///< inner ones first
    std::string temporaries_;
    int variables_ = 0;
    LineTwice result_;
};

} // namespace

Result<LineTwice> do_line_twice(const ParsedText& text, const TreeFacts& facts, const WorkText& counted,
                                const SourceLocation& place, const WorkWeights& weights) {
    return TwiceWriter(text, facts, counted, place, !weights.device.empty()).run();
}

std::string do_no_line_twice(const ParsedText& text) {
    return headers_of(text) + SourceRewriter(text).text();
}

} // namespace tidemark::glsl
