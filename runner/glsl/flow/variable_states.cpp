#include "glsl/flow/variable_states.hpp"

#include "glsl/syntax/tree_facts.hpp"

#include <algorithm>
#include <iterator>

namespace tidemark::glsl {

void VariableStates::declare(NodeId type, NodeId declared, bool unset) {
    size_t place = k_untracked;
    if (unset) {
        const Shape& shape = shapes_.of(type, declared);
        if (shape.can_be_zero()) {
            place = live_.size();
            live_.push_back(variables_.size());
            variables_.push_back({.type = type, .declared = declared, .shape = &shape, .runs = runs_});
            state_.set.push_back(state_.reached ? 0 : ~Slots(0));
        }
    }
    scopes_.back()[text_.word_of(declared)] = place;
}

bool VariableStates::has_value(NodeId declared) const {
    const auto parts = tree_.children(declared);
    return std::ranges::any_of(parts, [&](NodeId part) { return !is_bracket(text_, part); });
}

void VariableStates::forget() {
    for (Scope& scope : scopes_)
        for (auto& [name, place] : scope)
            place = k_untracked;
    live_.clear();
    state_.set.clear();
}

size_t VariableStates::place_of(NodeId name) const {
    for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope)
        if (const auto found = scope->find(text_.word_of(name)); found != scope->end())
            return found->second;
    return k_untracked;
}

VariableStates::Found VariableStates::find(NodeId id) {
    const NodeId base = base_of(tree_, id);
    Found found;
    if (tree_[base].kind == NodeKind::name)
        found.place = place_of(base);
    if (found.place != k_untracked)
        found.part = shapes_.part_of(*variable(found.place).shape, id);
    return found;
}

void VariableStates::read(NodeId id) {
    const Found found = find(id);
    if (found.place != k_untracked)
        need(found.place, found.part.slots, id);
}

void VariableStates::need(size_t place, Slots slots, NodeId at) {
    const Slots missing = slots & ~state_.set[place];
    if (!state_.reached || missing == 0)
        return;
    if (place < globals_) {
        summary_.reads[place] |= missing;
        if (summary_.places[place] == k_no_node)
            summary_.places[place] = at;
    } else if (variable(place).read == k_no_node) {
        variable(place).read = at;
    }
}

void VariableStates::write(NodeId id, bool doubtful) {
    const Found found = find(id);
    if (found.place == k_untracked)
        return;
    variable(found.place).written = true;
    if (doubtful)
        variable(found.place).doubtful = true;
    else if (found.part.exact)
        state_.set[found.place] |= found.part.slots;
}

void VariableStates::open() {
    scopes_.emplace_back();
    depths_.push_back(live_.size());
}

void VariableStates::close() {
    scopes_.pop_back();
    live_.resize(depths_.back());
    state_.set.resize(depths_.back());
    depths_.pop_back();
}

VariableStates::Sight VariableStates::enter() {
    Sight outer{std::move(live_), {}, std::move(state_), std::move(summary_)};
    outer.scopes.assign(std::make_move_iterator(scopes_.begin() + 1), std::make_move_iterator(scopes_.end()));
    scopes_.resize(1);
    live_.resize(globals_);
    for (size_t i = 0; i < globals_; ++i)
        live_[i] = i;
    state_ = {std::vector<Slots>(globals_, 0), true};
    summary_ = empty_summary();
    return outer;
}

void VariableStates::leave(Sight outer) {
    live_ = std::move(outer.live);
    state_ = std::move(outer.state);
    summary_ = std::move(outer.summary);
    for (Scope& scope : outer.scopes)
        scopes_.push_back(std::move(scope));
}

Summary VariableStates::empty_summary() const {
    return {std::vector<Slots>(globals_), std::vector<NodeId>(globals_, k_no_node),
            std::vector<Slots>(globals_)};
}

} // namespace tidemark::glsl
