// State of the variables along a path through a text: which of their parts are assigned. The class that walks
// the paths (Follower) reports declarations, reads, writes, branches and joins.
#pragma once

#include "glsl/flow/assigned.hpp"

#include <string_view>
#include <unordered_map>
#include <vector>

namespace tidemark::glsl {

/// Parts that a path has assigned, by index in the stack of live variables.
struct State {
    std::vector<Slots> set;
    bool reached = true;

    void meet(const State& other) {
        if (!other.reached)
            return;
        if (!reached) {
            const size_t size = std::min(set.size(), other.set.size());
            *this = other;
            set.resize(size);
            return;
        }
        for (size_t i = 0; i < set.size(); ++i)
            set[i] &= other.set[i];
    }
};

/// Returns the state of unreachable code; meeting it leaves the other state unchanged.
inline State nowhere(size_t depth) {
    return {std::vector<Slots>(depth, ~Slots(0)), false};
}

/// Effect of a call on global variables, by their index.
struct Summary {
    std::vector<Slots> reads; ///< read before the function assigns them
    std::vector<NodeId> places; ///< first such read of each
    std::vector<Slots> assigns; ///< on every path
};

class VariableStates {
protected:
    VariableStates(const ParsedText& text, Shapes& shapes)
        : text_(text), tree_(text.tree()), shapes_(shapes), scopes_(1) {}

    static constexpr size_t k_untracked = size_t(-1);

    /// Declares a variable. Only those that are `unset` (declared without a value) are tracked.
    void declare(NodeId type, NodeId declared, bool unset);
    bool has_value(NodeId declared) const;
    /// Stops tracking all variables declared so far.
    void forget();

    struct Found {
        size_t place = k_untracked;
        Part part;
    };
    Found find(NodeId id);
    UnsetVariable& variable(size_t place) { return variables_[live_[place]]; }

    void read(NodeId id);
    /// Records a read of some `slots` of the variable at `place`.
    void need(size_t place, Slots slots, NodeId at);
    /// Records a write; `doubtful` if it may not happen.
    void write(NodeId id, bool doubtful = false);

    void open();
    void close();

    using Scope = std::unordered_map<std::string_view, size_t>;
    /// Everything visible inside one function, saved during a call.
    struct Sight {
        std::vector<size_t> live;
        std::vector<Scope> scopes;
        State state;
        Summary summary;
    };
    /// Enters another function, where only globals are visible; leave() restores the state.
    Sight enter();
    void leave(Sight outer);
    /// Returns the summary of a function that reads and assigns nothing.
    Summary empty_summary() const;

    const ParsedText& text_;
    const SyntaxTree& tree_;
    Shapes& shapes_;
    std::vector<UnsetVariable> variables_;
    size_t globals_ = 0;       ///< the globals come first in live_
    std::vector<size_t> live_; ///< indices of the variables that are visible here
    State state_;
    Summary summary_;
    bool runs_ = true; ///< the current function is reached from main

private:
    size_t place_of(NodeId name) const;

    std::vector<Scope> scopes_; ///< indices in live_
    std::vector<size_t> depths_;
};

} // namespace tidemark::glsl
