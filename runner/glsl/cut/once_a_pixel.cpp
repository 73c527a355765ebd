#include "glsl/cut/once_a_pixel.hpp"

#include "glsl/specialise/uniform_expressions.hpp"
#include "glsl/syntax/word_edits.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::glsl {
namespace {

constexpr size_t k_longest = 160, k_most_values = 64;
/// Depth to which local variables are replaced by their values.
constexpr int k_longest_word_chain = 8;

struct SharedValue {
    std::string type, name, words;
};

class Finder {
public:
    Finder(const ParsedText& text, const TreeFacts& facts, const WorkEstimate& work)
        : text_(text), tree_(text.tree()), facts_(facts), work_(work), globals_(find_globals(text)),
          expressions_(text, globals_), edits_(text) {}

    std::optional<Cut> run() {
        if (!find_main() || runs_without_main())
            return std::nullopt;
        for (const Global& global : globals_)
            if (tree_[global.node].kind == NodeKind::function && global.node <= main_)
                look_at(global);
        return values_.empty() ? std::nullopt : cut();
    }

private:
    std::string file_of(NodeId id) const { return text_.used(tree_[id].begin).file; }

    bool find_main() {
        main_ = find_main_image(text_);
        if (main_ == k_no_node)
            return false;
        for (const NodeId parameter : parameters_of(text_, main_))
            parameters_.push_back(text_.word_of(parameter));
        return true;
    }

    /// Returns whether code runs before mainImage (a global's initialiser) or instead of it (mainHit).
    bool runs_without_main() const {
        const bool hits =
            std::ranges::any_of(text_.tokens(), [](const text::Token& token) { return token.is("mainHit"); });
        bool first = false;
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            first = first || (tree_[id].kind == NodeKind::call && facts_.function(called_name(text_, id)) &&
                              tree_.around(id, NodeKind::function) == k_no_node);
        return hits || first;
    }

    void look_at(const Global& function) {
        const Word& begin = text_.words()[tree_[function.node].begin];
        if (begin.from_macro() || file_of(function.node) != file_of(main_))
            return;
        expressions_.enter(function);
        std::vector<std::pair<NodeId, std::string>> taken;
        for (NodeId id = function.node; id >= function.first; --id) { // parents first
            const auto words = is_worth_it(id) ? said_in_main(id) : std::nullopt;
            if (!words)
                continue;
            taken.emplace_back(id, *words);
            while (tree_[id].first_child != k_no_node)
                id = tree_[id].first_child;
        }
        for (auto each = taken.rbegin(); each != taken.rend() && values_.size() < k_most_values; ++each)
            take(each->first, each->second, function.node);
    }

    bool is_worth_it(NodeId id) const {
        if (!is_expression(tree_[id].kind))
            return false;
        const auto value = expressions_.value(id);
        return value && value->uniform && value->costly && work_.of(id) >= 2 * work_.once(id) &&
               work_.once(id) > 0 && edits_.stands_alone(tree_[id].begin, tree_[id].end);
    }

    void take(NodeId id, const std::string& words, NodeId function) {
        const std::string type = to_string(expressions_.value(id)->type);
        auto known = std::ranges::find_if(
            values_, [&](const SharedValue& value) { return value.type == type && value.words == words; });
        if (known == values_.end())
            known = values_.insert(known, {type, next_name(), words});
        const auto [first, last] = edits_.tokens_of(tree_[id].begin, tree_[id].end);
        uses_.push_back(in_place_of(text_, {first, last}, known->name));
        if (first_function_ == k_no_node) {
            first_function_ = function;
            first_use_ = id;
        }
        saved_ += work_.of(id) - work_.once(id);
    }

    std::string next_name() {
        std::string name;
        do
            name = fresh_name(text_, "same_everywhere", ++last_name_);
        while (std::ranges::find(values_, name, &SharedValue::name) != values_.end());
        return name;
    }

    /// Returns the expression's text if it means the same in mainImage. Returns nothing if it cannot be
    /// written there or spans several lines.
    std::optional<std::string> said_in_main(NodeId id) {
        const auto [begin, end] = edits_.tokens_of(tree_[id].begin, tree_[id].end);
        const text::Token &first = text_.tokens()[begin], &last = text_.tokens()[end];
        auto words = spelled(id, 0);
        if (!words || first.line != last.line || file_of(id) != file_of(main_))
            return std::nullopt;
        bool as_written = true;
        for (size_t i = begin; i <= end; ++i) {
            const std::string_view token = text_.tokens()[i].text;
            as_written = as_written && !expressions_.alias(token) && token.find("/*") == token.npos &&
                         std::ranges::count(text_.preprocessed().macros, token, &MacroLine::name) <= 1;
        }
        return as_written ? text_.source().text().substr(first.begin, last.end() - first.begin) : words;
    }
    /// Returns the text of an expression with local variables replaced by their values.
    std::optional<std::string> spelled(NodeId id, int depth) {
        std::string words;
        for (size_t i = tree_[id].begin; i < tree_[id].end; ++i) {
            const Word& word = text_.words()[i];
            const bool member = i > tree_[id].begin && text_.words()[i - 1].is(".");
            const bool name = word.kind == text::TokenKind::identifier && !member;
            const auto* const alias = name ? expressions_.alias(word.text) : nullptr;
            const auto next = alias ? spelled(*alias, depth) : std::optional(std::string(word.text));
            if (!next || words.size() > k_longest || (name && std::ranges::count(parameters_, word.text) > 0))
                return std::nullopt;
            const bool apart = !words.empty() && words.back() == ',';
            const bool operation = i > tree_[id].begin && is_operation(i);
            words += (apart || operation ? " " : "") + *next + (operation ? " " : "");
        }
        return words;
    }
    std::optional<std::string> spelled(const UniformExpressions::Alias& alias, int depth) {
        const auto words = depth < k_longest_word_chain ? spelled(alias.value, depth + 1) : std::nullopt;
        const auto value = expressions_.value(alias.value);
        if (!words)
            return std::nullopt;
        return fmt::format("{}({})", value->type == alias.type ? "" : to_string(alias.type), *words);
    }
    /// Returns whether the token is an operator between two operands.
    bool is_operation(size_t word) const {
        const Word& before = text_.words()[word - 1];
        const bool ends_value =
            before.kind != text::TokenKind::punctuation || before.is(")") || before.is("]");
        return ends_value && text_.words()[word].text.size() == 1 &&
               std::string_view("+-*/").find(text_.words()[word].text) != std::string_view::npos;
    }

    std::optional<Cut> cut() {
        std::string declarations, assignments;
        for (const SharedValue& value : values_) {
            declarations += fmt::format("{} {}; ", value.type, value.name);
            assignments += fmt::format(" {} = {};", value.name, value.words);
        }
        auto declared = at_word(text_, tree_[first_function_].begin, declarations, "");
        auto assigned = at_word(text_, tree_[body_of_function(text_, main_)].begin, "", assignments);
        if (!declared || !assigned)
            return std::nullopt;
        Cut cut{{{}, reason()}, saved_};
        cut.change.wraps = {*std::move(declared), *std::move(assigned)};
        std::ranges::move(uses_, std::back_inserter(cut.change.wraps));
        return cut;
    }

    std::string reason() const {
        const SourceLocation where = text_.used(tree_[first_use_].begin);
        const size_t others = values_.size() - 1;
        return fmt::format("{}:{}: computes `{}`{} once a pixel, where loops and calls did so again",
                           where.file, where.line, text_.excerpt(first_use_),
                           others > 0 ? fmt::format(" and {} more", others) : "");
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    const WorkEstimate& work_;
    std::vector<Global> globals_;
    UniformExpressions expressions_;
    WordEdits edits_;
    NodeId main_ = k_no_node, first_function_ = k_no_node, first_use_ = k_no_node;
    std::vector<std::string_view> parameters_{};
    std::vector<SharedValue> values_{};
    std::vector<Wrap> uses_{};
    size_t last_name_ = 0;
    double saved_ = 0;
};

} // namespace

std::optional<Cut> once_a_pixel(const ParsedText& text, const TreeFacts& facts, const WorkEstimate& work) {
    return Finder(text, facts, work).run();
}

} // namespace tidemark::glsl
