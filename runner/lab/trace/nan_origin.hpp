// Describes an operation of a syntax tree as its author wrote it: text, place, context, and the values it
// computed with.
#pragma once

#include "glsl/instrument/watch.hpp"
#include "lab/trace/nan_trace.hpp"
#include "scene/scene.hpp"

namespace tidemark::lab {

/// An instrumented text and its facts.
struct WatchedText {
    const glsl::ParsedText& text;
    const glsl::TreeFacts& facts;
};

/// Returns what the text alone says about the operation: place, text, statement, variable and function.
NanOrigin describe(const WatchedText& watched, glsl::NodeId operation);

/// Adds what the shader recorded (values, loops and calls) and the explanation.
void add_reading(NanOrigin& origin, const WatchedText& watched, glsl::NodeId operation,
                 const glsl::Watch& watch, const WatchReading& reading, const scene::Scene& scene,
                 const scene::Pass& pass);

/// Shortens an excerpt to at most 80 bytes, with an ellipsis at the end if it was cut.
std::string shortened(std::string text);

/// Returns the variable's name in `a`, `a.xy`, `a[i]` and `(a)`; empty for other expressions.
std::string_view base_name(const WatchedText& watched, glsl::NodeId expression);

/// Returns the operands of an operation, including those without a slot.
std::vector<glsl::NodeId> operands(const WatchedText& watched, glsl::NodeId operation);

} // namespace tidemark::lab
