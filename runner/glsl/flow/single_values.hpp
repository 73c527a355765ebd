// Finds the single value of a variable that is initialised in its declaration and never changed.
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

    /// Returns the initialiser of `name` if its function (or the global scope) declares it once and nothing
    /// assigns it; k_no_node otherwise, and for a node that is not a name. Variables in that expression may
    /// have changed since, and may have the same name (`float x = 2.0 * x`).
    NodeId of(NodeId name) const;

private:
    /// A name in a function; k_no_node stands for the global scope.
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
