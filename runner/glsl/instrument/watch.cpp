#include "glsl/instrument/watch.hpp"

#include "glsl/analysis/call_paths.hpp"
#include "glsl/analysis/float_operation.hpp"
#include "glsl/instrument/source_rewriter.hpp"
#include "glsl/instrument/watch_prelude.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::glsl {
namespace {

bool contains(const std::vector<NodeId>& ids, NodeId id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

class Watcher {
public:
    Watcher(const ParsedText& text, const TreeFacts& facts, const WatchRequest& request)
        : text_(text), tree_(text.tree()), facts_(facts), request_(request), prefix_(fresh_prefix(text)) {
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
        result_.text = headers_with_buffers(text_) + watch_prelude(options_);
        for (NodeId part = tree_[0].first_child; part != k_no_node; part = tree_[part].next)
            global(part);
        result_.text += main_function();
        return std::move(result_);
    }

private:
    /// Whether what is around is led through us already.
    enum class Cover { open, covered };

    void put(std::string_view words) {
        result_.text += words;
        result_.text += ' ';
    }
    void put_words(size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            put(text_.word(i));
            if (text_.word(i) == ";" || text_.word(i) == "{")
                result_.text.back() = '\n';
        }
    }
    std::string ours(std::string_view name) const { return prefix_ + std::string(name); }

    std::string main_function() const {
        std::string text = fmt::format("\nvoid main(){{{}main();{}}}\n", prefix_, flush());
        return text;
    }

    std::string flush() const {
        if (request_.map_width > 0)
            return fmt::format("{0}out[int(gl_FragCoord.x)+{1}*int(gl_FragCoord.y)]=uint({0}h);", prefix_,
                               request_.map_width);
        return fmt::format("{0}out[{1}]=1u;{0}out[{2}]=uint({0}h);", prefix_, WatchLayout::k_arrived,
                           WatchLayout::k_hit);
    }

    // Declarations.

    void global(NodeId id) {
        if (tree_[id].kind == NodeKind::function)
            return function(id);
        emit(id, Cover::open);
        result_.text += '\n';
        for (NodeId child = tree_[id].first_child; child != k_no_node; child = tree_[child].next)
            if (tree_[child].kind == NodeKind::type)
                structure_functions(child);
    }

    void structure_functions(NodeId type) {
        const std::string_view name = type_name(text_, type);
        const auto structure = facts_.structures.find(name);
        if (tree_.child(type, 0) == k_no_node || structure == facts_.structures.end())
            return;
        for (const StructureMember& member : structure->second)
            if (class_of_type(member.type) == TypeClass::sampler)
                return;
        result_.text += structure_overloads(options_, facts_, name);
    }

    void function(NodeId id) {
        const Node& node = tree_[id];
        const bool is_main = text_.word_of(id) == "main";
        const NodeId body = body_of(id);
        put_words(node.begin, node.word);
        put(is_main ? ours("main") : text_.word_of(id));
        if (body == k_no_node) {
            put_words(node.word + 1, node.end);
            return;
        }
        put_words(node.word + 1, tree_[body].begin);
        put("{\n");
        children(body, tree_[body].begin + 1, Cover::open);
        result_.text += '\n';
    }

    NodeId body_of(NodeId function) const {
        for (NodeId part = tree_[function].first_child; part != k_no_node; part = tree_[part].next)
            if (tree_[part].kind == NodeKind::block)
                return part;
        return k_no_node;
    }

    // Everything else: what stands between the children is copied, and most nodes need no more.

    void children(NodeId id, size_t from, Cover cover) {
        size_t copied = from;
        for (NodeId child = tree_[id].first_child; child != k_no_node; child = tree_[child].next) {
            put_words(copied, tree_[child].begin);
            emit(child, cover);
            copied = tree_[child].end;
        }
        put_words(copied, tree_[id].end);
    }

    void raw(NodeId id) { put_words(tree_[id].begin, tree_[id].end); }

    void emit(NodeId id, Cover cover) {
        const Node& node = tree_[id];
        switch (node.kind) {
        case NodeKind::type:
        case NodeKind::structure:
        case NodeKind::parameter:
        case NodeKind::label:
        case NodeKind::prefix:
        case NodeKind::postfix: return prefix_or_raw(id, cover);
        case NodeKind::declaration: return declaration(id);
        case NodeKind::declarator: return declarator(id);
        case NodeKind::call: return call(id, cover);
        case NodeKind::binary: return binary(id, cover);
        case NodeKind::assign: return assign(id, cover);
        case NodeKind::comma: return comma(id, cover);
        case NodeKind::jump: return jump(id);
        case NodeKind::loop_for:
        case NodeKind::loop_while:
        case NodeKind::loop_do: return loop(id);
        default: return children(id, node.begin, cover);
        }
    }

    /// ++ and -- need their operand as it is; what else comes here must stay constant.
    void prefix_or_raw(NodeId id, Cover cover) {
        const std::string_view op = text_.word_of(id);
        if (tree_[id].kind == NodeKind::prefix && op != "++" && op != "--")
            children(id, tree_[id].begin, cover);
        else
            raw(id);
    }

    void declaration(NodeId id) {
        const NodeId type = tree_.child(id, 0);
        const bool constant = has_qualifier(text_, type, "const") || has_qualifier(text_, type, "uniform");
        const bool es_global = tree_[id].parent == 0 && text_.is_es();
        if (constant || es_global)
            raw(id);
        else
            children(id, tree_[id].begin, Cover::open);
    }

    /// The value may be watched; brackets must stay constant.
    void declarator(NodeId id) {
        size_t copied = tree_[id].begin;
        for (NodeId part = tree_[id].first_child; part != k_no_node; part = tree_[part].next) {
            if (is_bracket(text_, part))
                continue;
            put_words(copied, tree_[part].begin);
            emit(part, Cover::open);
            copied = tree_[part].end;
        }
        put_words(copied, tree_[id].end);
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

    /// Opens what leads `id` through us; how many parentheses are to be closed by `close`.
    Cover open(NodeId id, Cover cover) {
        if (wanted(id, cover)) {
            put(ours("P("));
            return Cover::covered;
        }
        if (contains(request_.repaired, id)) {
            put(ours("R("));
            return Cover::open;
        }
        return cover;
    }

    void close(NodeId id, Cover cover) {
        if (wanted(id, cover))
            put(fmt::format(",{})", id));
        else if (contains(request_.repaired, id))
            put(")");
    }

    void binary(NodeId id, Cover cover) {
        const Cover inside = open(id, cover);
        const NodeId left = tree_.child(id, 0);
        const NodeId right = tree_.child(id, 1);
        operand(id, left, inside);
        put_words(tree_[left].end, tree_[right].begin);
        operand(id, right, inside);
        close(id, cover);
    }

    /// An operand of the node that is captured is written down on its way.
    void operand(NodeId operation, NodeId id, Cover cover) {
        const auto slot = std::find(result_.operands.begin(), result_.operands.end(), id);
        const bool captured = operation == request_.capture && slot != result_.operands.end();
        if (captured)
            put(ours("C("));
        emit(id, cover);
        if (captured)
            put(fmt::format(",{})", WatchLayout::k_operands +
                                        size_t(slot - result_.operands.begin()) * WatchLayout::k_slot));
    }

    void call(NodeId id, Cover cover) {
        const std::string_view name = called_name(text_, id);
        const bool on_the_way = std::binary_search(call_paths_.calls.begin(), call_paths_.calls.end(), id);
        const bool nothing = on_the_way && facts_.functions.at(name).returns_nothing;
        if (on_the_way)
            put(nothing ? fmt::format("({}push({}),", prefix_, id)
                        : fmt::format("{0}K({0}push({1}),", prefix_, id));
        const Cover inside = open(id, cover);
        // What a function of the author's gets is watched before it goes in, for in there it has no
        // statement.
        arguments(id, facts_.function(name) ? Cover::open : inside);
        close(id, cover);
        if (on_the_way)
            put(nothing ? fmt::format(",{}pop())", prefix_) : std::string(")"));
    }

    void arguments(NodeId id, Cover cover) {
        const NodeId callee = tree_.child(id, 0);
        const std::string_view name = called_name(text_, id);
        if (tree_[callee].kind == NodeKind::member) // .length()
            return raw(id);
        put_words(tree_[callee].begin, tree_[callee].end);
        size_t copied = tree_[callee].end;
        size_t index = 0;
        for (NodeId part = tree_[callee].next; part != k_no_node; part = tree_[part].next, ++index) {
            put_words(copied, tree_[part].begin);
            if (!name.empty() && facts_.writes_argument(name, index))
                raw(part);
            else
                operand(id, part, cover);
            copied = tree_[part].end;
        }
        put_words(copied, tree_[id].end);
    }

    /// `target op= value` becomes `(target op= value, P(target))`, if the target can be read once more.
    void assign(NodeId id, Cover cover) {
        const NodeId target = tree_.child(id, 0);
        const NodeId value = tree_.child(id, 1);
        const bool compound = is_float_operation(text_, facts_, id);
        const bool probed = compound && wanted(id, Cover::open);
        const bool mended = compound && contains(request_.repaired, id);
        const Cover inside = probed ? Cover::covered : Cover::open;
        if (probed || mended)
            put("(");
        if (probed && id == request_.capture) {
            operand(id, target, cover);
            put(",");
        }
        raw(target);
        put_words(tree_[target].end, tree_[value].begin);
        operand(id, value, inside);
        if (!probed && !mended)
            return;
        put(",");
        if (mended) {
            raw(target);
            put(fmt::format("={}R(", prefix_));
        } else {
            put(ours("P("));
        }
        raw(target);
        put(mended ? std::string("))") : fmt::format(",{}))", id));
    }

    /// The value of the first is dropped: nobody else will see it.
    void comma(NodeId id, Cover cover) {
        const NodeId first = tree_.child(id, 0);
        const NodeId second = tree_.child(id, 1);
        emit(first, Cover::open);
        put_words(tree_[first].end, tree_[second].begin);
        emit(second, cover);
    }

    void jump(NodeId id) {
        if (text_.word_of(id) != "discard")
            return raw(id);
        put(fmt::format("{{{}discard;}}", flush()));
    }

    void loop(NodeId id) {
        const auto counted = std::find(result_.loops.begin(), result_.loops.end(), id);
        if (counted == result_.loops.end())
            return children(id, tree_[id].begin, Cover::open);
        const size_t index = size_t(counted - result_.loops.begin());
        const NodeId body = tree_[id].kind == NodeKind::loop_do    ? tree_.child(id, 0)
                            : tree_[id].kind == NodeKind::loop_for ? tree_.child(id, 3)
                                                                   : tree_.child(id, 1);
        put(fmt::format("{{if({0}h==0){0}L{1}=0;", prefix_, index));
        size_t copied = tree_[id].begin;
        for (NodeId part = tree_[id].first_child; part != k_no_node; part = tree_[part].next) {
            put_words(copied, tree_[part].begin);
            if (part == body)
                put(fmt::format("{{if({0}h==0)++{0}L{1};", prefix_, index));
            emit(part, Cover::open);
            if (part == body)
                put("}");
            copied = tree_[part].end;
        }
        put_words(copied, tree_[id].end);
        put("}");
    }

    /// What of an operation can be written down: no numbers of the text, no samplers, nothing that is written
    /// to.
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
};

} // namespace

Watch watch(const ParsedText& text, const TreeFacts& facts, const WatchRequest& request) {
    return Watcher(text, facts, request).run();
}

} // namespace tidemark::glsl
