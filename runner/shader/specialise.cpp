#include "shader/specialise.hpp"

#include "scene/knob.hpp"
#include "shader/parsed_text.hpp"
#include "shader/tree_facts.hpp"
#include "shader/uniform_expressions.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace tidemark::glsl {
namespace {

constexpr std::string_view k_hoisted = "tidemark_hoisted";
constexpr int k_most_hoisted = 256;
/// Longest expression that is moved, in characters.
constexpr size_t k_longest_hoisted = 1000;

/// Moves costly expressions of uniforms out of loops into global variables with a value, which are computed
/// once per pixel. llvmpipe does not do this itself.
class Hoister {
public:
    Hoister(const ParsedText& text, const std::vector<Global>& globals, const std::vector<bool>& reached,
            WordEdits& edits)
        : text_(text), tree_(text.tree()), globals_(globals), reached_(reached), edits_(edits),
          expressions_(text, globals) {
        for (const MacroLine& macro : text.preprocessed().macros)
            macros_.insert(macro.name);
    }

    /// Returns the number of moved expressions.
    int run() {
        find_hot_functions();
        for (size_t i = 0; i < globals_.size(); ++i)
            if (reached_[i] && tree_[globals_[i].node].kind == NodeKind::function &&
                edits_.begins_alone(tree_[globals_[i].node].begin))
                hoist_from(globals_[i]);
        return count_;
    }

private:
    /// Returns whether the node is in a loop of its own function.
    bool is_in_loop(NodeId id) const {
        for (NodeId child = id, around = tree_[id].parent; around != k_no_node;
             child = around, around = tree_[around].parent)
            if (is_loop(tree_[around].kind) &&
                !(tree_[around].kind == NodeKind::loop_for && tree_[around].first_child == child))
                return true;
        return false;
    }

    /// Finds functions that are called in a loop, and the functions that these call.
    void find_hot_functions() {
        std::unordered_map<std::string_view, std::vector<std::string_view>> calls;
        std::vector<std::string_view> open;
        for (size_t i = 0; i < globals_.size(); ++i) {
            const Global& global = globals_[i];
            if (!reached_[i] || tree_[global.node].kind != NodeKind::function)
                continue;
            for (NodeId id = global.first; id <= global.node; ++id) {
                if (tree_[id].kind != NodeKind::call)
                    continue;
                calls[global.names[0]].push_back(called_name(text_, id));
                if (is_in_loop(id))
                    open.push_back(called_name(text_, id));
            }
        }
        while (!open.empty()) {
            const std::string_view name = open.back();
            open.pop_back();
            if (hot_.insert(name).second)
                open.insert(open.end(), calls[name].begin(), calls[name].end());
        }
    }

    void hoist_from(const Global& function) {
        expressions_.enter(function);
        const bool hot = hot_.contains(function.names[0]);
        declarations_.clear();
        for (NodeId id = function.node; id >= function.first;) { // parents first
            if (count_ < k_most_hoisted && is_worth_it(id, hot) && hoist_one(id))
                id = first_inside(id);
            --id;
        }
        if (!declarations_.empty())
            edits_.insert(tree_[function.node].begin, declarations_);
    }

    /// Returns the node with the lowest number below `id`.
    NodeId first_inside(NodeId id) const {
        while (tree_[id].first_child != k_no_node)
            id = tree_[id].first_child;
        return id;
    }

    bool is_worth_it(NodeId id, bool hot) const {
        if (!is_expression(tree_[id].kind))
            return false;
        const auto value = expressions_.value(id);
        return value && value->uniform && value->costly && (hot || is_in_loop(id)) &&
               edits_.stands_alone(tree_[id].begin, tree_[id].end);
    }

    /// Returns false if the expression cannot be written before its function.
    bool hoist_one(NodeId id) {
        const auto is_macro = [&](std::string_view name, bool) { return macros_.contains(name); };
        const std::string type = to_string(expressions_.value(id)->type);
        const auto spelled = expressions_.spelled(id, k_longest_hoisted, is_macro);
        if (!spelled || macros_.contains(type))
            return false;
        const std::string name = fmt::format("{}{}", k_hoisted, count_++);
        declarations_ += fmt::format("{} {} = {}; ", type, name, *spelled);
        edits_.replace(tree_[id].begin, tree_[id].end, name);
        return true;
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const std::vector<Global>& globals_;
    const std::vector<bool>& reached_;
    WordEdits& edits_;
    UniformExpressions expressions_;
    std::unordered_set<std::string_view> macros_;
    std::unordered_set<std::string_view> hot_;
    std::string declarations_; ///< to insert before the current function
    int count_ = 0;
};

/// Returns a value as text that GLSL reads back to the same bits.
std::optional<std::string> value_text(const scene::Knob& knob) {
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
          edits_(text) {}

    Specialised run() {
        LeftOut done;
        if (how_ == Specialise::constants)
            done.constants = settle_knobs();
        const std::vector<bool> reached = remove_unreached();
        // Desktop GLSL allows a global variable to start with a value that is not constant.
        if (how_ >= Specialise::invariant_uniforms && !text_.is_es())
            done.loop_invariants = Hoister(text_, globals_, reached, edits_).run();
        done.lines = edits_.emptied_lines();
        done.kept_whole = edits_.empty() ? "there is nothing to leave out" : "";
        return {edits_.empty() ? text_.source() : edits_.apply(), std::move(done)};
    }

private:
    int settle_knobs() {
        int count = 0;
        for (const Global& global : globals_) {
            if (tree_[global.node].kind != NodeKind::declaration || global.names.size() != 1 ||
                !has_qualifier(text_, tree_.child(global.node, 0), "uniform"))
                continue;
            const auto knob = std::find_if(knobs_.begin(), knobs_.end(), [&](const scene::Knob& each) {
                return each.name == global.names[0];
            });
            const auto value = knob == knobs_.end() ? std::nullopt : value_text(*knob);
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

    std::vector<bool> remove_unreached() {
        std::vector<bool> kept(globals_.size());
        for (size_t i = 0; i < globals_.size(); ++i) {
            const Node& node = tree_[globals_[i].node];
            kept[i] = globals_[i].root || !edits_.stands_alone(node.begin, node.end);
        }
        std::vector<bool> reached = find_reached(text_, globals_, kept);
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
