// Which way the texels of a cubemap look: the table of the OpenGL specification (8.13) in both directions.
#pragma once

namespace tidemark::image {

struct Direction {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
};

/// A place on a face: `face` in the order +X -X +Y -Y +Z -Z, s and t 0..1 within it.
struct CubePlace {
    int face = 0;
    double s = 0.0;
    double t = 0.0;
};

/// Not of unit length. s and t may lie outside 0..1: the direction through the face's plane there.
Direction direction_of(const CubePlace& place);

/// Where a direction, of any length but 0, meets the cube.
CubePlace place_of(const Direction& direction);

} // namespace tidemark::image
