#include "glsl/specialise/specialise.hpp"

#include "glsl/specialise/constant_folding.hpp"
#include "glsl/specialise/globals.hpp"
#include "glsl/specialise/loop_invariant_code_motion.hpp"
#include "glsl/syntax/tree_facts.hpp"
#include "glsl/syntax/word_edits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::glsl {
namespace {

/// Returns a value as text that GLSL reads back to the same bits.
std::optional<std::string> spell(const scene::Knob& knob) {
    const scene::KnobTypeInfo& type = scene::info(knob.type);
    std::string numbers;
    for (int i = 0; i < type.components; ++i) {
        const double number = knob.value[size_t(i)];
        if (!std::isfinite(float(number)))
            return std::nullopt;
        numbers += i > 0 ? ", " : "";
        numbers += type.whole ? fmt::format("int({})", number) : fmt::format("{:#.9g}", float(number));
    }
    return fmt::format("{}({})", type.glsl_name, numbers);
}

class Specialiser {
public:
    Specialiser(const ParsedText& text, std::span<const scene::Knob> knobs, Specialise how)
        : text_(text), tree_(text.tree()), knobs_(knobs), how_(how), globals_(find_globals(text)),
          gone_(text.words().size(), false), edits_(text) {}

    Specialised run() {
        LeftOut done;
        if (how_ == Specialise::constants)
            done.constants = settle_knobs();
        if (how_ >= Specialise::invariant_uniforms)
            done.branches = eliminate_dead_branches();
        const std::vector<bool> reached = remove_unreached();
        if (how_ >= Specialise::invariant_uniforms && may_compute_first())
            done.loop_invariants = move_loop_invariants(text_, globals_, reached, gone_, edits_);
        done.lines = edits_.emptied_lines();
        done.kept_whole = edits_.empty() ? "there is nothing to leave out" : "";
        return {edits_.empty() ? text_.source() : edits_.apply(), std::move(done)};
    }

private:
    /// Desktop GLSL allows a global variable to start with a value that is not constant.
    bool may_compute_first() const { return !text_.is_es(); }

    bool remove(size_t begin, size_t end, std::string_view replacement = {}) {
        if (!edits_.stands_alone(begin, end))
            return false;
        edits_.replace(begin, end, replacement);
        std::fill(gone_.begin() + long(begin), gone_.begin() + long(end), true);
        return true;
    }

    int settle_knobs() {
        int count = 0;
        for (const Global& global : globals_) {
            if (tree_[global.node].kind != NodeKind::declaration || global.names.size() != 1 ||
                !has_qualifier(text_, tree_.child(global.node, 0), "uniform"))
                continue;
            const auto knob = std::find_if(knobs_.begin(), knobs_.end(), [&](const scene::Knob& each) {
                return each.name == global.names[0];
            });
            const auto value = knob == knobs_.end() ? std::nullopt : spell(*knob);
            const Node& node = tree_[global.node];
            if (!value || !edits_.stands_alone(node.begin, node.end))
                continue;
            edits_.replace(
                node.begin, node.end,
                fmt::format("const {} {} = {};", scene::info(knob->type).glsl_name, knob->name, *value));
            ++count;
        }
        return count;
    }

    int eliminate_dead_branches() {
        const Variables variables = find_variables(text_, 1, NodeId(tree_.nodes.size() - 1));
        const ConstantFolding conditions(text_, variables, knobs_);
        int count = 0;
        for (auto id = NodeId(tree_.nodes.size()); id-- > 1;) { // parents first
            const bool branch =
                tree_[id].kind == NodeKind::if_else || tree_[id].kind == NodeKind::conditional;
            if (!branch || gone_[tree_[id].begin])
                continue;
            if (const auto outcome = conditions.outcome(tree_.child(id, 0)))
                count += tree_[id].kind == NodeKind::if_else ? close_if(id, *outcome) : choose(id, *outcome);
        }
        return count;
    }

    /// Keeps only the statement that runs; a declaration has a scope of its own there, so that `if` stays.
    bool close_if(NodeId id, bool outcome) {
        const Node& whole = tree_[id];
        const NodeId taken = tree_.child(id, outcome ? 1 : 2);
        if (taken == k_no_node)
            return remove(whole.begin, whole.end, ";");
        const Node& kept = tree_[taken];
        const bool has_else = kept.end < whole.end;
        if (kept.kind == NodeKind::declaration || !edits_.stands_alone(whole.begin, kept.begin) ||
            (has_else && !edits_.stands_alone(kept.end, whole.end)))
            return false;
        remove(whole.begin, kept.begin);
        if (has_else)
            remove(kept.end, whole.end);
        return true;
    }

    /// `condition ? a : b` has the common type of both, so only a part that is surely a float can replace it.
    bool choose(NodeId id, bool outcome) {
        const Node& whole = tree_[id];
        const NodeId taken = tree_.child(id, outcome ? 1 : 2);
        const Node& kept = tree_[taken];
        const bool behind = kept.end < whole.end;
        if (!is_surely_floating(taken) || !edits_.stands_alone(whole.begin, kept.begin) ||
            (behind && !edits_.stands_alone(kept.end, whole.end)))
            return false;
        remove(whole.begin, kept.begin);
        if (behind)
            remove(kept.end, whole.end);
        return true;
    }

    /// Returns whether the node is a float literal or constructor, which needs no parentheses either.
    bool is_surely_floating(NodeId id) const {
        if (tree_[id].kind == NodeKind::literal)
            return text_.word_of(id).find('.') != std::string_view::npos;
        const auto built =
            tree_[id].kind == NodeKind::call ? value_type(called_name(text_, id)) : std::nullopt;
        return built && built->base == 'f';
    }

    std::vector<bool> remove_unreached() {
        std::vector<bool> kept(globals_.size());
        for (size_t i = 0; i < globals_.size(); ++i) {
            const Node& node = tree_[globals_[i].node];
            kept[i] = globals_[i].root || !edits_.stands_alone(node.begin, node.end);
        }
        std::vector<bool> reached = find_reached(text_, globals_, gone_, kept);
        for (size_t i = 0; i < globals_.size(); ++i)
            if (!reached[i])
                edits_.remove(tree_[globals_[i].node].begin, tree_[globals_[i].node].end);
        return reached;
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    std::span<const scene::Knob> knobs_;
    Specialise how_;
    std::vector<Global> globals_;
    std::vector<bool> gone_; ///< tokens
    WordEdits edits_;
};

} // namespace

Specialised specialise(const text::MappedText& source, std::span<const scene::Knob> knobs, Specialise how) {
    if (how == Specialise::nothing)
        return {source};
    const auto text = ParsedText::read(source, {}, false);
    if (!text) {
        LeftOut nothing;
        nothing.kept_whole = to_string(text.error());
        return {source, std::move(nothing)};
    }
    return Specialiser(**text, knobs, how).run();
}

} // namespace tidemark::glsl
