#include "glsl/specialise/loop_invariant_code_motion.hpp"

#include "glsl/specialise/uniform_expressions.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

namespace tidemark::glsl {
namespace {

constexpr std::string_view k_hoisted = "tidemark_hoisted";
constexpr int k_most_hoisted = 256;
/// Longest chain of local variables whose values are local variables.
constexpr int k_longest_alias_chain = 60;

class Hoister {
public:
    Hoister(const ParsedText& text, const std::vector<Global>& globals, const std::vector<bool>& reached,
            const std::vector<bool>& gone, WordEdits& edits)
        : text_(text), tree_(text.tree()), globals_(globals), reached_(reached), gone_(gone), edits_(edits),
          expressions_(text, globals) {
        for (const MacroLine& macro : text.preprocessed().macros)
            macros_.insert(macro.name);
    }

    int run() {
        find_hot_functions();
        for (size_t i = 0; i < globals_.size(); ++i)
            if (reached_[i] && tree_[globals_[i].node].kind == NodeKind::function &&
                edits_.begins_alone(tree_[globals_[i].node].begin))
                hoist_from(globals_[i]);
        return count_;
    }

private:
    bool is_gone(NodeId id) const { return !gone_.empty() && gone_[tree_[id].begin]; }

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
                if (tree_[id].kind != NodeKind::call || is_gone(id))
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
        aliases_.clear();
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
        if (!is_expression(tree_[id].kind) || is_gone(id))
            return false;
        const auto value = expressions_.value(id);
        return value && value->uniform && value->costly && (hot || is_in_loop(id)) &&
               edits_.stands_alone(tree_[id].begin, tree_[id].end);
    }

    /// Returns false if the expression cannot be written before its function.
    bool hoist_one(NodeId id) {
        const std::optional<std::string> name = declare(expressions_.value(id)->type, id);
        if (!name)
            return false;
        edits_.replace(tree_[id].begin, tree_[id].end, *name);
        ++count_;
        return true;
    }

    std::optional<std::string> declare(const ValueType& type, NodeId value) {
        const std::optional<std::string> spelled = spell(value);
        const std::string type_word = to_string(type);
        if (!spelled || macros_.contains(type_word))
            return std::nullopt;
        std::string name = fmt::format("{}{}", k_hoisted, variables_++);
        declarations_ += fmt::format("{} {} = {}; ", type_word, name, *spelled);
        return name;
    }

    /// Returns the text of an expression, with hoisted variables in place of local ones. Returns nothing if a
    /// token is the name of a macro, which would expand it.
    std::optional<std::string> spell(NodeId id) {
        std::string spelled;
        for (size_t i = tree_[id].begin; i < tree_[id].end; ++i) {
            const Word& word = text_.words()[i];
            const bool member = i > tree_[id].begin && text_.words()[i - 1].is(".");
            if (word.kind == text::TokenKind::identifier && macros_.contains(word.text))
                return std::nullopt;
            const auto* alias =
                word.kind == text::TokenKind::identifier && !member ? expressions_.alias(word.text) : nullptr;
            const std::optional<std::string> text =
                alias ? hoisted_alias(word.text, *alias) : std::string(word.text);
            if (!text)
                return std::nullopt;
            spelled += (spelled.empty() ? "" : " ") + *text;
        }
        return spelled;
    }

    std::optional<std::string> hoisted_alias(std::string_view name, const UniformExpressions::Alias& alias) {
        const auto known = aliases_.find(name);
        if (known != aliases_.end())
            return known->second;
        if (aliases_open_ >= k_longest_alias_chain)
            return std::nullopt;
        ++aliases_open_;
        auto declared = declare(alias.type, alias.value);
        --aliases_open_;
        aliases_.emplace(name, declared);
        return declared;
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const std::vector<Global>& globals_;
    const std::vector<bool>& reached_;
    const std::vector<bool>& gone_;
    WordEdits& edits_;
    UniformExpressions expressions_;
    std::unordered_set<std::string_view> macros_;
    std::unordered_set<std::string_view> hot_;
    std::string declarations_; ///< to insert before the current function
    std::unordered_map<std::string_view, std::optional<std::string>> aliases_; ///< of the current function
    int count_ = 0;
    int variables_ = 0;
    int aliases_open_ = 0; ///< number of aliases whose values are being spelled
};

} // namespace

int move_loop_invariants(const ParsedText& text, const std::vector<Global>& globals,
                         const std::vector<bool>& reached, const std::vector<bool>& gone, WordEdits& edits) {
    return Hoister(text, globals, reached, gone, edits).run();
}

} // namespace tidemark::glsl
