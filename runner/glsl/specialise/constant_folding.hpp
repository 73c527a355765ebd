// Finds conditions whose outcome is known before the program runs: comparisons of literals, constants and
// knobs at their current values. Exact: a value that needs rounding counts as unknown.
#pragma once

#include "glsl/specialise/globals.hpp"
#include "scene/knob.hpp"

#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>

namespace tidemark::glsl {

class ConstantFolding {
public:
    /// `variables` are those of the whole text. Keeps references to its arguments.
    ConstantFolding(const ParsedText& text, const Variables& variables, std::span<const scene::Knob> knobs)
        : text_(text), tree_(text.tree()), variables_(variables), knobs_(knobs) {}

    /// Returns nothing if the outcome is not known.
    std::optional<bool> outcome(NodeId condition) const;

private:
    enum class Kind { truth, whole, floating };
    struct Value {
        Kind kind;
        double number; ///< holds every int and every float
    };
    using Known = std::optional<Value>;

    Known evaluate(NodeId expression) const;
    Known literal(std::string_view digits) const;
    Known name(std::string_view name) const;
    Known constant(const Variable& variable) const;
    Known member(NodeId member) const;
    Known prefix(NodeId prefix) const;
    Known binary(NodeId binary) const;
    static Known compare(std::string_view op, const Value& a, const Value& b);
    static Known compute(std::string_view op, const Value& a, const Value& b);
    static Known knob_value(const scene::Knob& knob, int component);
    const scene::Knob* find_knob(std::string_view name) const;

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const Variables& variables_;
    std::span<const scene::Knob> knobs_;
    mutable std::unordered_map<std::string_view, Known> constants_; ///< computed so far
    mutable int constants_open_ = 0;                                ///< number of constants under evaluation
};

} // namespace tidemark::glsl
