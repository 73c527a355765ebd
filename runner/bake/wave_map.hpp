// What waves that roll in from a circle need to know of the water: baked from heights into one picture. No
// file.
#pragma once

#include "bake/height_map.hpp"
#include "base/result.hpp"
#include "image/image.hpp"

#include <string>

namespace tidemark::bake {

/// Nodes a side of a map that can be baked, and the circle's part of half its extent: at the least size two
/// nodes fit between the circle and the edge.
inline constexpr int k_least_side = 64;
inline constexpr int k_largest_side = 4096;
inline constexpr double k_largest_metres = 10000.0; ///< of extent and height: half floats end at 65504
inline constexpr double k_circle_part = 15.0 / 16.0;

inline double circle_radius(const HeightMap& map) {
    return 0.5 * k_circle_part * map.extent;
}

/// Of the wave mask: metres of detour that are none yet, and that leave nothing of a wave.
inline constexpr double k_detour_from = 0.05;
inline constexpr double k_detour_to = 0.45;

/// RGBA, f32, all finite, one texel a node:
/// * R, path distance: metres of the shortest way over water from the circle; below 0 outside of it. On land
///   and lakes it goes on from the nearest shore, so that a look-up at the waterline finds no jump.
/// * G, wave mask: 1 where the path is as long as the straight way, 0 where it makes a detour of
///   k_detour_to or more.
/// * B, depth: metres from the sea's level down to the floor, 0 on land.
/// * A, height: metres above the sea's level, below 0 under water.
///
/// Heights must be finite. Fails (ErrorCode::load; the message names no file) where there is no water, or
/// land on the circle.
Result<image::Image> bake_wave_map(const HeightMap& map);

/// Heights in metres from a picture's first channel v: `metres` * (v - `sea`). Fails (ErrorCode::load) where
/// the picture is not square, too small, too large, or a height is not finite or beyond k_largest_metres.
Result<HeightMap> heights_from(const image::Image& picture, double extent, double sea, double metres);

} // namespace tidemark::bake
