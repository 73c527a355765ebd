// What could be left out of a text: terms, factors, statements, turns of loops, the choice of a texture's
// level, and values that a number could stand for. Places and words only; whether a cut pays, and what it
// does to the picture, is for who draws it.
#pragma once

#include "glsl/cure/written.hpp"
#include "glsl/cut/work_estimate.hpp"
#include "glsl/syntax/types.hpp"

#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

struct Cut {
    Cure change;
    double work = 0;            ///< operations a pixel that it may save, estimated
    bool hangs_on_size = false; ///< what it does to a picture is less the more pixels that has
};

/// An expression of floats that a number could stand for.
struct Replaceable {
    NodeId node = k_no_node;
    ValueType type{};
    double work = 0;
};

class Cutter {
public:
    Cutter(const ParsedText& text, const TreeFacts& facts);

    /// The most work first.
    std::vector<Cut> cuts() const;
    /// One level of its mipmaps for a look-up, whatever its neighbours ask for, of samplers that have any.
    std::vector<Cut> levels(const std::function<bool(std::string_view sampler)>& has_mipmaps) const;
    std::vector<Replaceable> replaceables() const;
    /// `numbers` are those of the expression's type.
    Cut replaced(const Replaceable& expression, std::span<const double> numbers) const;

    /// Loops that nothing in their heads ends: all that they depend on in their bodies and in the functions
    /// called there is left alone, for without it they may never end.
    const std::vector<NodeId>& endless() const { return endless_; }
    const WorkEstimate& work() const { return work_; }

private:
    void find_kept();
    void mark_kept(std::set<std::string_view>& called);
    bool is_kept(NodeId id) const;
    bool is_cheap(NodeId id) const;
    void add_operands(NodeId id, std::vector<Cut>& cuts) const;
    void add_statement(NodeId id, std::vector<Cut>& cuts) const;
    void add_turns(NodeId loop, std::vector<Cut>& cuts) const;
    void add(std::optional<WrittenTokens> tokens, std::string instead, std::string reason, double work,
             std::vector<Cut>& cuts) const;
    double work_of_call(NodeId id) const;
    std::optional<ValueType> type_of(NodeId id) const;
    std::string place_of(NodeId id) const;

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    WorkEstimate work_;
    std::vector<NodeId> endless_;
    std::vector<bool> kept_; ///< by node
};

} // namespace tidemark::glsl
