// Lists the declarations at the outermost level of a text and finds those that `main` can reach. Works by
// name: a token with the name of a global reaches every global of that name, whatever it means there.
#pragma once

#include "shader/parsed_text.hpp"
#include "shader/vocabulary.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace tidemark::glsl {

/// A function (definition or prototype) or a declaration at the outermost level.
struct Global {
    NodeId node = k_no_node;
    NodeId first = k_no_node; ///< its nodes are [first, node]
    std::vector<std::string_view> names{};
    /// Kept even if unused: main, inputs and outputs, and declarations whose initialisers have side effects.
    bool root = false;
};

/// Returns the globals in the order of the text.
std::vector<Global> find_globals(const ParsedText& text);

/// Returns for each global whether it is reached; `kept` globals, in the order of `globals`, always are.
std::vector<bool> find_reached(const ParsedText& text, const std::vector<Global>& globals,
                               const std::vector<bool>& kept);

/// A variable's declaration, and how often its name is declared (in several scopes).
struct Variable {
    NodeId type = k_no_node;
    NodeId declared = k_no_node; ///< declarator or parameter
    unsigned times = 0;
};
using Variables = std::unordered_map<std::string_view, Variable>;

/// Returns the text with the values of global variables assigned at the start of `main`: glslang 12 crashes
/// when it writes debug information for a value outside of functions. If there is such a variable, macros are
/// expanded and #line directives keep the line numbers; otherwise the text is unchanged.
std::string assign_globals_in_main(const ParsedText& text);

// Finds the expressions of a function that have one value for the whole frame: those of uniforms, constants,
// literals, functions that only compute, and local variables that get such a value and no other.

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

    /// Decides by an identifier and whether it is a member or swizzle.
    using Refused = std::function<bool(std::string_view, bool member)>;
    /// Returns the text of an expression with local variables replaced by their values. Returns nothing if it
    /// is longer than `longest` characters, or if `refused` accepts one of its identifiers.
    std::optional<std::string> spelled(NodeId expression, size_t longest, const Refused& refused,
                                       int depth = 0) const;

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
    bool is_operation(size_t word) const;

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
