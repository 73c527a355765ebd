// Which expressions of a function have one value for the whole frame: those of uniforms, constants, literals
// and functions that only compute, and of local variables that are given such a value and no other.
#pragma once

#include "glsl/specialise/globals.hpp"
#include "glsl/syntax/types.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace tidemark::glsl {

/// What is known of an expression that has one value for the whole frame.
struct FrameValue {
    ValueType type;
    bool uniform = false; ///< reads one; else it is a constant, which a compiler works out itself
    bool costly = false;
};

/// A function of the author's that reads nothing but its arguments and what is constant during a frame.
struct PureFunction {
    ValueType type;
    bool uniform = false;
    bool costly = false;
};

class UniformExpressions {
public:
    UniformExpressions(const ParsedText& text, const std::vector<Global>& globals);

    /// Looks at one function; what was known of another is forgotten.
    void enter(const Global& function);
    /// Of an expression in that function; nothing: it may have several values in a frame.
    std::optional<FrameValue> value(NodeId expression) const;

    /// A local variable of that function that is given its one value where it is declared.
    struct Alias {
        NodeId value;
        ValueType type;
    };
    const Alias* alias(std::string_view name) const;

private:
    using Value = std::optional<FrameValue>;

    void read_globals(const std::vector<Global>& globals);
    void find_written(NodeId first, NodeId last);
    void find_aliases(NodeId declaration);
    Value evaluate(NodeId expression) const;
    Value name(std::string_view name) const;
    Value call(NodeId call) const;
    Value call_of(std::string_view callee, std::span<const ValueType> arguments) const;
    std::optional<PureFunction> pure_function(std::string_view name) const;
    std::optional<PureFunction> examine(const Global& function) const;
    bool writes_through_arguments(std::string_view name) const;
    bool is_callee(NodeId name) const;

    const ParsedText& text_;
    const SyntaxTree& tree_;
    std::unordered_map<std::string_view, std::vector<const Global*>> functions_;
    Variables globals_;                                        ///< variables
    std::unordered_map<std::string_view, FrameValue> settled_; ///< those that have one value for the frame
    mutable std::unordered_map<std::string_view, std::optional<PureFunction>> pure_;
    mutable int functions_open_ = 0; ///< that are being examined
    NodeId first_ = 1;               ///< nodes of the function that was entered
    std::vector<Value> values_;
    Variables locals_;
    std::unordered_set<std::string_view> written_;
    std::unordered_map<std::string_view, Alias> aliases_;
};

} // namespace tidemark::glsl
