// A clear sky to look at and to mirror: a gradient, a sun, a sheet of clouds.
#ifndef LIB_SKY
#define LIB_SKY
#include "fbm.glsl"

// Colour in the unit direction `look`: `horizon` at and below the horizon, `zenith` straight up, 63 % of the way
// a third up.
vec3 sky_gradient(vec3 look, vec3 zenith, vec3 horizon) {
    return mix(zenith, horizon, exp(-3.0 * max(look.y, 0.0)));
}

// Brightness of the sun and the air around it: 1 in its middle, 0 away from it. Unit directions.
float sun_glow(vec3 look, vec3 to_sun) {
    float near = max(dot(look, to_sun), 0.0);
    return 0.72 * pow(near, 1200.0) + 0.18 * pow(near, 60.0) + 0.1 * pow(near, 6.0);
}

// Cover of a flat sheet of clouds at height 1, 0..1: none at and below the horizon, where it would flicker.
// `drift` in clouds; `cover` 0..1.
float sky_clouds(vec3 look, vec2 drift, float cover) {
    float up = max(look.y, 0.0);
    vec2 at = 1.6 * look.xz / (up + 0.12) + drift;
    float thick = fbm(at, 5, 0.5, 2.03);
    return smoothstep(0.72 - 0.5 * cover, 1.05 - 0.5 * cover, thick) * smoothstep(0.0, 0.25, up);
}
#endif
