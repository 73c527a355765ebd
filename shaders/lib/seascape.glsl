// A sea under a sky, through air: what a ray shows that met the water after t, or nothing (t < 0). The scene
// gives `surface`, the light that leaves the water there, and `sky`; and FOG, 1 with the knob fog_density or 0.
// Linear light.
#ifndef LIB_SEASCAPE
#define LIB_SEASCAPE

#include "fog.glsl"
#include "sky.glsl"

vec3 surface(float t, vec3 position);
Sky sky();

vec3 seascape(float t, vec3 origin, vec3 direction) {
    if (t < 0.0)
        return sky_color(sky(), direction);
    vec3 color = surface(t, origin + t * direction);
#if FOG
    vec3 level = normalize(vec3(direction.x, 1e-6, direction.z));
    color = mix(sky_air(sky(), level), color, squared_clearness(t, fog_density));
#endif
    return color;
}
#endif
