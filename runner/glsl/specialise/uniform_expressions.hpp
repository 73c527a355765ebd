// Finds the expressions of a function that have one value for the whole frame: those of uniforms, constants,
// literals, functions that only compute, and local variables that get such a value and no other.
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

/// Type and cost of an expression that has one value for the whole frame.
struct FrameValue {
    ValueType type;
    bool uniform = false; ///< reads a uniform; otherwise it is a constant, which a compiler evaluates itself
    bool costly = false;
};

/// An author's function that reads only its arguments and values that are constant during a frame.
struct PureFunction {
    ValueType type;
    bool uniform = false;
    bool costly = false;
};

class UniformExpressions {
public:
    UniformExpressions(const ParsedText& text, const std::vector<Global>& globals);

    /// Analyses one function and discards the results for the previous one.
    void enter(const Global& function);
    /// Returns the value of an expression in that function; nothing: it may have several values in a frame.
    std::optional<FrameValue> value(NodeId expression) const;

    /// A local variable of that function that gets its only value in its declaration.
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
    Variables globals_;                                        ///< global variables
    std::unordered_map<std::string_view, FrameValue> settled_; ///< names with one value for the frame
    mutable std::unordered_map<std::string_view, std::optional<PureFunction>> pure_;
    mutable int functions_open_ = 0; ///< functions that are being examined
    NodeId first_ = 1;               ///< first node of the entered function
    std::vector<Value> values_;
    Variables locals_;
    std::unordered_set<std::string_view> written_;
    std::unordered_map<std::string_view, Alias> aliases_;
};

} // namespace tidemark::glsl
