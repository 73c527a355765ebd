#include "shader/loops.hpp"
#include "shader/source_edits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace tidemark::glsl {
namespace {

bool is_loop_node(NodeKind kind) {
    return kind == NodeKind::loop_for || kind == NodeKind::loop_while || kind == NodeKind::loop_do;
}

/// Adds up the iterations of the loops that a function runs, with those of the functions that it calls.
class Iterations {
public:
    Iterations(const ParsedText& text, const TreeFacts& facts) : text_(text), facts_(facts) {}

    double of_function(std::string_view name) {
        const FunctionFacts* const function = facts_.function(name);
        if (!function)
            return 0;
        const auto [known, is_new] = known_.try_emplace(name, 0.0); // 0 also ends a recursion
        if (!is_new)
            return known->second;
        double most = 0;
        for (const NodeId definition : function->definitions)
            most = std::max(most, of(definition));
        return known_[name] = most;
    }

private:
    double of(NodeId id) {
        const SyntaxTree& tree = text_.tree();
        double inside = 0;
        for (const NodeId child : tree.children(id))
            inside += of(child);
        if (tree[id].kind == NodeKind::call)
            return inside + of_function(called_name(text_, id));
        if (!is_loop_node(tree[id].kind))
            return inside;
        const auto bound = loop_bound(text_, id);
        const bool known = bound && bound->number != k_no_node;
        return known ? bound->turns * (1 + inside) : std::numeric_limits<double>::infinity();
    }

    const ParsedText& text_;
    const TreeFacts& facts_;
    std::unordered_map<std::string_view, double> known_;
};

/// A pixel has run at least so many iterations if the driver's limit ends a loop. Some drivers also unroll a
/// loop of floats with an iteration less than its sums make, which is no limit.
constexpr int k_fewest_of_a_limit = 32'767;

/// `@` is the number of loops.
constexpr std::string_view k_ends_prelude = R"(layout(std430,binding=0) buffer $Buffer{uint $out[];};
bool $open[@];
int $turns=0;
bool $counts(int i,bool goes_on){if(!goes_on)$out[2*i+1]=1u;return goes_on;}
)";

class EndRecorder {
public:
    EndRecorder(const ParsedText& text, const TreeFacts& facts)
        : text_(text), tree_(text.tree()), facts_(facts), prefix_(fresh_prefix(text)), edits_(text) {}

    LoopEnds run() {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            if (is_loop_node(tree_[id].kind))
                result_.loops.push_back(id);
        if (result_.loops.empty())
            return std::move(result_);
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) // inner nodes come before outer ones
            visit(id);
        result_.text = headers_with_buffers(text_) +
                       spell(k_ends_prelude, prefix_, fmt::format("{}", result_.loops.size())) +
                       edits_.text();
        return std::move(result_);
    }

private:
    size_t index_of(NodeId loop) const {
        return size_t(std::ranges::find(result_.loops, loop) - result_.loops.begin());
    }

    /// Returns the loop that a `break` or `return` leaves; k_no_node for that of a switch or outside loops.
    NodeId left_by(NodeId jump) const {
        const bool leaves_function = tree_[jump].kind == NodeKind::return_statement;
        for (NodeId id = tree_[jump].parent; id != k_no_node; id = tree_[id].parent) {
            if (is_loop_node(tree_[id].kind))
                return id;
            if (tree_[id].kind == NodeKind::function ||
                (tree_[id].kind == NodeKind::switch_on && !leaves_function))
                return k_no_node;
        }
        return k_no_node;
    }

    /// Returns whether an `if` between the jump and its loop tests an integer variable.
    bool tests_a_count(NodeId jump, NodeId loop) const {
        for (NodeId id = tree_[jump].parent; id != loop; id = tree_[id].parent)
            if (tree_[id].kind == NodeKind::if_else && has_count(tree_.child(id, 0)))
                return true;
        return false;
    }

    bool has_count(NodeId id) const {
        if (tree_[id].kind == NodeKind::name) {
            const auto name = facts_.names.find(text_.word_of(id));
            return name != facts_.names.end() && name->second.only_whole() && !name->second.uniform &&
                   !name->second.constant;
        }
        return std::ranges::any_of(tree_.children(id), [&](NodeId child) { return has_count(child); });
    }

    void visit(NodeId id) {
        const NodeKind kind = tree_[id].kind;
        if (is_loop_node(kind))
            return loop(id);
        const bool breaks = kind == NodeKind::jump && text_.word_of(id) == "break";
        if (!breaks && kind != NodeKind::return_statement)
            return;
        const NodeId left = left_by(id);
        if (left == k_no_node)
            return;
        const size_t index = index_of(left);
        edits_.wrap(
            id,
            fmt::format("{{{0}open[{1}]=false;{2}", prefix_, index,
                        tests_a_count(id, left) ? fmt::format("{}counts({},false);", prefix_, index) : ""),
            "}");
    }

    void loop(NodeId id) {
        const size_t index = index_of(id);
        if (const NodeId test = counter_test(text_, id); test != k_no_node)
            edits_.wrap(test, fmt::format("{}counts({},", prefix_, index), ")");
        if (const NodeId condition = loop_condition(text_, id);
            condition != k_no_node && is_expression(tree_[condition].kind))
            edits_.wrap(condition, fmt::format("({}open[{}]=(", prefix_, index), "))");
        const NodeId body = tree_[id].kind == NodeKind::loop_do    ? tree_.child(id, 0)
                            : tree_[id].kind == NodeKind::loop_for ? tree_.child(id, 3)
                                                                   : tree_.child(id, 1);
        edits_.wrap(body, fmt::format("{{{0}open[{1}]=true;++{0}turns;", prefix_, index), "}");
        edits_.wrap(id, fmt::format("{{{}open[{}]=false;", prefix_, index),
                    fmt::format("if({0}open[{1}]&&{0}turns>={3}){0}out[{2}]=1u;}}", prefix_, index,
                                LoopEnds::cut(index), k_fewest_of_a_limit));
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    std::string prefix_;
    SourceRewriter edits_;
    LoopEnds result_{};
};

} // namespace

double most_iterations(const ParsedText& text, const TreeFacts& facts) {
    return Iterations(text, facts).of_function("main");
}

LoopEnds record_loop_ends(const ParsedText& text, const TreeFacts& facts) {
    return EndRecorder(text, facts).run();
}

} // namespace tidemark::glsl
