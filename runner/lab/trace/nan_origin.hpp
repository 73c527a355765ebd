// An operation of a syntax tree as its author knows it: text, place, what it belongs to, what it computed
// with.
#pragma once

#include "glsl/instrument/watch.hpp"
#include "lab/trace/nan_trace.hpp"
#include "scene/scene.hpp"

namespace tidemark::lab {

/// A text that is watched, and what it declares.
struct WatchedText {
    const glsl::ParsedText& text;
    const glsl::TreeFacts& facts;
};

/// What can be said without running it.
NanOrigin describe(const WatchedText& watched, glsl::NodeId operation);

/// Adds what the shader wrote down: values, loops and calls, and why it is so.
void add_reading(NanOrigin& origin, const WatchedText& watched, glsl::NodeId operation,
                 const glsl::Watch& watch, const WatchReading& reading, const scene::Scene& scene,
                 const scene::Pass& pass);

/// So much of an excerpt as a sentence takes.
std::string shortened(std::string text);

/// The name behind `a`, `a.xy`, `a[i]`, `(a)`; empty for anything else.
std::string_view base_name(const WatchedText& watched, glsl::NodeId expression);

/// The operands of an operation, those included that have no slot.
std::vector<glsl::NodeId> operands(const WatchedText& watched, glsl::NodeId operation);

} // namespace tidemark::lab
