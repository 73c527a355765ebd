// Converts between texels of a cubemap and directions, by the table of the OpenGL specification (8.13).
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

/// Returns the direction of a place, not of unit length. For s and t outside 0..1 it is the direction to that
/// point in the face's plane.
Direction direction_of(const CubePlace& place);

/// Returns the intersection of a direction, of any length but 0, with the cube.
CubePlace place_of(const Direction& direction);

} // namespace tidemark::image
