// A clear sky to look at and to mirror: a gradient, a sun, a sheet of clouds.
#ifndef LIB_SKY
#define LIB_SKY
#include "fbm.glsl"

#ifndef CLOUDS
#define CLOUDS 1
#endif

struct Sky {
    vec3 zenith;  // colours, linear
    vec3 horizon;
    vec3 sun;
    vec3 to_sun;  // unit
    float clouds; // cover 0..1
};

// Unit direction of yaw (0: +z, a quarter turn: +x) and height above the horizon, radians.
vec3 direction_of(vec2 place) {
    return vec3(sin(place.x) * cos(place.y), sin(place.y), cos(place.x) * cos(place.y));
}

// The air in the unit direction `look`: the horizon's colour at and below it, 63 % of the way to the zenith's a
// third up.
vec3 sky_air(Sky sky, vec3 look) {
    return mix(sky.zenith, sky.horizon, exp(-3.0 * max(look.y, 0.0)));
}

// What a ripple mirrors towards the eye that looks in the unit direction `look`: the air, upwards always, for what
// a facet would mirror from below is hidden by the next.
vec3 sky_mirrored(Sky sky, vec3 look, vec3 normal) {
    vec3 up = reflect(look, normal);
    return sky_air(sky, vec3(up.x, abs(up.y), up.z));
}

// Brightness of the sun and the air around it: 1 in its middle, 0 away from it.
float sun_glow(Sky sky, vec3 look) {
    float near = max(dot(look, sky.to_sun), 0.0);
    return 0.72 * pow(near, 1200.0) + 0.18 * pow(near, 60.0) + 0.1 * pow(near, 6.0);
}

// Cover of a flat sheet of clouds at height 1, 0..1: none at and below the horizon, where it would flicker. It drifts
// by 1/50 of a cloud a second.
float cloud_cover(vec3 look, float cover) {
    float up = max(look.y, 0.0);
    float thick = fbm(1.6 * look.xz / (up + 0.12), vec2(0.02, 0.008), 5, 0.5, 2.03);
    return smoothstep(0.72 - 0.5 * cover, 1.05 - 0.5 * cover, thick) * smoothstep(0.0, 0.25, up);
}

// All of it; CLOUDS 0 leaves the clouds out.
vec3 sky_color(Sky sky, vec3 look) {
    vec3 color = sky_air(sky, look) + sky.sun * sun_glow(sky, look);
#if CLOUDS
    vec3 lit = mix(vec3(0.73, 0.78, 0.84), sky.sun + 0.06, 0.5 + 0.5 * dot(look, sky.to_sun));
    color = mix(color, lit, cloud_cover(look, sky.clouds));
#endif
    return color;
}
#endif
