// Generates the terrain of shaders/stylized_waves.glsl from a seed: an island with bays and hills, an islet,
// rocks that stand out of the water, and the sea's floor. Uses no file and makes no waves.
#pragma once

#include "bake/height_map.hpp"

#include <cstdint>

namespace tidemark::bake {

inline constexpr uint32_t k_island_seed = 7;
inline constexpr double k_island_extent = 64.0; ///< metres

/// Returns heights above the sea at `side` x `side` nodes; every `side` samples the same terrain. The open
/// sea, 5 m deep, begins 27 m from the centre. The same seed gives the same bits on every machine.
HeightMap make_island(int side, uint32_t seed = k_island_seed);

} // namespace tidemark::bake
