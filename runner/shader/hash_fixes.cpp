// Replaces hashes of large sines by hashes of whole numbers, and builds the functions that fixes insert.
#include "shader/fixes.hpp"
#include "shader/source_edits.hpp"
#include "shader/tree_facts.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::glsl {

void HelperFunction::use(NodeId expression, const Say& say) {
    const NodeId function = text_.tree().around(expression, NodeKind::function);
    const auto written = written_for(text_, expression, expression);
    if (function == k_no_node || !written)
        return;
    const Word& start = text_.words()[text_.tree()[function].begin];
    Wrap first = wrapped(text_, {start.spelled, start.spelled}, "", "");
    Wrap use = in_place_of(text_, *written, "");
    const std::string& file = use.first.where.file;
    if (start.from_macro() || first.first.where.file != file)
        return;
    const auto known = files_.find(file);
    const std::string name =
        known == files_.end() ? fresh_name(text_, wanted_, files_.size() + 1) : known->second.name;
    auto words = say(name);
    if (!words)
        return;
    use.front = *std::move(words);
    files_.try_emplace(file, Uses{name, std::move(first)}).first->second.wraps.push_back(std::move(use));
}

std::vector<Cure> HelperFunction::cures(const std::function<std::string(const std::string& name)>& define,
                                        const std::string& reason) const {
    std::vector<Cure> cures;
    for (const auto& [file, uses] : files_) {
        Cure& cure = cures.emplace_back(Cure{{uses.first}, reason});
        cure.wraps.front().front = define(uses.name);
        cure.wraps.insert(cure.wraps.end(), uses.wraps.begin(), uses.wraps.end());
    }
    return cures;
}

namespace {

/// A sine times this or more keeps only its last digits; the same limit as in float_hashes.cpp.
constexpr double k_large = 90;

/// GLSL hash of the bits of four floats, in sequence, each mixed as in the finaliser of MurmurHash3 (A.
/// Appleby, public domain); -0 counts as 0. It returns a multiple of 2^-24 below 1. Its type and name are
/// written before this text.
constexpr std::string_view k_hash =
    "(vec4 p) { uvec4 b = floatBitsToUint(p + 0.0); uint n = 0u; for (int i = 0; i < 4; ++i) { "
    "n = (n ^ b[i]) + 0x9e3779b9u; n = (n ^ (n >> 16)) * 0x85ebca6bu; n = (n ^ (n >> 13)) * 0xc2b2ae35u; "
    "n ^= n >> 16; } return float(n >> 8) / 16777216.0; } ";

class HashFinder {
public:
    HashFinder(const ParsedText& text, const TreeFacts& facts)
        : text_(text), tree_(text.tree()), facts_(facts) {}

    std::vector<Cure> run() {
        HelperFunction hash(text_, "hash_of_bits");
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            if (const NodeId angle = angle_of(id); angle != k_no_node)
                hash.use(id, [&](const std::string& name) { return instead_of(angle, name); });
        return hash.cures([](const std::string& name) { return fmt::format("float {}{}", name, k_hash); },
                          "a hash of bits instead of a sine: the same numbers on every GPU, but other "
                          "numbers than now, so another picture");
    }

private:
    NodeId bare(NodeId id) const { return without_brackets(tree_, id); }

    bool is_call(NodeId id, std::initializer_list<std::string_view> names) const {
        return tree_[id].kind == NodeKind::call && !facts_.function(called_name(text_, id)) &&
               std::ranges::find(names, called_name(text_, id)) != names.end();
    }

    /// Returns the x of `fract(sin(x) * 43758.5)`; k_no_node for any other node.
    NodeId angle_of(NodeId id) const {
        if (!is_call(id, {"fract"}))
            return k_no_node;
        const NodeId product = bare(tree_.child(id, 1));
        if (tree_[product].kind != NodeKind::binary || text_.word_of(product) != "*")
            return k_no_node;
        const NodeId left = bare(tree_.child(product, 0)), right = bare(tree_.child(product, 1));
        for (const auto& [sine, factor] : {std::pair(left, right), std::pair(right, left)})
            if (is_call(sine, {"sin", "cos"}) && tree_[factor].kind == NodeKind::literal &&
                number(text_.word_of(factor)).value_or(0) >= k_large)
                return bare(tree_.child(sine, 1));
        return k_no_node;
    }

    std::optional<std::string> words_of(NodeId id) const {
        const auto tokens = written_for(text_, id, id);
        return tokens ? said_again(text_, facts_, id, *tokens) : std::nullopt;
    }

    /// Returns `vec4(p, 0.0, 1.0)` for `dot(p, vec2(12.9898, 78.233))`, with the seed as the last number.
    std::optional<std::string> four_of_dot(NodeId id, int seed) const {
        const NodeId left = bare(tree_.child(id, 1)), right = bare(tree_.child(id, 2));
        for (const auto& [vector, weights] : {std::pair(left, right), std::pair(right, left)}) {
            const auto type =
                value_type(tree_[weights].kind == NodeKind::call ? called_name(text_, weights) : "");
            if (!type || !type->vector() || type->base != 'f')
                continue;
            const auto words = words_of(vector);
            if (!words || (type->rows == 4 && seed > 0))
                return std::nullopt;
            std::string rest;
            for (int i = type->rows; i < 4; ++i)
                rest += i == 3 ? fmt::format(", {}.0", seed) : ", 0.0";
            return fmt::format("vec4({}{})", *words, rest);
        }
        return std::nullopt;
    }

    /// Returns whether the node names one float that its function declares exactly once.
    bool is_float_name(NodeId id) const {
        if (tree_[id].kind != NodeKind::name)
            return false;
        const NodeId function = tree_.around(id, NodeKind::function);
        int declared = 0;
        bool single = true;
        for (NodeId each = 1; each < tree_.nodes.size(); ++each) {
            const bool parameter = tree_[each].kind == NodeKind::parameter;
            if ((!parameter && tree_[each].kind != NodeKind::declarator) ||
                text_.word_of(each) != text_.word_of(id) ||
                tree_.around(each, NodeKind::function) != function)
                continue;
            const NodeId type = tree_.child(parameter ? each : tree_[each].parent, 0);
            single = single && type_name(text_, type) == "float" && dimensions(text_, type, each) == 0;
            ++declared;
        }
        return function != k_no_node && declared == 1 && single;
    }

    /// Returns the four floats to hash, as text.
    std::optional<std::string> four_of(NodeId angle, int seed) const {
        if (is_call(angle, {"dot"}))
            return four_of_dot(angle, seed);
        return is_float_name(angle)
                   ? std::optional(fmt::format("vec4({}, 0.0, 0.0, {}.0)", text_.word_of(angle), seed))
                   : std::nullopt;
    }

    /// Returns the text that replaces the whole call, given the hash function's name.
    std::optional<std::string> instead_of(NodeId angle, const std::string& name) const {
        if (!is_call(angle, {"vec2", "vec3", "vec4"})) {
            const auto four = four_of(angle, 0);
            return four ? std::optional(fmt::format("{}({})", name, *four)) : std::nullopt;
        }
        std::string parts;
        int seed = 0;
        for (const NodeId part : tree_.children(angle)) {
            if (part == tree_.child(angle, 0))
                continue;
            const auto four = is_call(bare(part), {"dot"}) ? four_of(bare(part), seed) : std::nullopt;
            if (!four)
                return std::nullopt;
            parts += fmt::format("{}{}({})", seed++ > 0 ? ", " : "", name, *four);
        }
        return fmt::format("{}({})", called_name(text_, angle), parts);
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
};

} // namespace

std::vector<Cure> whole_hashes(const ParsedText& text, const TreeFacts& facts) {
    return HashFinder(text, facts).run();
}

} // namespace tidemark::glsl
