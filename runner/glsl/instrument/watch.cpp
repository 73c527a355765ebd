#include "glsl/instrument/watch.hpp"

#include "glsl/analysis/call_paths.hpp"
#include "glsl/analysis/float_operation.hpp"
#include "glsl/instrument/source_rewriter.hpp"
#include "glsl/instrument/watch_prelude.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace tidemark::glsl {
namespace {

bool contains(const std::vector<NodeId>& ids, NodeId id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

/// Limit of the iterations of all loops of a pixel with repaired values: a loop that a NaN or an infinity
/// ended may not end without it, and not every driver stops it.
constexpr int k_most_iterations = 1'000'000;

class Watcher {
public:
    Watcher(const ParsedText& text, const TreeFacts& facts, const WatchRequest& request)
        : text_(text), tree_(text.tree()), facts_(facts), request_(request), prefix_(fresh_prefix(text)),
          edits_(text) {
        if (request.capture != k_no_node) {
            result_.operands = operands_of(request.capture);
            call_paths_ = find_call_paths(text, facts, request.capture);
            result_.loops = call_paths_.loops;
            result_.loops.resize(std::min(result_.loops.size(), WatchLayout::k_most_loops));
        }
        options_ = {prefix_,
                    request.capture != k_no_node,
                    !request.repaired.empty(),
                    request.nan_only,
                    text.headers().find("#version 450") != std::string::npos,
                    result_.loops.size()};
    }

    Watch run() {
        for (const NodeId part : tree_.children(0))
            global(part);
        result_.text = headers_with_buffers(text_) + watch_prelude(options_) + edits_.text() +
                       fmt::format("\nvoid main(){{{}main();{}}}\n", prefix_, flush());
        return std::move(result_);
    }

private:
    /// Whether an enclosing expression is already watched.
    enum class Cover { open, covered };

    std::string ours(std::string_view name) const { return prefix_ + std::string(name); }

    std::string flush() const {
        if (request_.map_width > 0)
            return fmt::format("{0}out[int(gl_FragCoord.x)+{1}*int(gl_FragCoord.y)]=uint({0}h);", prefix_,
                               request_.map_width);
        return fmt::format("{0}out[{1}]=1u;{0}out[{2}]=uint({0}h);", prefix_, WatchLayout::k_arrived,
                           WatchLayout::k_hit);
    }

    // Declarations.

    void global(NodeId id) {
        if (tree_[id].kind == NodeKind::function && text_.word_of(id) == "main")
            edits_.replace(tree_[id].word, ours("main"));
        visit(id, Cover::open);
        for (const NodeId child : tree_.children(id))
            if (tree_[child].kind == NodeKind::type && tree_[id].kind != NodeKind::function)
                structure_functions(id, child);
    }

    void structure_functions(NodeId declaration, NodeId type) {
        const std::string_view name = type_name(text_, type);
        const auto structure = facts_.structures.find(name);
        if (tree_.child(type, 0) == k_no_node || structure == facts_.structures.end())
            return;
        for (const StructureMember& member : structure->second)
            if (class_of_type(member.type) == TypeClass::sampler)
                return;
        edits_.wrap(declaration, "", "\n" + structure_overloads(options_, facts_, name));
    }

    // Everything else. Inner nodes are wrapped before outer ones.

    void children(NodeId id, Cover cover) {
        for (const NodeId child : tree_.children(id))
            visit(child, cover);
    }

    void visit(NodeId id, Cover cover) {
        switch (tree_[id].kind) {
        case NodeKind::type:
        case NodeKind::structure:
        case NodeKind::parameter:
        case NodeKind::label:
        case NodeKind::postfix: return; // constant, or its operand must stay as it is
        case NodeKind::prefix: return is_change(text_, id) ? void() : children(id, cover);
        case NodeKind::declaration: return declaration(id);
        case NodeKind::declarator: return declarator(id);
        case NodeKind::call: return call(id, cover);
        case NodeKind::binary: return binary(id, cover);
        case NodeKind::assign: return assign(id);
        case NodeKind::comma: return comma(id, cover);
        case NodeKind::jump: return jump(id);
        case NodeKind::loop_for:
        case NodeKind::loop_while:
        case NodeKind::loop_do: return loop(id);
        default: return children(id, cover);
        }
    }

    void declaration(NodeId id) {
        const NodeId type = tree_.child(id, 0);
        const bool constant = has_qualifier(text_, type, "const") || has_qualifier(text_, type, "uniform");
        const bool es_global = tree_[id].parent == 0 && text_.is_es();
        if (!constant && !es_global)
            children(id, Cover::open);
    }

    /// The value may be watched; brackets must stay constant.
    void declarator(NodeId id) {
        for (const NodeId part : tree_.children(id))
            if (!is_bracket(text_, part))
                visit(part, Cover::open);
    }

    bool wanted(NodeId id, Cover cover) const {
        if (contains(request_.repaired, id) || !is_float_operation(text_, facts_, id))
            return false;
        switch (request_.reach) {
        case WatchRequest::Reach::statements: return cover == Cover::open;
        case WatchRequest::Reach::operations: return tree_.is_within(id, request_.within);
        case WatchRequest::Reach::everything: return true;
        }
        return false;
    }

    Cover inside(NodeId id, Cover cover) const {
        return wanted(id, cover) ? Cover::covered : contains(request_.repaired, id) ? Cover::open : cover;
    }

    void lead(NodeId id, Cover cover) {
        if (wanted(id, cover))
            edits_.wrap(id, ours("P("), fmt::format(",{})", id));
        else if (contains(request_.repaired, id))
            edits_.wrap(id, ours("R("), ")");
    }

    void binary(NodeId id, Cover cover) {
        operand(id, tree_.child(id, 0), inside(id, cover));
        operand(id, tree_.child(id, 1), inside(id, cover));
        lead(id, cover);
    }

    /// Returns the buffer index where an operand of the captured node is recorded.
    std::optional<size_t> slot_of(NodeId operation, NodeId operand) const {
        const auto slot = std::ranges::find(result_.operands, operand);
        if (operation != request_.capture || slot == result_.operands.end())
            return std::nullopt;
        return WatchLayout::k_operands + size_t(slot - result_.operands.begin()) * WatchLayout::k_slot;
    }

    void operand(NodeId operation, NodeId id, Cover cover) {
        visit(id, cover);
        if (const auto slot = slot_of(operation, id))
            edits_.wrap(id, ours("C("), fmt::format(",{})", *slot));
    }

    void call(NodeId id, Cover cover) {
        const std::string_view name = called_name(text_, id);
        // Arguments of an author's function are watched before the call, because inside it they have no
        // statement.
        arguments(id, facts_.function(name) ? Cover::open : inside(id, cover));
        lead(id, cover);
        if (!std::ranges::binary_search(call_paths_.calls, id))
            return;
        if (facts_.functions.at(name).returns_nothing)
            edits_.wrap(id, fmt::format("({}push({}),", prefix_, id), fmt::format(",{}pop())", prefix_));
        else
            edits_.wrap(id, fmt::format("{0}K({0}push({1}),", prefix_, id), ")");
    }

    void arguments(NodeId id, Cover cover) {
        const NodeId callee = tree_.child(id, 0);
        const std::string_view name = called_name(text_, id);
        if (tree_[callee].kind == NodeKind::member) // .length()
            return;
        size_t index = 0;
        for (NodeId part = tree_[callee].next; part != k_no_node; part = tree_[part].next, ++index)
            if (name.empty() || !facts_.writes_argument(name, index))
                operand(id, part, cover);
    }

    /// Rewrites `target op= value` as `(target op= value, P(target))` if the target can be read once more.
    void assign(NodeId id) {
        const NodeId target = tree_.child(id, 0);
        const bool compound = is_float_operation(text_, facts_, id);
        const bool probed = compound && wanted(id, Cover::open);
        const bool mended = compound && contains(request_.repaired, id);
        operand(id, tree_.child(id, 1), probed ? Cover::covered : Cover::open);
        const std::string again = words_of(text_, target);
        if (mended) {
            edits_.wrap(id, "(", fmt::format(",{0}={1}R({0}))", again, prefix_));
        } else if (probed) {
            const auto slot = slot_of(id, target);
            edits_.wrap(id, slot ? fmt::format("({}C({},{}),", prefix_, again, *slot) : "(",
                        fmt::format(",{}P({},{}))", prefix_, again, id));
        }
    }

    /// Watches the first operand on its own: its value is dropped and reaches no other probe.
    void comma(NodeId id, Cover cover) {
        visit(tree_.child(id, 0), Cover::open);
        visit(tree_.child(id, 1), cover);
    }

    void jump(NodeId id) {
        if (text_.word_of(id) == "discard")
            edits_.wrap(id, "{" + flush(), "}");
    }

    void loop(NodeId id) {
        children(id, Cover::open);
        const NodeId body = tree_[id].kind == NodeKind::loop_do    ? tree_.child(id, 0)
                            : tree_[id].kind == NodeKind::loop_for ? tree_.child(id, 3)
                                                                   : tree_.child(id, 1);
        if (!request_.repaired.empty())
            edits_.wrap(body, fmt::format("{{if(++{}iterations>{})break;", prefix_, k_most_iterations), "}");
        const auto counted = std::ranges::find(result_.loops, id);
        if (counted == result_.loops.end())
            return;
        const auto index = counted - result_.loops.begin();
        edits_.wrap(body, fmt::format("{{if({0}h==0)++{0}L{1};", prefix_, index), "}");
        edits_.wrap(id, fmt::format("{{if({0}h==0){0}L{1}=0;", prefix_, index), "}");
    }

    /// Returns the operands that can be recorded: not literals, samplers or operands that are written to.
    std::vector<NodeId> operands_of(NodeId id) const {
        std::vector<NodeId> found;
        const auto add = [&](NodeId operand) {
            if (tree_[operand].kind == NodeKind::literal || found.size() == WatchLayout::k_most_operands)
                return;
            if (tree_[operand].kind == NodeKind::name) {
                const auto name = facts_.names.find(text_.word_of(operand));
                if (name != facts_.names.end() && (name->second.sampler || name->second.array))
                    return;
            }
            found.push_back(operand);
        };
        const std::string_view name = called_name(text_, id);
        if (tree_[id].kind == NodeKind::call && facts_.function(name))
            return found; // its arguments may be of any type
        NodeId part = tree_.child(id, 0);
        size_t index = 0;
        if (tree_[id].kind == NodeKind::call)
            part = tree_[part].next;
        for (; part != k_no_node; part = tree_[part].next, ++index) {
            const bool first_is_sampler = index == 0 && name.starts_with("texture");
            const bool texel = index == 0 && name.starts_with("texel");
            if (!first_is_sampler && !texel && !(!name.empty() && facts_.writes_argument(name, index)))
                add(part);
        }
        return found;
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    const WatchRequest& request_;
    std::string prefix_;
    PreludeOptions options_;
    CallPaths call_paths_;
    Watch result_;
    SourceRewriter edits_;
};

} // namespace

Watch watch(const ParsedText& text, const TreeFacts& facts, const WatchRequest& request) {
    return Watcher(text, facts, request).run();
}

} // namespace tidemark::glsl
