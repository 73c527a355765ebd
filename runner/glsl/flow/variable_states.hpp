// The variables that a way through a text has met, and which of their parts it has assigned. Who follows the
// ways (assigned.cpp) tells it of declarations, reads and writes, and of where ways part and meet.
#pragma once

#include "glsl/flow/assigned.hpp"

#include <string_view>
#include <unordered_map>
#include <vector>

namespace tidemark::glsl {

/// What a way has assigned, by place on the stack of variables.
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

/// Where no way leads: what meets it stays what it is.
inline State nowhere(size_t depth) {
    return {std::vector<Slots>(depth, ~Slots(0)), false};
}

/// What a call does to the global variables, by their numbers.
struct Summary {
    std::vector<Slots> reads; ///< before it assigns them itself
    std::vector<NodeId> places;
    std::vector<Slots> assigns; ///< on every way
};

class VariableStates {
protected:
    VariableStates(const ParsedText& text, Shapes& shapes)
        : text_(text), tree_(text.tree()), shapes_(shapes), scopes_(1) {}

    static constexpr size_t k_untracked = size_t(-1);

    /// `unset`: without a value. What has one is not followed.
    void declare(NodeId type, NodeId declared, bool unset);
    bool has_value(NodeId declared) const;
    /// Follows none of those declared so far any further.
    void forget();

    struct Found {
        size_t place = k_untracked;
        Part part;
    };
    Found find(NodeId id);
    UnsetVariable& variable(size_t place) { return variables_[live_[place]]; }

    void read(NodeId id);
    /// Some `slots` of the variable at `place` are read.
    void need(size_t place, Slots slots, NodeId at);
    /// `doubtful`: or not.
    void write(NodeId id, bool doubtful = false);

    void open();
    void close();

    using Scope = std::unordered_map<std::string_view, size_t>;
    /// What is seen in the midst of one function.
    struct Sight {
        std::vector<size_t> live;
        std::vector<Scope> scopes;
        State state;
        Summary summary;
    };
    /// Into another function, where only globals are seen; and back.
    Sight enter();
    void leave(Sight outer);
    /// One that reads and assigns nothing.
    Summary empty_summary() const;

    const ParsedText& text_;
    const SyntaxTree& tree_;
    Shapes& shapes_;
    std::vector<UnsetVariable> variables_;
    size_t globals_ = 0;       ///< the first of live_
    std::vector<size_t> live_; ///< variables that are seen here, by number
    State state_;
    Summary summary_;
    bool runs_ = true; ///< what is being followed

private:
    size_t place_of(NodeId name) const;

    std::vector<Scope> scopes_; ///< places in live_
    std::vector<size_t> depths_;
};

} // namespace tidemark::glsl
