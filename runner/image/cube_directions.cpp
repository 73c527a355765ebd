#include "image/cube_directions.hpp"

#include <cmath>

namespace tidemark::image {

Direction direction_of(const CubePlace& place) {
    const double sc = 2.0 * place.s - 1.0, tc = 2.0 * place.t - 1.0;
    switch (place.face) {
    case 0: return {1.0, -tc, -sc};
    case 1: return {-1.0, -tc, sc};
    case 2: return {sc, 1.0, tc};
    case 3: return {sc, -1.0, -tc};
    case 4: return {sc, -tc, 1.0};
    default: return {-sc, -tc, -1.0};
    }
}

CubePlace place_of(const Direction& direction) {
    const auto [x, y, z] = direction;
    const double ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
    const auto on = [](int face, double sc, double tc, double major) {
        return CubePlace{face, 0.5 * (sc / major + 1.0), 0.5 * (tc / major + 1.0)};
    };
    if (ax >= ay && ax >= az)
        return x > 0.0 ? on(0, -z, -y, ax) : on(1, z, -y, ax);
    if (ay >= az)
        return y > 0.0 ? on(2, x, z, ay) : on(3, x, -z, ay);
    return z > 0.0 ? on(4, x, -y, az) : on(5, -x, -y, az);
}

} // namespace tidemark::image
