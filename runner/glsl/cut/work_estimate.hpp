// How many operations a pixel the parts of a text may take, estimated from the text alone: every branch is
// taken, loops without a number turn sixteen times. Good enough to say what to look at first, and for nothing
// else.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <string_view>
#include <unordered_map>
#include <vector>

namespace tidemark::glsl {

class WorkEstimate {
public:
    WorkEstimate(const ParsedText& text, const TreeFacts& facts);

    /// Of one evaluation, calls and loops included.
    double once(NodeId id) const { return once_[id]; }
    /// Of a pixel: as often as it is come to.
    double of(NodeId id) const { return once_[id] * times_[id]; }

private:
    double own(NodeId id) const;
    void add_up();
    void count_times();

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    std::vector<double> once_, times_;
    std::unordered_map<std::string_view, double> functions_; ///< work of one call
};

} // namespace tidemark::glsl
