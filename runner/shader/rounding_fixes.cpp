// Fixes of what float rounding spoils: texts that say the same with fewer lost digits, times reduced to a
// period, hashes of whole numbers instead of large sines. Builds the functions that fixes insert.
#include "base/encoding.hpp"
#include "shader/fixes.hpp"
#include "shader/source_edits.hpp"
#include "shader/tree_facts.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::glsl {
namespace {

/// The text that replaces an expression, and the reason.
struct Instead {
    std::string words;
    std::string reason;
};

/// Rewrites the difference of two calls of one function.
struct Rule {
    std::string_view function;
    std::string_view instead; ///< {0}, {1}: the arguments of the two calls
    std::string_view reason;
};

constexpr std::string_view k_roots =
    "√a - √b is (a - b) / (√a + √b), which keeps its digits where a is near b";
constexpr std::string_view k_sum_to_product =
    "such a difference is a product, which keeps its digits where the angles are near each other";
constexpr Rule k_differences[] = {
    {"sqrt", "({0} - {1}) / (sqrt({0}) + sqrt({1}))", k_roots},
    {"length", "dot({0} - {1}, {0} + {1}) / (length({0}) + length({1}))", k_roots},
    {"sin", "2.0 * cos(0.5 * ({0} + {1})) * sin(0.5 * ({0} - {1}))", k_sum_to_product},
    {"cos", "-2.0 * sin(0.5 * ({0} + {1})) * sin(0.5 * ({0} - {1}))", k_sum_to_product},
};

class PreciseForms {
public:
    PreciseForms(const ParsedText& text, const TreeFacts& facts)
        : text_(text), tree_(text.tree()), facts_(facts), values_(text, facts) {}

    std::vector<Cure> run() {
        std::vector<Cure> cures;
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            const auto instead = instead_of(id);
            const auto written = instead ? written_for(text_, id, id) : std::nullopt;
            const bool has_brackets = tree_[tree_[id].parent].kind == NodeKind::parenthesis;
            if (written)
                cures.push_back({{in_place_of(text_, *written,
                                              has_brackets ? instead->words : "(" + instead->words + ")")},
                                 instead->reason});
        }
        return cures;
    }

private:
    std::optional<Instead> instead_of(NodeId id) const {
        if (is_call(id, "acos"))
            return angle(id);
        const bool difference = tree_[id].kind == NodeKind::binary && text_.word_of(id) == "-";
        if (!difference || facts_.surely_whole[id])
            return std::nullopt;
        const NodeId left = bare(tree_.child(id, 0)), right = bare(tree_.child(id, 1));
        for (const auto rule : {&PreciseForms::discriminant, &PreciseForms::one_less_cosine,
                                &PreciseForms::of_squares, &PreciseForms::of_two_calls})
            if (auto found = (this->*rule)(left, right))
                return found;
        return std::nullopt;
    }

    NodeId bare(NodeId id) const { return without_brackets(tree_, id); }

    bool is_call(NodeId id, std::string_view name) const {
        return tree_[id].kind == NodeKind::call && called_name(text_, id) == name && !facts_.function(name);
    }

    bool is_one(NodeId id) const {
        return tree_[id].kind == NodeKind::literal && number(text_.word_of(id)) == 1.0;
    }

    bool are_equal(NodeId one, NodeId other) const {
        return text_.excerpt(bare(one)) == text_.excerpt(bare(other));
    }

    /// Returns the text, in parentheses if it is more than a name; nothing if it cannot be repeated.
    std::optional<std::string> words_of(NodeId id) const {
        const auto written = written_for(text_, id, id);
        auto words = written ? said_again(text_, facts_, id, *written) : std::nullopt;
        const NodeKind kind = tree_[id].kind;
        const bool loose = kind != NodeKind::name && kind != NodeKind::literal && kind != NodeKind::member &&
                           kind != NodeKind::call && kind != NodeKind::parenthesis;
        return words && loose ? std::optional("(" + *words + ")") : words;
    }

    std::optional<std::string> argument(NodeId call, size_t index) const {
        return words_of(bare(tree_.child(call, index + 1)));
    }

    /// Rewrites by the half angle: 1 and a cosine near 1 leave no digits in their difference.
    std::optional<Instead> one_less_cosine(NodeId left, NodeId right) const {
        const auto x = is_one(left) && is_call(right, "cos") ? argument(right, 0) : std::nullopt;
        if (!x)
            return std::nullopt;
        return Instead{fmt::format("2.0 * sin(0.5 * {0}) * sin(0.5 * {0})", *x),
                       "1 - cos x is 2 sin² (x / 2), which keeps its digits where x is small"};
    }

    /// Returns the a of `a * a` and of `dot(a, a)`; 1 is its own root.
    NodeId root_of(NodeId id) const {
        const bool product = tree_[id].kind == NodeKind::binary && text_.word_of(id) == "*";
        if (product && are_equal(tree_.child(id, 0), tree_.child(id, 1)))
            return bare(tree_.child(id, 0));
        if (is_call(id, "dot") && are_equal(tree_.child(id, 1), tree_.child(id, 2)))
            return bare(tree_.child(id, 1));
        return is_one(id) ? id : k_no_node;
    }

    std::optional<Instead> of_squares(NodeId left, NodeId right) const {
        const NodeId a = root_of(left), b = root_of(right);
        const bool dots = is_call(left, "dot");
        if (a == k_no_node || b == k_no_node || dots != is_call(right, "dot") || (is_one(a) && is_one(b)))
            return std::nullopt;
        const auto one = words_of(a), other = words_of(b);
        if (!one || !other)
            return std::nullopt;
        return Instead{dots ? fmt::format("dot({0} - {1}, {0} + {1})", *one, *other)
                            : fmt::format("({0} - {1}) * ({0} + {1})", *one, *other),
                       "a² - b² is (a - b) (a + b), which keeps its digits where a is near b"};
    }

    std::optional<Instead> of_two_calls(NodeId left, NodeId right) const {
        for (const Rule& rule : k_differences) {
            const bool fits = is_call(left, rule.function) && is_call(right, rule.function);
            const auto a = fits ? argument(left, 0) : std::nullopt;
            const auto b = a ? argument(right, 0) : std::nullopt;
            if (b)
                return Instead{fmt::format(fmt::runtime(rule.instead), *a, *b), std::string(rule.reason)};
        }
        return std::nullopt;
    }

    /// Rewrites `b * b - c` of a ray and a sphere, b = dot(o, d), c = dot(o, o) - r * r, for a direction of
    /// length 1 (E. Haines et al., Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems,
    /// 2019).
    std::optional<Instead> discriminant(NodeId left, NodeId right) const {
        const NodeId b = root_of(left);
        if (b == k_no_node || is_one(left))
            return std::nullopt;
        const NodeId along = bare(value_of(b)), rest = bare(value_of(right));
        const bool fits = is_call(along, "dot") && tree_[rest].kind == NodeKind::binary &&
                          text_.word_of(rest) == "-" && is_call(bare(tree_.child(rest, 0)), "dot");
        const NodeId origin = fits ? root_of(bare(tree_.child(rest, 0))) : k_no_node;
        if (origin == k_no_node)
            return std::nullopt;
        const NodeId one = tree_.child(along, 1), other = tree_.child(along, 2);
        if (!are_equal(origin, one) && !are_equal(origin, other))
            return std::nullopt;
        const auto o = words_of(origin), d = words_of(bare(are_equal(origin, one) ? other : one)),
                   radius = words_of(tree_.child(rest, 1)), length = words_of(b);
        if (!o || !d || !radius || !length)
            return std::nullopt;
        const std::string off = fmt::format("{} - {} * {}", *o, *length, *d);
        return Instead{
            fmt::format("{0} - dot({1}, {1})", *radius, off),
            "the discriminant of a sphere by its distance from the ray, which keeps its digits far "
            "from the sphere"};
    }

    /// Rewrites by W. Kahan's formula: an arc cosine near 1 has half of the digits.
    std::optional<Instead> angle(NodeId id) const {
        const NodeId cosine = bare(tree_.child(id, 1));
        const auto a = is_call(cosine, "dot") ? argument(cosine, 0) : std::nullopt;
        const auto b = a ? argument(cosine, 1) : std::nullopt;
        if (!b)
            return std::nullopt;
        return Instead{
            fmt::format("2.0 * atan(length({0} - {1}), length({0} + {1}))", *a, *b),
            "the angle of two vectors of length 1 by the lengths of their difference and sum, which "
            "keeps its digits where they nearly point the same way"};
    }

    /// Returns the value of a name that has only one; any other node itself.
    NodeId value_of(NodeId id) const {
        const NodeId value = values_.of(id);
        return value == k_no_node ? id : value;
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    SingleValues values_;
};

} // namespace

std::vector<Cure> rewrites(const ParsedText& text, const TreeFacts& facts) {
    return PreciseForms(text, facts).run();
}

namespace {

/// Longest chain of names whose values are names.
constexpr int k_most_names = 8;

/// GLSL function: the fraction of `rate` times the time, in turns, to 4e-7 of a turn. The rate (turns per
/// second) comes in three parts of 12 bits, so that the products with both halves of iTime are exact and lose
/// nothing by `fract` (T. J. Dekker's splitting, 1971).
constexpr std::string_view k_turns =
    "(vec3 rate) { float upper = uintBitsToFloat(floatBitsToUint(iTime) & 0xfffff000u); "
    "vec3 turns = fract(rate * upper) + fract(rate * (iTime - upper)); "
    "return fract(turns.x + turns.y + turns.z + (rate.x + rate.y + rate.z) * iTimeLow); } ";

/// Returns the nearest number with 12 bits.
double upper_part(double value) {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    return std::ldexp(std::nearbyint(std::ldexp(mantissa, 12)), exponent - 12);
}

/// Returns whether the magnitude is that of a normal float.
bool is_float(double value) {
    const double size = std::abs(value);
    return size >= std::numeric_limits<float>::min() && size <= std::numeric_limits<float>::max();
}

/// Writes the rate's three parts with all digits: a scene in double precision reads them as doubles.
std::string in_parts(double rate) {
    const double first = upper_part(rate), second = upper_part(rate - first);
    return fmt::format("vec3({}, {}, {})", first, second, upper_part(rate - first - second));
}

class TimeReducer {
public:
    TimeReducer(const ParsedText& text, const TreeFacts& facts)
        : text_(text), tree_(text.tree()), facts_(facts), values_(text, facts),
          constants_(tree_.nodes.size()), turns_(text, "turns_of_time") {}

    std::vector<Cure> run() {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            if (const auto period = period_of(id))
                reduce(tree_.child(id, 1), 1, *period);
        return turns_.cures([this](const std::string& name) { return definition(name); },
                            "the time's part of a phase as a fraction of a turn, before anything is added");
    }

private:
    std::string definition(const std::string& name) const {
        const bool declared = facts_.names.contains("iTimeLow");
        return fmt::format("{}float {}{}", declared ? "" : "uniform float iTimeLow; ", name, k_turns);
    }

    /// Returns the period of a periodic function's call.
    std::optional<double> period_of(NodeId id) {
        if (tree_[id].kind != NodeKind::call || facts_.function(called_name(text_, id)))
            return std::nullopt;
        const std::string_view name = called_name(text_, id);
        if (name == "sin" || name == "cos")
            return 2 * std::numbers::pi;
        if (name == "fract")
            return 1;
        const auto period = name == "mod" ? constant(tree_.child(id, 2)) : std::nullopt;
        return period && period->value > 0 ? std::optional(period->value) : std::nullopt;
    }

    struct Number {
        double value;
        bool whole; ///< an int
    };

    /// Returns the value of a constant expression, computed once per node. A name that occurs in its own
    /// value is not a constant.
    std::optional<Number> constant(NodeId id, int names = 0) {
        if (!constants_[id].known) {
            constants_[id].known = true;
            constants_[id].value = find_constant(id, names);
        }
        return constants_[id].value;
    }

    std::optional<Number> find_constant(NodeId id, int names) {
        id = without_brackets(tree_, id);
        switch (tree_[id].kind) {
        case NodeKind::literal: {
            const std::string_view word = text_.word_of(id);
            const auto value = number(word);
            return value ? std::optional(Number{*value, word.find_first_of(".eEfF") == word.npos})
                         : std::nullopt;
        }
        case NodeKind::prefix: {
            const auto value = constant(tree_.child(id, 0), names);
            return value && text_.word_of(id) == "-" ? std::optional(Number{-value->value, value->whole})
                                                     : std::nullopt;
        }
        case NodeKind::name: {
            const NodeId value = names < k_most_names ? values_.of(id) : k_no_node;
            return value == k_no_node ? std::nullopt : constant(value, names + 1);
        }
        case NodeKind::binary: {
            const auto left = constant(tree_.child(id, 0), names),
                       right = constant(tree_.child(id, 1), names);
            return left && right ? worked_out(text_.word_of(id), *left, *right) : std::nullopt;
        }
        default: return std::nullopt;
        }
    }

    /// Returns nothing for two ints, which divide differently (2 / 3 is 0), and for a result that is not
    /// finite.
    static std::optional<Number> worked_out(std::string_view sign, const Number& left, const Number& right) {
        if ((sign != "*" && sign != "/") || (left.whole && right.whole))
            return std::nullopt;
        const double value = sign == "*" ? left.value * right.value : left.value / right.value;
        return std::isfinite(value) ? std::optional(Number{value, false}) : std::nullopt;
    }

    /// Returns the factor of iTime if the expression is iTime times constants.
    std::optional<double> rate_of(NodeId id, int names = 0) {
        id = without_brackets(tree_, id);
        if (tree_[id].kind == NodeKind::name) {
            if (text_.word_of(id) == "iTime")
                return 1;
            const NodeId value = names < k_most_names ? values_.of(id) : k_no_node;
            return value == k_no_node ? std::nullopt : rate_of(value, names + 1);
        }
        const auto scaled = scaled_part(id);
        const auto rate = scaled ? rate_of(scaled->part, names) : std::nullopt;
        return rate ? std::optional(*rate * scaled->factor) : std::nullopt;
    }

    struct Scaled {
        NodeId part;
        double factor;
    };

    /// Splits `3.0 * x`, `x * 3.0` and `x / 3.0` into the part x and its factor.
    std::optional<Scaled> scaled_part(NodeId id) {
        if (tree_[id].kind != NodeKind::binary)
            return std::nullopt;
        const NodeId left = tree_.child(id, 0), right = tree_.child(id, 1);
        const auto behind = constant(right);
        if (text_.word_of(id) == "/" && behind && behind->value != 0)
            return Scaled{left, 1 / behind->value};
        if (text_.word_of(id) != "*")
            return std::nullopt;
        const auto before = behind ? std::nullopt : constant(left);
        return behind   ? std::optional(Scaled{left, behind->value})
               : before ? std::optional(Scaled{right, before->value})
                        : std::nullopt;
    }

    /// Replaces a term by `turn` times the fraction of `rate` times the time. Leaves terms from a macro: its
    /// body may be used elsewhere, too.
    void use(NodeId term, double turn, double rate) {
        for (size_t i = tree_[term].begin; i < tree_[term].end; ++i)
            if (text_.words()[i].from_macro())
                return;
        turns_.use(term, [&](const std::string& name) {
            return fmt::format("{} * {}({})", float_literal(fmt::format("{}", turn)), name, in_parts(rate));
        });
    }

    /// Replaces the time terms of `id`, which the argument of a function of that period contains `factor`
    /// times.
    void reduce(NodeId id, double factor, double period) {
        if (const auto rate = rate_of(id)) {
            const double turn = period / factor, turns = *rate * factor / period;
            if (is_float(turn) && is_float(turns))
                use(id, turn, turns);
            return;
        }
        const NodeId inside = without_brackets(tree_, id);
        const std::string_view word = text_.word_of(inside);
        if (tree_[inside].kind != NodeKind::binary)
            return;
        if (word == "+" || word == "-") {
            reduce(tree_.child(inside, 0), factor, period);
            reduce(tree_.child(inside, 1), factor, period);
        } else if (const auto scaled = scaled_part(inside)) {
            reduce(scaled->part, factor * scaled->factor, period);
        }
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    SingleValues values_;
    struct Constant {
        bool known = false;
        std::optional<Number> value{};
    };
    std::vector<Constant> constants_; ///< per node
    HelperFunction turns_;
};

} // namespace

std::vector<Cure> reduced_times(const ParsedText& text, const TreeFacts& facts) {
    return TimeReducer(text, facts).run();
}

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
