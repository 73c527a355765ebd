// Generates the terrain of shaders/stylized_waves.glsl, and bakes heights into the picture that waves rolling
// in from a circle need. Reads and writes no file.
#pragma once

#include "bake/fast_marching.hpp"
#include "base/error.hpp"
#include "media/image.hpp"

#include <cstdint>

namespace tidemark::bake {

/// The terrain: an island with bays and hills, an islet, rocks that stand out of the water, and the sea's
/// floor.
inline constexpr uint32_t k_island_seed = 7;
inline constexpr double k_island_extent = 64.0; ///< metres

/// Returns heights above the sea at `side` x `side` nodes; every `side` samples the same terrain. The open
/// sea, 5 m deep, begins 27 m from the centre. The same seed gives the same bits on every machine.
HeightMap make_island(int side, uint32_t seed = k_island_seed);

/// Nodes per side of a map that can be baked, and the circle's radius as a part of half its extent: at the
/// smallest size two nodes fit between the circle and the edge.
inline constexpr int k_least_side = 64;
inline constexpr int k_largest_side = 4096;
inline constexpr double k_largest_metres = 10000.0; ///< for extent and height: half floats end at 65504
inline constexpr double k_circle_part = 15.0 / 16.0;

inline double circle_radius(const HeightMap& map) {
    return 0.5 * k_circle_part * map.extent;
}

/// Metres of detour at which the wave mask starts to fall, and at which it is 0.
inline constexpr double k_detour_from = 0.05;
inline constexpr double k_detour_to = 0.45;

/// Returns a picture in RGBA, f32, all finite, one texel per node:
/// * R, path distance: metres of the shortest path over water from the circle; below 0 outside of it. On land
///   and lakes it continues from the nearest shore, so that a look-up at the waterline finds no jump.
/// * G, wave mask: 1 where the path is as long as the straight line, 0 where it has a detour of k_detour_to
///   or more.
/// * B, depth: metres from sea level down to the floor, 0 on land.
/// * A, height: metres above sea level, below 0 under water.
///
/// Heights must be finite. Fails (ErrorCode::load; the message names no file) if there is no water, or if
/// there is land on the circle.
Result<image::Image> bake_wave_map(const HeightMap& map);

/// Returns heights in metres from a picture's first channel v: `metres` * (v - `sea`). Fails
/// (ErrorCode::load) if the picture is not square, too small or too large, or if a height is not finite or
/// beyond k_largest_metres.
Result<HeightMap> heights_from(const image::Image& picture, double extent, double sea, double metres);

} // namespace tidemark::bake
