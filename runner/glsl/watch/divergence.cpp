#include "glsl/watch/divergence.hpp"

#include <algorithm>
#include <optional>
#include <unordered_set>

namespace tidemark::glsl {
namespace {

using Names = std::unordered_set<std::string_view>;

bool takes_derivatives(std::string_view function) {
    return function.starts_with("dFd") || function.starts_with("fwidth");
}

/// Those that choose the mipmap by themselves.
bool chooses_mipmap(std::string_view function) {
    return function == "texture" || function == "textureOffset" || function == "textureProj" ||
           function == "textureProjOffset";
}

/// Finds what may differ between pixels: what is made of such values, or set where they decided the way.
class Parting {
public:
    Parting(const ParsedText& text, const TreeFacts& facts)
        : text_(text), tree_(text.tree()), facts_(facts), differs_(tree_.nodes.size(), false) {
        names_.insert("gl_FragCoord");
        while (round()) { // grows, and so ends
        }
    }

    /// The condition that parts pixels on their way to the node; k_no_node: the whole function is called so.
    std::optional<NodeId> parted(NodeId node) const {
        for (NodeId inner = node, outer = tree_[node].parent; inner != k_no_node;
             inner = outer, outer = tree_[outer].parent) {
            if (tree_[inner].kind == NodeKind::function)
                return parted_functions_.contains(text_.word_of(inner)) ? std::optional(k_no_node)
                                                                        : std::nullopt;
            if (const NodeId condition = condition_over(inner, outer);
                condition != k_no_node && (differs_[condition] || parted_loops_.contains(outer)))
                return condition;
        }
        return std::nullopt;
    }

private:
    /// Of `outer`, where it decides whether, or how often, its child `inner` is run.
    NodeId condition_over(NodeId inner, NodeId outer) const {
        const auto first = tree_.child(outer, 0);
        switch (tree_[outer].kind) {
        case NodeKind::if_else:
        case NodeKind::conditional:
        case NodeKind::switch_on:
        case NodeKind::loop_while: return inner == first ? k_no_node : first;
        case NodeKind::loop_for: return inner == first ? k_no_node : tree_.child(outer, 1);
        case NodeKind::loop_do: return tree_.child(outer, 1);
        case NodeKind::binary: {
            const std::string_view word = text_.word_of(outer);
            return inner != first && (word == "&&" || word == "||") ? first : k_no_node;
        }
        default: return k_no_node;
        }
    }

    /// Whether anything new was found. Children have the smaller numbers.
    bool round() {
        const size_t before = found();
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            differs_[id] = differs_by_itself(id);
            for (NodeId child = tree_[id].first_child; child != k_no_node; child = tree_[child].next)
                differs_[id] = differs_[id] || differs_[child];
        }
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            note(id);
        return found() > before;
    }

    size_t found() const {
        return names_.size() + functions_.size() + parted_functions_.size() + parted_loops_.size();
    }

    bool differs_by_itself(NodeId id) const {
        if (tree_[id].kind == NodeKind::name)
            return names_.contains(text_.word_of(id));
        return tree_[id].kind == NodeKind::call && functions_.contains(called_name(text_, id));
    }

    void note(NodeId id) {
        const NodeId first = tree_.child(id, 0);
        switch (tree_[id].kind) {
        case NodeKind::assign:
            if (differs_[id] || parted(id))
                names_.insert(base_of(first));
            return;
        case NodeKind::prefix:
        case NodeKind::postfix:
            if ((text_.word_of(id) == "++" || text_.word_of(id) == "--") && parted(id))
                names_.insert(base_of(first));
            return;
        case NodeKind::declarator:
            if (differs_[id] || (parted(id) && first != k_no_node))
                names_.insert(text_.word_of(id));
            return;
        case NodeKind::call: call(id); return;
        case NodeKind::give_back: leave(id, true); return;
        case NodeKind::jump: leave(id, text_.word_of(id) == "discard"); return;
        default: return;
        }
    }

    /// Arguments become parameters; what is written through one may be anything.
    void call(NodeId id) {
        const std::string_view name = called_name(text_, id);
        const FunctionFacts* function = name.empty() ? nullptr : facts_.function(name);
        if (function && parted(id))
            parted_functions_.insert(name);
        size_t index = 0;
        for (NodeId part = tree_[tree_.child(id, 0)].next; part != k_no_node;
             part = tree_[part].next, ++index) {
            if (!name.empty() && facts_.writes_argument(name, index) && (differs_[id] || function))
                names_.insert(base_of(part));
            if (function && differs_[part])
                for (const NodeId definition : function->definitions)
                    if (const NodeId parameter = tree_.child(definition, index + 1);
                        parameter != k_no_node && tree_[parameter].kind == NodeKind::parameter)
                        names_.insert(text_.word_of(parameter));
        }
    }

    /// A way out of loops, or of the function, that some pixels take.
    void leave(NodeId id, bool of_function) {
        const NodeId function = tree_.around(id, NodeKind::function);
        if (of_function && function != k_no_node && (differs_[id] || parted(id)))
            functions_.insert(text_.word_of(function));
        bool some = false;
        for (NodeId inner = id, outer = tree_[id].parent; inner != function && outer != k_no_node;
             inner = outer, outer = tree_[outer].parent) {
            const NodeId condition = condition_over(inner, outer);
            some = some || (condition != k_no_node && differs_[condition]);
            if (!is_loop(tree_[outer].kind))
                continue;
            if (some)
                parted_loops_.insert(outer);
            if (!of_function)
                return;
        }
    }

    /// The variable that `a[i].x` is a part of.
    std::string_view base_of(NodeId id) const {
        while (tree_[id].kind == NodeKind::member || tree_[id].kind == NodeKind::index ||
               tree_[id].kind == NodeKind::parenthesis)
            id = tree_.child(id, 0);
        return text_.word_of(id);
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    std::vector<bool> differs_; ///< expressions
    Names names_;               ///< of variables
    Names functions_;           ///< by what they give back
    Names parted_functions_;    ///< by where they are called
    std::unordered_set<NodeId> parted_loops_;
};

} // namespace

std::vector<Divergent> find_divergent(const ParsedText& text, const TreeFacts& facts,
                                      const std::function<bool(std::string_view sampler)>& has_mipmaps) {
    const SyntaxTree& tree = text.tree();
    const auto reached = functions_of_main(text, facts);
    const auto needs_neighbours = [&](NodeId call) {
        const std::string_view name = called_name(text, call);
        const NodeId sampler = tree.child(call, 1);
        return !facts.function(name) &&
               (takes_derivatives(name) ||
                (chooses_mipmap(name) && sampler != k_no_node && tree[sampler].kind == NodeKind::name &&
                 has_mipmaps(text.word_of(sampler))));
    };
    std::optional<Parting> parting; // most texts need none
    std::vector<Divergent> found;
    for (NodeId id = 1; id < tree.nodes.size(); ++id) {
        if (tree[id].kind != NodeKind::call || !needs_neighbours(id))
            continue;
        const NodeId function = tree.around(id, NodeKind::function);
        if (function == k_no_node || !reached.contains(text.word_of(function)))
            continue;
        if (!parting)
            parting.emplace(text, facts);
        if (const auto condition = parting->parted(id))
            found.push_back({id, *condition});
    }
    std::ranges::sort(found, {}, [&](const Divergent& each) { return tree[each.call].begin; });
    return found;
}

} // namespace tidemark::glsl
