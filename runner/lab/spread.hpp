// Which pixels to look at where not all can be.
#pragma once

#include <cstddef>

namespace tidemark::lab {

/// The i-th of a walk through 0 to count - 1 that comes to each once and is evenly spread at any time: steps
/// of the golden section.
size_t spread(size_t i, size_t count);

} // namespace tidemark::lab
