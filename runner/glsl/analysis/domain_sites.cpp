#include "glsl/analysis/domain_sites.hpp"

#include "glsl/analysis/float_operation.hpp"
#include "glsl/syntax/builtin_functions.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

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

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
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

class Finder {
public:
    Finder(const ParsedText& text, const TreeFacts& facts) : text_(text), tree_(text.tree()), facts_(facts) {}

    std::vector<DomainSite> run(DomainScope scope) {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            if (!is_expression(tree_[id].kind) || must_stay_constant(text_, id))
                continue;
            if (is_float_site(id))
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
        if (is_one_of(op, {"<<", ">>", "<<=", ">>="})) {
            if (!number || *number < 0 || *number > 31)
                add(id, DomainKind::shift);
        } else if (is_one_of(op, {"%", "%="}) ||
                   (is_one_of(op, {"/", "/="}) && facts_.surely_whole[tree_.child(id, 0)] &&
                    facts_.surely_whole[right])) {
            if (!number || *number == 0)
                add(id, DomainKind::divisor);
        } else if (is_one_of(op, {"/", "/="}) && facts_.surely_whole[tree_.child(id, 0)] && !number) {
            add(id, DomainKind::quotient); // `7 / s.n`: the driver's overload resolution finds the type
        } else if (is_one_of(op, {"<", ">", "<=", ">="}) ||
                   (is_one_of(op, {"==", "!="}) && (number || number_of(text_, tree_.child(id, 0))))) {
            if (!counts(id))
                add(id, DomainKind::comparison);
        }
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
    return Finder(text, facts).run(scope);
}

} // namespace tidemark::glsl
