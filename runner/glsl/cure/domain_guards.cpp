#include "glsl/cure/domain_guards.hpp"

#include "glsl/analysis/domain_sites.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace tidemark::glsl {
namespace {

/// The text that keeps one argument within the function's domain.
struct Guard {
    std::string_view function;
    size_t argument;
    std::string_view front, behind;
};

// Each number is the last one inside the domain if there is a last one. Otherwise it is so small that no
// shader computes with it, and the function's value there can still be squared.
constexpr Guard k_guards[] = {
    {"sqrt", 0, "max(", ", 0.0)"},
    {"inversesqrt", 0, "max(", ", 1e-30)"},
    {"log", 0, "max(", ", 1e-30)"},
    {"log2", 0, "max(", ", 1e-30)"},
    {"pow", 0, "max(", ", 0.0)"},
    {"pow", 0, "max(", ", 1e-30)"},
    {"acos", 0, "clamp(", ", -1.0, 1.0)"},
    {"asin", 0, "clamp(", ", -1.0, 1.0)"},
    {"acosh", 0, "max(", ", 1.0)"},
    {"atanh", 0, "clamp(", ", -0.99999994, 0.99999994)"},
    {"exp", 0, "min(", ", 88.72283)"},
    {"exp2", 0, "min(", ", 127.99999)"},
    {"sinh", 0, "clamp(", ", -88.72283, 88.72283)"},
    {"cosh", 0, "clamp(", ", -88.72283, 88.72283)"},
};

/// Functions whose value is never below 0.
constexpr std::string_view k_never_negative[] = {"length", "distance", "abs", "sqrt", "exp", "exp2"};

class Proposer {
public:
    Proposer(const ParsedText& text, const TreeFacts& facts, NodeId operation)
        : text_(text), tree_(text.tree()), facts_(facts), operation_(operation) {}

    std::vector<Cure> run() {
        if (tree_[operation_].kind != NodeKind::call) {
            if (domain_name(text_, operation_) == k_quotient)
                keep_from_zero(tree_.child(operation_, 1), "1e-18");
            return std::move(found_);
        }
        name_ = called_name(text_, operation_);
        if (facts_.function(name_))
            return {};
        guard_arguments();
        if (name_ == "mod")
            keep_from_zero(argument(1), "1e-18");
        else if (name_ == "atan" && argument(1) != k_no_node)
            keep_from_zero(argument(1), "1e-30");
        else
            choose_instead();
        return std::move(found_);
    }

private:
    NodeId argument(size_t index) const { return tree_.child(operation_, index + 1); }

    void add(NodeId part, std::string front, std::string behind, std::string reason) {
        if (const auto tokens = written_for(text_, part, operation_))
            found_.push_back(
                {{wrapped(text_, *tokens, std::move(front), std::move(behind))}, std::move(reason)});
    }

    std::optional<std::string> again(NodeId part) const {
        const auto tokens = written_for(text_, part, operation_);
        return tokens ? said_again(text_, facts_, part, *tokens) : std::nullopt;
    }

    void guard_arguments() {
        if (name_ == "pow" && has_even_exponent())
            add(argument(0), "abs(", ")",
                "an even power is that of the magnitude; of numbers above 0 it stays the same");
        for (const Guard& guard : k_guards)
            if (guard.function == name_ && argument(guard.argument) != k_no_node)
                add(argument(guard.argument), std::string(guard.front), std::string(guard.behind),
                    fmt::format("keeps the argument of {} within `{}…{}`; inside of that it stays the same",
                                name_, guard.front, guard.behind));
    }

    /// Returns whether the exponent is an even literal, such as `2.0`: the power of a negative number has a
    /// value then.
    bool has_even_exponent() const {
        const NodeId exponent = argument(1);
        double value = 1;
        if (exponent == k_no_node || tree_[exponent].kind != NodeKind::literal)
            return false;
        const std::string_view digits = text_.word_of(exponent);
        return std::from_chars(digits.data(), digits.data() + digits.size(), value).ec == std::errc{} &&
               std::fmod(value, 2) == 0;
    }

    bool is_never_negative(NodeId id) const {
        if (tree_[id].kind == NodeKind::parenthesis)
            return is_never_negative(tree_.child(id, 0));
        if (tree_[id].kind != NodeKind::call)
            return false;
        const std::string_view name = called_name(text_, id);
        if (facts_.function(name))
            return false;
        if (name == "dot")
            return text_.excerpt(tree_.child(id, 1)) == text_.excerpt(tree_.child(id, 2));
        return std::ranges::find(k_never_negative, name) != std::end(k_never_negative);
    }

    /// `x + (1.0 - abs(sign(x))) * tiny` is x itself for all x but 0, for numbers and vectors alike.
    void keep_from_zero(NodeId divisor, std::string_view tiny) {
        const std::string reason = fmt::format("gives {} for 0, and every other number as it is", tiny);
        if (is_never_negative(divisor))
            return add(divisor, "max(", fmt::format(", {})", tiny),
                       fmt::format("keeps what is never negative from 0: at least {}", tiny));
        const auto words = again(divisor);
        if (!words)
            return;
        const bool has_brackets = tree_[divisor].kind == NodeKind::parenthesis;
        const bool loose = tree_[divisor].kind == NodeKind::conditional;
        add(divisor, loose ? "((" : "(",
            fmt::format("{} + (1.0 - abs(sign{})) * {})", loose ? ")" : "",
                        has_brackets ? *words : "(" + *words + ")", tiny),
            reason);
    }

    /// Calls the function only where it is defined.
    void choose_instead() {
        std::array<std::optional<std::string>, 3> words;
        for (size_t i = 0; i < words.size() && argument(i) != k_no_node; ++i)
            words[i] = again(argument(i));
        if (name_ == "normalize" && words[0])
            choose(fmt::format("dot({0}, {0}) > 0.0", *words[0]), *words[0],
                   "gives a vector without a length back as it is; every other is normalised as before");
        if (name_ == "normalize")
            add(argument(0), "", " + 1e-15",
                "keeps the vector from 0; one that is not that small stays the same");
        if (name_ == "inverse" && words[0])
            choose(fmt::format("determinant({}) != 0.0", *words[0]), fmt::format("0.0 * ({})", *words[0]),
                   "gives zeros for a matrix that has no inverse; every other is inverted as before");
        if (name_ == "smoothstep" && words[0] && words[1] && words[2])
            choose(fmt::format("{} != {}", *words[0], *words[1]),
                   fmt::format("step({}, {})", *words[0], *words[2]),
                   "equal edges are a step, which smoothstep comes to; others stay the same");
    }

    void choose(std::string_view defined, std::string_view instead, std::string reason) {
        add(operation_, fmt::format("({} ? ", defined), fmt::format(" : {})", instead), std::move(reason));
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    NodeId operation_;
    std::string_view name_{};
    std::vector<Cure> found_{};
};

} // namespace

std::vector<Cure> domain_guards(const ParsedText& text, const TreeFacts& facts, NodeId operation) {
    return Proposer(text, facts, operation).run();
}

} // namespace tidemark::glsl
