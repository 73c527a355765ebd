// Proposals of `simplify`: cost estimates, cuts, buffers at half size, hoisted expressions.
//
// Estimates the operations per pixel of each part of a text, from the text alone: every branch is taken, and
// loops without a literal bound count sixteen iterations. Good enough to order what to try first, and for
// nothing else.
#pragma once

#include "shader/parsed_text.hpp"
#include "shader/source_edits.hpp"
#include "shader/tree_facts.hpp"
#include "shader/vocabulary.hpp"

#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>
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

// Proposes what could be left out of a text: terms, factors, statements, factors where the other one is 0,
// iterations of loops (all after a number, or those after a march's step is small or large), the limits that
// end a loop, the length of a march's steps, the choice of a texture's level, and values that a number could
// replace. Returns edits only; the caller measures what a cut saves and what it does to the picture.

struct Cut {
    Cure change;
    double work = 0;            ///< estimated operations per pixel that it may save
    bool keeps_values = false;  ///< all values stay, but for a driver's rounding
    bool hangs_on_size = false; ///< the more pixels the picture has, the less the cut changes it
    double chance = 1;          ///< rough probability that it keeps the picture; orders the trials
    /// Cuts of one family change the same thing, a stronger one more. Empty: it has none.
    std::string family{};
    double strength = 0;
    /// The cut as a choice at run time: `$` in the texts stands for a bool that is true if the cut is made,
    /// `@` for a number that no other cut has. Empty: there is no such form.
    std::vector<Wrap> switched{};
};

/// A float expression that a number could replace.
struct Replaceable {
    NodeId node = k_no_node;
    ValueType type{};
    double work = 0;
};

class Cutter {
public:
    Cutter(const ParsedText& text, const TreeFacts& facts);

    /// Returns the cuts, those that save the most work first.
    std::vector<Cut> cuts() const;
    /// Returns cuts that give a look-up one fixed mipmap level, for samplers that have mipmaps.
    std::vector<Cut> levels(const std::function<bool(std::string_view sampler)>& has_mipmaps) const;
    std::vector<Replaceable> replaceables() const;
    /// Returns the cut that replaces the expression; `numbers` has one value per component of its type.
    Cut replaced(const Replaceable& expression, std::span<const double> numbers) const;

    /// Loops without a bound in their heads. Everything in their bodies, and in the functions called there,
    /// is kept, because without it they may never end.
    const std::vector<NodeId>& endless() const { return endless_; }
    const WorkEstimate& work() const { return work_; }

private:
    void find_kept();
    void mark_kept(std::set<std::string_view>& called);
    bool is_kept(NodeId id) const;
    bool is_cheap(NodeId id) const;
    void add_operands(NodeId id, std::vector<Cut>& cuts) const;
    void add_statement(NodeId id, std::vector<Cut>& cuts) const;
    void add_guards(NodeId id, std::vector<Cut>& cuts) const;
    void add_turns(NodeId loop, std::vector<Cut>& cuts) const;
    void add_exits(NodeId step, std::vector<Cut>& cuts) const;
    void add_longer_steps(NodeId step, NodeId loop, std::vector<Cut>& cuts) const;
    void add_limits(NodeId test, const SingleValues& values, std::vector<Cut>& cuts) const;
    NodeId loop_left_by(NodeId test) const;
    NodeId step_value(NodeId id) const;
    bool may_be_scalar(NodeId id) const;
    bool is_computed_in(NodeId loop, std::string_view name) const;
    NodeId loop_around(NodeId id) const;
    void add(std::optional<WrittenTokens> tokens, std::string instead, std::string reason, double work,
             std::vector<Cut>& cuts, std::optional<Wrap> switched) const;
    std::optional<Wrap> switched_operand(NodeId id, NodeId rest, int neutral) const;
    double work_of_call(NodeId id) const;
    std::optional<ValueType> type_of(NodeId id) const;
    std::string place_of(NodeId id) const;
    std::string family_of(std::string_view what, NodeId id) const;
    double chance_without(double work, double chance) const;

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    WorkEstimate work_;
    double whole_ = 0; ///< operations of the whole text
    std::vector<NodeId> endless_;
    std::vector<bool> kept_; ///< per node
};

// Proposes drawing a buffer at half its width and height. ShaderToy gives every buffer the picture's size, so
// the buffer is drawn into one quarter of that, and passes that read it look there (pass_cuts.cpp).

/// A sampler of the buffer. It has no mipmaps and does not mirror.
struct BufferSampler {
    std::string_view name;
    bool repeats = false; ///< otherwise it clamps
};

/// A pass of the scene, and the samplers with which it reads the buffer.
struct BufferReader {
    const ParsedText& text;
    const TreeFacts& facts;
    std::vector<BufferSampler> samplers;
};

/// Returns the cut for `passes[buffer]`, which must not read itself. Returns nothing if the buffer is read by
/// other means than look-ups, if it uses gl_FragCoord, or if the cut would change a file that another pass
/// shares.
std::optional<Cut> half_size(std::span<const BufferReader> passes, size_t buffer, const WorkEstimate& work);

// Moves expressions that have one value for the whole frame out of loops and calls into global variables that
// mainImage computes first. A text can do no better: ShaderToy has no place that runs once per frame.

/// Returns one cut with all such expressions of mainImage's file, or nothing if there are none. The language
/// guarantees the same values; a driver may round differently.
std::optional<Cut> once_a_pixel(const ParsedText& text, const TreeFacts& facts, const WorkEstimate& work);

} // namespace tidemark::glsl
