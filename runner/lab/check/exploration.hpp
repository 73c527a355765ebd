// Searches for situations in which a scene's numbers break: random moments, knobs and mouse positions and
// those from the text's numbers, then steps towards the edge of each function's domain and towards the other
// outcome of each comparison, guided by an instrumented text, then the pixels of a large picture around the
// nearest ones. The search is deterministic up to its time limit. Finding nothing proves nothing.
#pragma once

#include "lab/check/explored.hpp"
#include "lab/check/probe_bench.hpp"

namespace tidemark::lab {

/// Searches once per bench; later calls return the stored result, which the bench owns.
Result<const Explored*> explore(ProbeBench& bench);

} // namespace tidemark::lab
