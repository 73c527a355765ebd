#include "shader/fixes.hpp"
#include "shader/tree_facts.hpp"
#include "shader/undefined_behaviour.hpp"
#include "shader/variables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <string_view>

namespace tidemark::glsl {

std::optional<WrittenTokens> look_up_by_neighbours(const ParsedText& text, const TreeFacts& facts,
                                                   NodeId id) {
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind != NodeKind::call || called_name(text, id) != "texture" || tree.child_count(id) < 3 ||
        tree[tree.child(id, 1)].kind != NodeKind::name || facts.function("texture"))
        return std::nullopt;
    const auto written = written_for(text, id, id);
    const bool whole =
        written && text.tokens()[written->first].is("texture") && text.tokens()[written->last].is(")");
    return whole ? written : std::nullopt;
}

std::optional<Cure> base_level(const ParsedText& text, const TreeFacts& facts, const Divergent& fault) {
    const SyntaxTree& tree = text.tree();
    const auto call = look_up_by_neighbours(text, facts, fault.call);
    if (!call)
        return std::nullopt;
    Cure cure{{in_place_of(text, {call->first, call->first}, "textureLod")},
              fmt::format("takes the base level in `{}`, whatever neighbouring pixels do",
                          text.excerpt(fault.call))};
    const NodeId bias = tree.child(fault.call, 3);
    if (bias == k_no_node) {
        cure.wraps.push_back(wrapped(text, {call->last, call->last}, ", 0.0", ""));
        return cure;
    }
    const auto words = written_for(text, bias, fault.call);
    if (!words || words->first <= call->first || words->last >= call->last)
        return std::nullopt;
    cure.wraps.push_back(in_place_of(text, *words, "0.0"));
    return cure;
}

std::optional<Cure> smooth_look_up(const ParsedText& text, const TreeFacts& facts,
                                   const JumpingLookUp& fault) {
    const auto call = look_up_by_neighbours(text, facts, fault.call);
    if (!call)
        return std::nullopt;
    const auto derivative = [&](std::string_view function) {
        const std::string one = fmt::format("{}({})", function, fault.smooth);
        if (fault.other_angle.empty())
            return one;
        const std::string other = fmt::format("{}({})", function, fault.other_angle);
        return fmt::format("mix({0}, {1}, step(dot({1}, {1}), dot({0}, {0})))", one, other); // the smaller
    };
    return Cure{{in_place_of(text, {call->first, call->first}, "textureGrad"),
                 wrapped(text, {call->last, call->last},
                         fmt::format(", {}, {}", derivative("dFdx"), derivative("dFdy")), "")},
                fmt::format("takes the mipmap's level without the jump of {}", fault.jump)};
}

std::optional<Cure> ordered_edges(const ParsedText& text, const TreeFacts& facts, const WrongEdges& fault) {
    const SyntaxTree& tree = text.tree();
    const auto tokens = [&](size_t child) {
        return written_for(text, tree.child(fault.call, child), fault.call);
    };
    const auto call = written_for(text, fault.call, fault.call);
    const auto low = tokens(1), high = tokens(2);
    if (!call || !low || !high)
        return std::nullopt;
    if (called_name(text, fault.call) == "clamp") // its limits are the arguments 2 and 3
        return Cure{{in_place_of(text, {call->first, call->first}, "min(max"), wrapped(text, *high, "", ")")},
                    "takes the low limit first, then the high one, as this device does"};
    if (fault.equal) {
        auto guards = domain_guards(text, facts, fault.call);
        return guards.empty() ? std::nullopt : std::optional(std::move(guards.front()));
    }
    const auto low_words = said_again(text, facts, tree.child(fault.call, 1), *low),
               high_words = said_again(text, facts, tree.child(fault.call, 2), *high);
    if (!low_words || !high_words)
        return std::nullopt;
    return Cure{{wrapped(text, *call, "(1.0 - ", ")"), in_place_of(text, *low, *high_words),
                 in_place_of(text, *high, *low_words)},
                "the same curve with its edges in order"};
}

namespace {

/// Returns the statement of the function's body that holds the node; k_no_node: none does.
NodeId outermost_statement(const SyntaxTree& tree, NodeId id) {
    while (id != k_no_node && tree[tree[tree[id].parent].parent].kind != NodeKind::function)
        id = tree[id].parent;
    return id != k_no_node && tree[tree[id].parent].kind == NodeKind::block ? id : k_no_node;
}

/// Returns whether a name in `expression` is declared or set between the two statements, both included.
bool changes_between(const ParsedText& text, const TreeFacts& facts, NodeId expression, NodeId first,
                     NodeId last) {
    const SyntaxTree& tree = text.tree();
    std::set<std::string_view> used;
    for (NodeId id = 1; id <= expression; ++id) // parts come before the node that holds them
        if (tree[id].kind == NodeKind::name && tree.is_within(id, expression))
            used.insert(text.word_of(id));
    for (NodeId id = 1; id <= last; ++id) {
        if (tree[id].begin < tree[first].begin || tree[id].end > tree[last].end)
            continue;
        if (tree[id].kind == NodeKind::declarator && used.contains(text.word_of(id)))
            return true;
        for (const std::string_view set : names_set(text, facts, id))
            if (used.contains(set))
                return true;
    }
    return false;
}

} // namespace

std::optional<Cure> hoisted_derivative(const ParsedText& text, const TreeFacts& facts,
                                       const Divergent& fault) {
    const SyntaxTree& tree = text.tree();
    const NodeId first = outermost_statement(tree, fault.branch.at),
                 last = outermost_statement(tree, fault.call);
    const bool in_one_function =
        tree.around(first, NodeKind::function) == tree.around(last, NodeKind::function);
    if (fault.branch.called || first == k_no_node || last == k_no_node || !in_one_function ||
        changes_between(text, facts, fault.call, first, last))
        return std::nullopt;
    const auto type = expression_type(text, facts, fault.call);
    const auto written = written_for(text, fault.call, fault.call);
    const auto words = written ? said_again(text, facts, fault.call, *written) : std::nullopt;
    const Word& front = text.words()[tree[first].begin];
    if (!type || !words || front.from_macro() || text.words()[tree[fault.call].word].from_macro())
        return std::nullopt;
    const std::string name = fresh_name(text, "taken_before");
    return Cure{{wrapped(text, {front.spelled, front.spelled},
                         fmt::format("{} {} = {}; ", to_string(*type), name, *words), ""),
                 in_place_of(text, *written, name)},
                fmt::format("takes `{}` before neighbouring pixels diverge", *words)};
}

namespace {

/// Writes the zero of a variable, of a parameter or of a function's result.
class ZeroFixes {
public:
    ZeroFixes(const ParsedText& text, const TreeFacts& facts) : text_(text), facts_(facts), shapes_(text) {}

    std::optional<Wrap> where_declared(NodeId declarator) {
        const auto zero = zero_of(tree().child(tree()[declarator].parent, 0), declarator);
        const auto written = zero ? written_for(text_, declarator, declarator) : std::nullopt;
        return written ? std::optional(wrapped(text_, *written, "", " = " + *zero)) : std::nullopt;
    }

    /// Sets the parameter at the start of the function's body.
    std::optional<Wrap> where_it_begins(NodeId parameter) {
        const NodeId body = body_of_function(text_, tree().around(parameter, NodeKind::function));
        const auto zero = zero_of(tree().child(parameter, 0), parameter);
        if (!zero || body == k_no_node)
            return std::nullopt;
        return at_word(text_, tree()[body].begin, "",
                       fmt::format(" {} = {};", text_.word_of(parameter), *zero));
    }

    std::optional<Wrap> where_it_ends(NodeId function) {
        const NodeId body = body_of_function(text_, function);
        const auto zero = zero_of(tree().child(function, 0), k_no_node);
        if (!zero || body == k_no_node)
            return std::nullopt;
        return at_word(text_, tree()[body].end - 1, fmt::format("return {}; ", *zero), "");
    }

private:
    const SyntaxTree& tree() const { return text_.tree(); }
    std::optional<std::string> zero_of(NodeId type, NodeId declared) {
        return zero_value(shapes_.of(type, declared), facts_);
    }

    const ParsedText& text_;
    const TreeFacts& facts_;
    Shapes shapes_;
};

} // namespace

std::optional<Cure> initial_value(const ParsedText& text, const TreeFacts& facts, const Unassigned& fault) {
    const bool is_function = fault.why == Unassigned::Why::no_return;
    const bool is_parameter = text.tree()[fault.what].kind == NodeKind::parameter;
    ZeroFixes zeros(text, facts);
    auto wrap = is_function    ? zeros.where_it_ends(fault.what)
                : is_parameter ? zeros.where_it_begins(fault.what)
                               : zeros.where_declared(fault.what);
    if (!wrap)
        return std::nullopt;
    return Cure{{*std::move(wrap)},
                fmt::format("{} {}, as on ShaderToy's site", text.word_of(fault.what),
                            is_function ? "returns 0 where no `return` is reached" : "begins with 0")};
}

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
                "takes the even power of the magnitude; unchanged for numbers above 0");
        for (const Guard& guard : k_guards)
            if (guard.function == name_ && argument(guard.argument) != k_no_node)
                add(argument(guard.argument), std::string(guard.front), std::string(guard.behind),
                    fmt::format("keeps the argument of {} within `{}…{}`; unchanged inside that range", name_,
                                guard.front, guard.behind));
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
        const std::string reason = fmt::format("replaces 0 by {}; other numbers are unchanged", tiny);
        if (is_never_negative(divisor))
            return add(divisor, "max(", fmt::format(", {})", tiny),
                       fmt::format("keeps a value that is never negative above 0: at least {}", tiny));
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
                   "leaves a zero vector unchanged; every other is normalised as before");
        if (name_ == "normalize")
            add(argument(0), "", " + 1e-15", "keeps the vector away from 0; larger vectors are unchanged");
        if (name_ == "inverse" && words[0])
            choose(fmt::format("determinant({}) != 0.0", *words[0]), fmt::format("0.0 * ({})", *words[0]),
                   "gives zeros for a matrix without an inverse; every other is inverted as before");
        if (name_ == "smoothstep" && words[0] && words[1] && words[2])
            choose(fmt::format("{} != {}", *words[0], *words[1]),
                   fmt::format("step({}, {})", *words[0], *words[2]),
                   "equal edges become a step; others are unchanged");
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

std::optional<Cure> unsigned_dividend(const ParsedText& text, const TreeFacts& facts, NodeId operation) {
    const SyntaxTree& tree = text.tree();
    if (tree[operation].kind != NodeKind::binary)
        return std::nullopt;
    const NodeId left = tree.child(operation, 0);
    const auto dividend = written_for(text, left, operation), all = written_for(text, operation, operation);
    const auto words = dividend ? said_again(text, facts, left, *dividend) : std::nullopt;
    if (!words || !all)
        return std::nullopt;
    const std::string once = tree[left].kind == NodeKind::parenthesis ? *words : "(" + *words + ")";
    return Cure{
        {wrapped(text, *all, fmt::format("(sign{} * (", once), "))"), wrapped(text, *dividend, "abs(", ")")},
        "divides the magnitude, then gives it the sign: rounded towards 0, as most GPUs do"};
}

namespace {

/// Returns whether the text shows that a float is always a whole number.
bool is_whole(const ParsedText& text, const TreeFacts& facts, const SingleValues& single, NodeId id,
              int depth = 0) {
    const SyntaxTree& tree = text.tree();
    const auto part = [&](size_t index) {
        return is_whole(text, facts, single, tree.child(id, index), depth + 1);
    };
    if (depth > 16)
        return false;
    switch (tree[id].kind) {
    case NodeKind::parenthesis:
    case NodeKind::prefix:
    case NodeKind::member: return part(0);
    case NodeKind::literal: {
        double value = 0.5;
        const std::string_view digits = text.word_of(id);
        return std::from_chars(digits.data(), digits.data() + digits.size(), value).ec == std::errc{} &&
               value == std::floor(value);
    }
    case NodeKind::name: {
        const NodeId value = single.of(id);
        return value != k_no_node && is_whole(text, facts, single, value, depth + 1);
    }
    case NodeKind::binary: {
        const std::string_view op = text.word_of(id);
        return (op == "+" || op == "-" || op == "*") && part(0) && part(1);
    }
    case NodeKind::call: {
        const std::string_view name = called_name(text, id);
        if (facts.function(name))
            return false;
        if (name == "floor" || name == "ceil" || name == "round" || name == "trunc")
            return true;
        if (class_of_type(name) != TypeClass::floating)
            return false;
        for (size_t i = 1; i < tree.child_count(id); ++i)
            if (!facts.surely_whole[tree.child(id, i)] && !part(i))
                return false;
        return true;
    }
    default: return false;
    }
}

} // namespace

std::optional<Cure> between_whole_quotients(const ParsedText& text, const TreeFacts& facts,
                                            NodeId operation) {
    const SyntaxTree& tree = text.tree();
    const bool mod = tree[operation].kind == NodeKind::call;
    const size_t first = mod ? 1 : 0;
    const SingleValues single(text, facts);
    if (!is_whole(text, facts, single, tree.child(operation, first)) ||
        !is_whole(text, facts, single, tree.child(operation, first + 1)))
        return std::nullopt;
    const auto dividend = written_for(text, tree.child(operation, first), operation),
               all = written_for(text, operation, operation);
    if (!dividend || !all)
        return std::nullopt;
    Cure cure{{wrapped(text, *dividend, "(", " + 0.5)")},
              "adds a half before the division, so that no quotient is a whole number"};
    if (mod)
        cure.wraps.push_back(wrapped(text, *all, "(", " - 0.5)"));
    return cure;
}

} // namespace tidemark::glsl
