// Chooses pixels to sample if not all can be.
#pragma once

#include <cstddef>

namespace tidemark::lab {

/// Returns the i-th element of a permutation of 0 to count - 1 whose every prefix is evenly spread (steps of
/// the golden section).
size_t spread(size_t i, size_t count);

} // namespace tidemark::lab
