// Estimates the operations per pixel of each part of a text, from the text alone: every branch is taken, and
// loops without a literal bound count sixteen iterations. Good enough to order what to try first, and for
// nothing else.
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

    /// Returns the operations of one evaluation, calls and loops included.
    double once(NodeId id) const { return once_[id]; }
    /// Returns the operations per pixel: `once` times the number of evaluations.
    double of(NodeId id) const { return once_[id] * times_[id]; }

private:
    double own(NodeId id) const;
    void add_up();
    void count_times();

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    std::vector<double> once_, times_;
    std::unordered_map<std::string_view, double> functions_; ///< operations of one call
};

} // namespace tidemark::glsl
