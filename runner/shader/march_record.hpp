// Finds the nodes of a marching loop in a syntax tree, given the loop's lines as the text's SSA form has
// them. Returns an error rather than a guess.
#pragma once

#include "shader/parsed_text.hpp"
#include "shader/tree_facts.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// A marching loop as the SSA form describes it, by lines.
struct MarchLines {
    SourceLocation test;               ///< line of the comparison that tests the distance
    size_t comparisons = 1, which = 0; ///< float comparisons in that line of the loop, and the test's index
                                       ///< among them
    bool distance_is_less = true;      ///< the distance is on the side of the comparison that must be less
    std::vector<SourceLocation> updates{}; ///< lines that advance the position on the ray
    bool at_update = false;                ///< the distance is measured after the step
    bool fixed_steps = false;              ///< the position advances by a constant
    bool in_next_turn = false;             ///< the test reads the distance of the previous iteration
    bool stops_before = true;              ///< a negative distance means past the surface

    bool operator==(const MarchLines& other) const;
};

/// A comparison that ends the loop after a number of iterations when its result is `stopping`.
struct TurnLimit {
    NodeId test = k_no_node;
    bool stopping = false;
};

struct MarchNodes {
    NodeId loop = k_no_node;
    NodeId test = k_no_node;
    NodeId distance = k_no_node, threshold = k_no_node; ///< sides of the test
    bool in_head = false;      ///< the test is in the loop's head, which is evaluated before its body
    std::string place;         ///< the text of the variable that moves along the ray
    bool place_before = false; ///< that variable is declared before the loop
    std::vector<TurnLimit> limits;
};

/// Returns the nodes; the error says what is not certain, and where.
Result<MarchNodes> find_march(const ParsedText& text, const TreeFacts& facts, const MarchLines& lines);

/// Returns the loop's body.
NodeId body_of(const SyntaxTree& tree, NodeId loop);
/// Returns the loop's condition; k_no_node: it has none.
NodeId head_of(const SyntaxTree& tree, NodeId loop);

// Instruments a text so that it records, while mainImage runs, the first marching loop that a pixel enters,
// and returns the record through a generated mainHit (shader/survey.hpp). Text in, text out; the picture
// stays the original's, bit by bit.

/// Name of the float knob that selects the answer of the generated mainHit.
inline constexpr std::string_view k_record_knob = "tidemark_record";
enum class RecordAnswer {
    hit,     ///< as in shader/survey.hpp: x is -1 if the test did not hold at the end
    picture, ///< the colour of mainImage
    march,   ///< place on the ray, number of tested distances, the last distance, its threshold
    fall,    ///< steepest fall of the distance between two samples, per unit of the way, and its place
    steps,   ///< a lens (shader/lens_text.hpp): iterations, marked if the march runs out of them
    /// `hit` and `picture` if the loop may take four times as many iterations.
    hit_with_more,
    picture_with_more,
};

/// Instruments `text`, which is Common and the pass as their authors wrote them. Returns an error if
/// something is not certain or if the text discards pixels. `only`: the only answer of the text, which then
/// needs no knob.
Result<text::MappedText> record_marches(const ParsedText& text, const TreeFacts& facts,
                                        std::span<const MarchLines> marches,
                                        std::optional<RecordAnswer> only = {});

} // namespace tidemark::glsl
