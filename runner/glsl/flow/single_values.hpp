// The one value of a variable that is declared with it and never changed.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace tidemark::glsl {

class SingleValues {
public:
    SingleValues(const ParsedText& text, const TreeFacts& facts);

    /// The expression that `name` is declared with, where its function, or the text outside of functions,
    /// declares it once and nothing sets it; k_no_node else, and of what is no name. What the expression is
    /// made of may be another by then, and may have the same name (`float x = 2.0 * x`).
    NodeId of(NodeId name) const;

private:
    /// A name in a function; k_no_node: outside of all.
    using Place = std::pair<NodeId, std::string_view>;
    struct Declared {
        NodeId node = k_no_node; ///< declarator or parameter
        int times = 0;
    };

    const ParsedText& text_;
    std::map<Place, Declared> declared_{};
    std::set<Place> set_{};
    std::set<std::string_view> set_somewhere_{};
};

} // namespace tidemark::glsl
