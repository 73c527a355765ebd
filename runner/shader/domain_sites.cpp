// Finds the operations of a text whose value can be undefined, and those that literals prove defined; and
// look-ups whose coordinates jump.

#include "shader/builtin_functions.hpp"
#include "shader/undefined_behaviour.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::glsl {
namespace {

/// Returns the value of a literal, also in parentheses or after a minus sign.
std::optional<double> number_of(const ParsedText& text, NodeId id) {
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind == NodeKind::parenthesis)
        return number_of(text, tree.child(id, 0));
    if (tree[id].kind == NodeKind::prefix && text.word_of(id) == "-") {
        const auto inside = number_of(text, tree.child(id, 0));
        return inside ? std::optional(-*inside) : std::nullopt;
    }
    if (tree[id].kind != NodeKind::literal)
        return std::nullopt;
    double value = 0;
    const std::string_view digits = text.word_of(id);
    if (std::from_chars(digits.data(), digits.data() + digits.size(), value).ec != std::errc{})
        return std::nullopt;
    return value;
}

/// Returns the numbers of a literal or of a constructor of literals, such as `vec3(1.0, 2.0, 3.0)`.
std::optional<std::vector<double>> numbers_of(const ParsedText& text, NodeId id) {
    if (const auto one = number_of(text, id))
        return std::vector<double>{*one};
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind != NodeKind::call || class_of_type(called_name(text, id)) != TypeClass::floating)
        return std::nullopt;
    std::vector<double> all;
    for (NodeId part = tree[tree.child(id, 0)].next; part != k_no_node; part = tree[part].next) {
        const auto one = number_of(text, part);
        if (!one)
            return std::nullopt;
        all.push_back(*one);
    }
    return all;
}

/// Returns whether the node is iResolution or a part of it: the host draws nothing at size zero.
bool is_the_size(const ParsedText& text, NodeId id) {
    const SyntaxTree& tree = text.tree();
    while (tree[id].kind == NodeKind::member || tree[id].kind == NodeKind::parenthesis)
        id = tree.child(id, 0);
    return tree[id].kind == NodeKind::name && text.word_of(id) == "iResolution";
}

/// Returns whether the node is a `max` with a positive literal, such as `max(x, 0.01)`.
bool is_guarded(const ParsedText& text, NodeId id) {
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind != NodeKind::call || called_name(text, id) != "max")
        return false;
    const auto is_positive = [&](NodeId part) {
        const auto numbers = numbers_of(text, part);
        return numbers && std::ranges::all_of(*numbers, [](double v) { return v > 0; });
    };
    return is_positive(tree.child(id, 1)) || is_positive(tree.child(id, 2));
}

/// Returns whether the literals in the text keep the call inside its domain. An unknown argument is replaced
/// by numbers on every side of the domains' edges.
bool surely_defined(const ParsedText& text, NodeId call, const Domain& domain) {
    const SyntaxTree& tree = text.tree();
    std::vector<double> anything{-2, 0, 2};
    std::vector<double> known[3];
    NodeId argument = tree[tree.child(call, 0)].next;
    for (size_t i = 0; i < 3 && argument != k_no_node; ++i, argument = tree[argument].next) {
        known[i] = numbers_of(text, argument).value_or(std::vector<double>{});
        anything.insert(anything.end(), known[i].begin(), known[i].end());
    }
    const auto values = [&](size_t i) { return known[i].empty() ? anything : known[i]; };
    for (const double x : values(0))
        for (const double y : values(1))
            for (const double z : values(2))
                if (domain.broken({x, y, z}))
                    return false;
    return true;
}

/// Returns whether the literals in the text keep `a / b` defined; only 0 / 0 is undefined.
bool surely_defined(const ParsedText& text, NodeId quotient) {
    const NodeId below = text.tree().child(quotient, 1);
    const auto has_no_zero = [&](NodeId id) {
        const auto numbers = numbers_of(text, id);
        return numbers && std::ranges::find(*numbers, 0) == numbers->end();
    };
    return is_the_size(text, below) || is_guarded(text, below) || has_no_zero(below) ||
           has_no_zero(text.tree().child(quotient, 0));
}

/// Returns whether dividing by each of these numbers is the same as multiplying by its reciprocal: powers of
/// two.
bool has_exact_reciprocal(const ParsedText& text, NodeId id) {
    const auto numbers = numbers_of(text, id);
    return numbers && std::ranges::all_of(*numbers, [](double number) {
               int exponent = 0;
               return std::abs(std::frexp(number, &exponent)) == 0.5;
           });
}

bool is_any_of(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::ranges::find(words, word) != words.end();
}

/// Returns whether the node is a name, a literal, or a member or element of a name, so that evaluating it
/// twice has no side effect.
bool is_place(const ParsedText& text, NodeId id) {
    const SyntaxTree& tree = text.tree();
    switch (tree[id].kind) {
    case NodeKind::name:
    case NodeKind::literal: return true;
    case NodeKind::member:
    case NodeKind::parenthesis: return is_place(text, tree.child(id, 0));
    case NodeKind::index: return is_place(text, tree.child(id, 0)) && is_place(text, tree.child(id, 1));
    default: return false;
    }
}

class SiteFinder {
public:
    SiteFinder(const ParsedText& text, const TreeFacts& facts)
        : text_(text), tree_(text.tree()), facts_(facts) {}

    std::vector<DomainSite> run(DomainScope scope) {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            if (!is_expression(tree_[id].kind) || must_stay_constant(text_, id))
                continue;
            if (is_rounded_quotient(id))
                add(id, DomainKind::whole);
            else if (is_float_site(id))
                add(id, domain_name(text_, id) == k_quotient ? DomainKind::quotient : DomainKind::function);
            else if (scope == DomainScope::everything)
                look(id);
        }
        return std::move(found_);
    }

private:
    void add(NodeId id, DomainKind kind, bool to_unsigned = false) {
        found_.push_back({id, kind, to_unsigned});
    }

    /// Returns whether `id` is a call or a quotient that has a domain, as GLSL's own functions have.
    bool is_float_site(NodeId id) const {
        if (tree_[id].kind != NodeKind::call)
            return domain_name(text_, id) == k_quotient && is_float_operation(text_, facts_, id) &&
                   !surely_defined(text_, id);
        const std::string_view name = called_name(text_, id);
        const BuiltinFunction* const function = facts_.function(name) ? nullptr : find_builtin(name);
        return function && function->domain && tree_.child_count(id) == most_parameters(*function) + 1 &&
               !surely_defined(text_, id, *function->domain);
    }

    /// Returns whether `id` is `mod(a, b)`, or `a / b` whose whole part is taken, of floats: a value that
    /// jumps where the quotient is a whole number.
    bool is_rounded_quotient(NodeId id) const {
        if (tree_[id].kind == NodeKind::call)
            return called_name(text_, id) == "mod" && !facts_.function("mod") && tree_.child_count(id) == 3 &&
                   !has_exact_reciprocal(text_, tree_.child(id, 2));
        if (tree_[id].kind != NodeKind::binary || text_.word_of(id) != "/" ||
            !is_float_operation(text_, facts_, id) || has_exact_reciprocal(text_, tree_.child(id, 1)) ||
            is_the_size(text_, tree_.child(id, 1)))
            return false;
        NodeId around = tree_[id].parent;
        while (tree_[around].kind == NodeKind::parenthesis)
            around = tree_[around].parent;
        if (tree_[around].kind != NodeKind::call || tree_.child_count(around) != 2)
            return false;
        const std::string_view name = called_name(text_, around);
        const bool whole_part = is_any_of(name, {"floor", "ceil", "trunc", "fract"}) ||
                                (class_of_type(name) == TypeClass::whole && !name.starts_with("b"));
        const auto type = expression_type(text_, facts_, id);
        return whole_part && !facts_.function(name) && type && !type->matrix();
    }

    void look(NodeId id) {
        switch (tree_[id].kind) {
        case NodeKind::binary:
        case NodeKind::assign: return operation(id);
        case NodeKind::index: return index(id);
        case NodeKind::call: return call(id);
        default: return;
        }
    }

    void operation(NodeId id) {
        const std::string_view op = text_.word_of(id);
        const NodeId right = tree_.child(id, 1);
        const auto number = number_of(text_, right);
        if (is_any_of(op, {"<<", ">>", "<<=", ">>="})) {
            if (!number || *number < 0 || *number > 31)
                add(id, DomainKind::shift);
        } else if (is_any_of(op, {"%", "%="}) ||
                   (is_any_of(op, {"/", "/="}) && facts_.surely_whole[tree_.child(id, 0)] &&
                    facts_.surely_whole[right])) {
            if (!number || *number == 0)
                add(id, DomainKind::divisor);
            if (may_have_sign(tree_.child(id, 0)) && is_place(text_, right) &&
                (tree_[id].kind == NodeKind::binary || is_place(text_, tree_.child(id, 0))))
                add(id, DomainKind::negative);
        } else if (is_any_of(op, {"/", "/="}) && facts_.surely_whole[tree_.child(id, 0)] && !number) {
            add(id, DomainKind::quotient); // `7 / s.n`: the driver's overload resolution finds the type
        } else if (is_any_of(op, {"<", ">", "<=", ">="}) ||
                   (is_any_of(op, {"==", "!="}) && (number || number_of(text_, tree_.child(id, 0))))) {
            if (!counts(id))
                add(id, DomainKind::comparison);
        }
    }

    /// Returns whether a whole number is not unsigned and no literal.
    bool may_have_sign(NodeId id) const {
        const auto type = expression_type(text_, facts_, id);
        return !number_of(text_, id) && !(type && type->base == 'u');
    }

    /// Returns whether the node is a whole-number comparison in the head of a `for`, such as `i < 10`.
    bool counts(NodeId id) const {
        return facts_.surely_whole[tree_.child(id, 0)] && tree_[tree_[id].parent].kind == NodeKind::loop_for;
    }

    void index(NodeId id) {
        const NodeId what = tree_.child(id, 0), which = tree_.child(id, 1);
        if (tree_[which].kind == NodeKind::absent || number_of(text_, which) || !is_place(text_, what) ||
            facts_.is_type(text_.word(tree_[what].begin))) // `float[n](…)`
            return;
        if (text_.is_es()) { // ES vectors have no length()
            const auto name = facts_.names.find(text_.word_of(what));
            if (tree_[what].kind != NodeKind::name || name == facts_.names.end() || !name->second.array)
                return;
        }
        add(id, DomainKind::index);
    }

    void call(NodeId id) {
        const std::string_view name = called_name(text_, id);
        if (name.empty() || facts_.function(name))
            return;
        if (name == "texelFetch" && tree_.child_count(id) == 4) {
            add(id, DomainKind::fetch);
        } else if (class_of_type(name) == TypeClass::whole && !name.starts_with("b")) {
            for (NodeId part = tree_[tree_.child(id, 0)].next; part != k_no_node; part = tree_[part].next)
                if (!facts_.surely_whole[part] && !number_of(text_, part))
                    add(part, DomainKind::conversion, name.starts_with("u"));
        }
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    std::vector<DomainSite> found_;
};

} // namespace

std::string_view domain_name(const ParsedText& text, NodeId id) {
    switch (text.tree()[id].kind) {
    case NodeKind::call: return called_name(text, id);
    case NodeKind::binary:
    case NodeKind::assign: return text.word_of(id).starts_with('/') ? k_quotient : std::string_view{};
    default: return {};
    }
}

std::vector<DomainSite> find_domain_sites(const ParsedText& text, const TreeFacts& facts, DomainScope scope) {
    return SiteFinder(text, facts).run(scope);
}

namespace {

/// Computes expressions of literals, of constructors of them, and of variables that have no other value.
class Constants {
public:
    Constants(const ParsedText& text, const TreeFacts& facts) : text_(text), single_(text, facts) {}

    /// Returns the components; nothing if the text does not state them.
    std::optional<std::vector<double>> of(NodeId id, int depth = 0) const {
        const SyntaxTree& tree = text_.tree();
        if (depth > k_most_depth)
            return std::nullopt;
        if (auto numbers = numbers_of(text_, id))
            return numbers;
        switch (tree[id].kind) {
        case NodeKind::parenthesis: return of(tree.child(id, 0), depth + 1);
        case NodeKind::name: {
            const NodeId value = single_.of(id);
            return value == k_no_node ? std::nullopt : of(value, depth + 1);
        }
        case NodeKind::prefix:
        case NodeKind::binary: return operation(id, depth + 1);
        default: return std::nullopt;
        }
    }

private:
    static constexpr int k_most_depth = 12;

    std::optional<std::vector<double>> operation(NodeId id, int depth) const {
        const std::string_view op = text_.word_of(id);
        const bool negates = text_.tree()[id].kind == NodeKind::prefix;
        if (op.size() != 1 || std::string_view("+-*/").find(op) == std::string_view::npos)
            return std::nullopt;
        const auto left = negates ? std::vector<double>{0} : of(text_.tree().child(id, 0), depth);
        const auto right = of(text_.tree().child(id, negates ? 0 : 1), depth);
        if (!left || !right || (left->size() != right->size() && left->size() > 1 && right->size() > 1))
            return std::nullopt;
        std::vector<double> all;
        for (size_t i = 0; i < std::max(left->size(), right->size()); ++i) {
            const double a = (*left)[left->size() > 1 ? i : 0], b = (*right)[right->size() > 1 ? i : 0];
            all.push_back(op == "+" ? a + b : op == "-" ? a - b : op == "*" ? a * b : a / b);
        }
        return all;
    }

    const ParsedText& text_;
    SingleValues single_;
};

} // namespace

std::vector<WrongEdges> find_wrong_edges(const ParsedText& text, const TreeFacts& facts) {
    const SyntaxTree& tree = text.tree();
    const auto reached = functions_of_main(text, facts);
    const Constants constants(text, facts);
    std::vector<WrongEdges> found;
    for (NodeId id = 1; id < tree.nodes.size(); ++id) {
        if (tree[id].kind != NodeKind::call || tree.child_count(id) != 4)
            continue;
        const std::string_view name = called_name(text, id);
        const bool steps = name == "smoothstep";
        const NodeId function = tree.around(id, NodeKind::function);
        if ((!steps && name != "clamp") || facts.function(name) || function == k_no_node ||
            !reached.contains(text.word_of(function)))
            continue;
        const auto low = constants.of(tree.child(id, steps ? 1 : 2)),
                   high = constants.of(tree.child(id, steps ? 2 : 3));
        if (!low || !high)
            continue;
        bool above = false, equal = false;
        for (size_t i = 0; i < std::max(low->size(), high->size()); ++i) {
            const double a = (*low)[low->size() > 1 ? std::min(i, low->size() - 1) : 0],
                         b = (*high)[high->size() > 1 ? std::min(i, high->size() - 1) : 0];
            above = above || a > b;
            equal = equal || (steps && a == b);
        }
        if (above || equal)
            found.push_back({id, !above});
    }
    std::ranges::sort(found, {}, [&](const WrongEdges& each) { return tree[each.call].begin; });
    return found;
}

namespace {

/// Writes coordinates without their jumps. Follows sums, products and constructors only: any other function
/// may hide a jump.
class SmoothCoordinates {
public:
    SmoothCoordinates(const ParsedText& text, const TreeFacts& facts, NodeId look_up)
        : text_(text), tree_(text.tree()), facts_(facts), single_(text, facts), look_up_(look_up) {}

    std::optional<JumpingLookUp> run() {
        const NodeId coordinates = tree_.child(look_up_, 2);
        if (!jumps(coordinates) || (whole_ && part_))
            return std::nullopt;
        auto smooth = written(coordinates, false);
        auto other = angle_ ? written(coordinates, true) : std::string();
        if (!smooth || !other || smooth->size() > k_longest)
            return std::nullopt;
        return JumpingLookUp{look_up_, std::string(first_), *std::move(smooth), *std::move(other)};
    }

private:
    static constexpr size_t k_longest = 240;
    static constexpr int k_most_depth = 24;

    bool is_built_in(NodeId call) const {
        const std::string_view name = called_name(text_, call);
        return !name.empty() && !facts_.function(name);
    }

    /// Returns the initial value of a variable that never gets another, if it jumps.
    NodeId jumping_value(NodeId name, int depth) {
        const NodeId value = single_.of(name);
        return value != k_no_node && jumps(value, depth + 1) ? value : k_no_node;
    }

    bool jumps(NodeId id, int depth = 0) {
        if (depth > k_most_depth)
            return false;
        bool any = false;
        switch (tree_[id].kind) {
        case NodeKind::name: return jumping_value(id, depth) != k_no_node;
        case NodeKind::parenthesis:
        case NodeKind::prefix:
        case NodeKind::member: return jumps(tree_.child(id, 0), depth + 1);
        case NodeKind::binary:
            if (std::string_view("+-*/").find(text_.word_of(id)) == std::string_view::npos)
                return false;
            for (const size_t side : {0, 1})
                any = jumps(tree_.child(id, side), depth + 1) || any;
            return any;
        case NodeKind::call: break;
        default: return false;
        }
        if (!is_built_in(id))
            return false;
        const std::string_view name = called_name(text_, id);
        const size_t arguments = tree_.child_count(id) - 1;
        const bool angle = name == "atan" && arguments == 2;
        const bool part = name == "fract" || name == "mod";
        const bool whole = name == "floor" || name == "ceil" || name == "round" || name == "trunc";
        if (angle || part || whole) {
            if (first_.empty())
                first_ = name;
            angle_ = angle_ || angle;
            part_ = part_ || part;
            whole_ = whole_ || whole;
            if (!angle)
                jumps(tree_.child(id, 1), depth + 1); // one jump inside another
            return true;
        }
        if (class_of_type(name) != TypeClass::floating)
            return false;
        for (size_t i = 1; i <= arguments; ++i)
            any = jumps(tree_.child(id, i), depth + 1) || any;
        return any;
    }

    /// Returns whether the expression has the same value at the look-up: no name in it is set between.
    bool stays(NodeId id) const {
        if (tree_[id].kind == NodeKind::assign || tree_[id].kind == NodeKind::postfix ||
            (tree_[id].kind == NodeKind::call && !is_built_in(id)))
            return false;
        if (tree_[id].kind == NodeKind::name)
            for (NodeId other = 1; other < tree_.nodes.size(); ++other)
                if (tree_[other].begin > tree_[id].begin && tree_[other].begin < tree_[look_up_].begin)
                    for (const std::string_view set : names_set(text_, facts_, other))
                        if (set == text_.word_of(id))
                            return false;
        for (NodeId child = tree_[id].first_child; child != k_no_node; child = tree_[child].next)
            if (!stays(child))
                return false;
        return true;
    }

    std::optional<std::string> written(NodeId id, bool other_angle, int depth = 0) {
        if (depth > k_most_depth)
            return std::nullopt;
        if (!jumps(id))
            return stays(id) ? std::optional(text_.excerpt(id)) : std::nullopt;
        const auto part = [&](size_t index) {
            return written(tree_.child(id, index), other_angle, depth + 1);
        };
        switch (tree_[id].kind) {
        case NodeKind::name: {
            const auto value = written(single_.of(id), other_angle, depth + 1);
            return value ? std::optional("(" + *value + ")") : std::nullopt;
        }
        case NodeKind::parenthesis: {
            const auto inside = part(0);
            return inside ? std::optional("(" + *inside + ")") : std::nullopt;
        }
        case NodeKind::prefix: {
            const auto inside = part(0);
            return inside ? std::optional(std::string(text_.word_of(id)) + "(" + *inside + ")")
                          : std::nullopt;
        }
        case NodeKind::member: {
            const auto inside = part(0);
            return inside ? std::optional(fmt::format("({}).{}", *inside, text_.word_of(id))) : std::nullopt;
        }
        case NodeKind::binary: {
            const auto left = part(0), right = part(1);
            return left && right ? std::optional(fmt::format("{} {} {}", *left, text_.word_of(id), *right))
                                 : std::nullopt;
        }
        default: break;
        }
        const std::string_view name = called_name(text_, id);
        std::vector<std::string> arguments;
        for (size_t i = 1; i < tree_.child_count(id); ++i) {
            auto argument = part(i);
            if (!argument)
                return std::nullopt;
            arguments.push_back(*std::move(argument));
        }
        if (name == "fract" || name == "mod")
            return "(" + arguments[0] + ")";
        if (name == "atan" && arguments.size() == 2)
            return other_angle ? fmt::format("atan(-({}), -({}))", arguments[0], arguments[1])
                               : fmt::format("atan({}, {})", arguments[0], arguments[1]);
        if (class_of_type(name) != TypeClass::floating)
            return fmt::format("(0.0 * ({}))", arguments[0]); // the whole part: flat between its jumps
        return fmt::format("{}({})", name, fmt::join(arguments, ", "));
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    SingleValues single_;
    NodeId look_up_;
    std::string_view first_{}; ///< the function that jumps
    bool angle_ = false, part_ = false, whole_ = false;
};

/// Returns whether the call is a look-up with a named sampler that has mipmaps, and no level or bias.
bool chooses_mipmap(const ParsedText& text, const TreeFacts& facts, NodeId call,
                    const std::function<bool(std::string_view sampler)>& has_mipmaps) {
    const SyntaxTree& tree = text.tree();
    const NodeId sampler = tree.child(call, 1);
    return called_name(text, call) == "texture" && !facts.function("texture") &&
           tree.child_count(call) == 3 && tree[sampler].kind == NodeKind::name &&
           has_mipmaps(text.word_of(sampler));
}

} // namespace

std::vector<JumpingLookUp>
find_jumping_look_ups(const ParsedText& text, const TreeFacts& facts,
                      const std::function<bool(std::string_view sampler)>& has_mipmaps) {
    const SyntaxTree& tree = text.tree();
    const auto reached = functions_of_main(text, facts);
    std::vector<JumpingLookUp> found;
    for (NodeId id = 1; id < tree.nodes.size(); ++id) {
        if (tree[id].kind != NodeKind::call || !chooses_mipmap(text, facts, id, has_mipmaps))
            continue;
        const NodeId function = tree.around(id, NodeKind::function);
        if (function != k_no_node && reached.contains(text.word_of(function)))
            if (auto jumping = SmoothCoordinates(text, facts, id).run())
                found.push_back(*std::move(jumping));
    }
    std::ranges::sort(found, {}, [&](const JumpingLookUp& each) { return tree[each.call].begin; });
    return found;
}

} // namespace tidemark::glsl
