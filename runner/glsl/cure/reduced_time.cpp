#include "glsl/cure/reduced_time.hpp"

#include "glsl/cure/helper_function.hpp"
#include "glsl/flow/single_values.hpp"
#include "glsl/syntax/number.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace tidemark::glsl {
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
            return fmt::format("{} * {}({})", as_float(fmt::format("{}", turn)), name, in_parts(rate));
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

} // namespace tidemark::glsl
