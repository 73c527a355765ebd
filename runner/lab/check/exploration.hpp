// Looks for situations in which a scene's numbers break: moments, knobs and places of the mouse by lot and at
// the numbers of the text, then towards the edge of each function's domain and the other way of each
// comparison, as the watched text reports how near they came; and the pixels of a large picture around the
// nearest. The same scene is searched in the same way each time, as far as its patience reaches: it proves
// nothing where it finds nothing.
#pragma once

#include "lab/check/explored.hpp"
#include "lab/check/probe_bench.hpp"

namespace tidemark::lab {

/// Once for a bench; what it saw then stays there.
Result<const Explored*> explore(ProbeBench& bench);

} // namespace tidemark::lab
