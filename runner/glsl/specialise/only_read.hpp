// Which functions change nothing but their own variables: two calls of such may run in any order, or at once.
#pragma once

#include "glsl/specialise/globals.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace tidemark::glsl {

/// The overloads of one name, taken together.
struct Reader {
    int definitions = 0;
    int known = 0;                ///< of them, those that were looked at and change nothing else
    const Global* last = nullptr; ///< definition
    bool costly = false;          ///< calls what takes long, if only through others
    bool only_reads() const { return definitions > 0 && known == definitions; }
};

class OnlyRead {
public:
    OnlyRead(const ParsedText& text, const std::vector<Global>& globals);

    /// Null: the author has no function of that name.
    const Reader* function(std::string_view name) const;
    bool is_global_variable(std::string_view name) const { return variables_.contains(name); }
    /// Whether the nodes [first, last] change no variable but `locals`, and nothing else, either.
    bool changes_only(NodeId first, NodeId last, const Variables& locals) const;

private:
    void look_at(const Global& function);
    bool may_call(NodeId call, const Variables& locals) const;
    bool is_local(NodeId target, const Variables& locals) const;

    const ParsedText& text_;
    const SyntaxTree& tree_;
    TreeFacts facts_;
    std::unordered_map<std::string_view, Reader> functions_;
    std::unordered_set<std::string_view> variables_; ///< global
};

} // namespace tidemark::glsl
