// A swell of three waves, found by marching along each pixel's ray. The mouse turns the view.
//
// The march is the library's (`tidemark help library`): this text says how far away the water is at least, in
// march_field, and SOLVER says how that is used. `tidemark check` proves where rays first hit and whether a step can
// pass a wave; `tidemark study FILE --vary SOLVER=MARCH_SPHERE,MARCH_BRACKET --vary MAX_STEPS=16,64,256` draws error
// against run time. Lengths are metres, angles radians.

#define SOLVER MARCH_BRACKET // or MARCH_SPHERE, MARCH_ENHANCED, MARCH_AUTO, MARCH_CERTIFIED, MARCH_FIXED
#define MAX_STEPS 512        // field samples along a ray
#define HIT_DISTANCE 0.001   // MARCH_SPHERE: value of the field that counts as touching
#define FIXED_STEP 0.25      // MARCH_FIXED: distance of its samples

#iUniform float swell = 1.0 in { 0.0, 3.0 }
#iUniform vec3 camera_position = vec3(0.0, 3.5, 0.0) in { -20.0, 20.0 }
#iUniform vec2 default_turn = vec2(0.5, 0.42) in { 0.0, 1.0 }
#iUniform float focal_length = 1.2 in { 0.5, 4.0 }
#iUniform float far_distance = 300.0 in { 10.0, 1000.0 }
#iUniform vec2 sun_place = vec2(0.3, 0.25) in { -3.1416, 3.1416 }
#iUniform color3 water_color = color3(0.01, 0.1, 0.13)

#include <tidemark/camera.glsl>
#include <tidemark/fresnel.glsl>
#include <tidemark/march.glsl>
#include <tidemark/phase.glsl>

const vec3 k_zenith = vec3(0.12, 0.3, 0.6);
const vec3 k_horizon = vec3(0.65, 0.75, 0.82);
const vec3 k_sunlight = vec3(1.5, 1.3, 1.0);

// ---- The water ------------------------------------------------------------------------------------------

// One wave a component: where it goes, radians a metre, height in metres.
const vec3 k_along_x = vec3(0.28, 0.8, -0.6);
const vec3 k_along_z = vec3(0.96, 0.6, 0.8);
const vec3 k_number = vec3(0.35, 0.62, 1.1);
const vec3 k_height = vec3(0.45, 0.16, 0.07);
// Radians a second, sqrt(9.81 k): deep water's dispersion.
const vec3 k_rate = vec3(1.85297, 2.46621, 3.28497);

vec3 wave_heights() {
    return swell * k_height;
}

vec3 wave_angles(vec2 place) {
    vec3 phases = vec3(phase(k_rate.x, seconds()), phase(k_rate.y, seconds()), phase(k_rate.z, seconds()));
    return k_number * (k_along_x * place.x + k_along_z * place.y) - phases;
}

float water_height(vec2 place) {
    return dot(wave_heights(), sin(wave_angles(place)));
}

// Of height - water_height: no unit vector.
vec3 water_gradient(vec2 place) {
    vec3 rise = wave_heights() * k_number * cos(wave_angles(place));
    return vec3(-dot(k_along_x, rise), 1.0, -dot(k_along_z, rise));
}

// ---- The ray --------------------------------------------------------------------------------------------

vec3 ray_origin;
vec3 ray_direction;

// The height above the water, divided by its steepest slope: then no water is nearer than its value. The waves' slopes
// add up to at most sum a k; one that you add goes into that sum.
float march_field(float t) {
    vec3 position = ray_origin + t * ray_direction;
    float steepest = dot(wave_heights(), k_number);
    return (position.y - water_height(position.xz)) * inversesqrt(1.0 + steepest * steepest);
}

#if SOLVER == MARCH_CERTIFIED
// The field, and how far ahead of t it has no zero: its value itself, for the bound is proved.
vec2 march_clearance(float t) {
    return vec2(march_field(t));
}
#endif

// Distance of the water in a pixel, -1: none.
float look(vec2 pixel) {
    ray_origin = camera_position;
    ray_direction = pixel_ray(mouse_camera(mouse_turn(default_turn), vec2(6.2832, 2.8)), pixel, focal_length);
    float highest = dot(wave_heights(), vec3(1.0));
    MarchRange range = MarchRange(0.0, far_distance, pixel_width(focal_length), 2e-5);
    return march(clip_to_slab(range, ray_origin, ray_direction, -highest, highest));
}

#ifdef TIDEMARK_HIT
// What `check` and `study` ask: where a pixel's ray hit, and what it cost.
void mainHit(out vec4 hit, in vec2 fragCoord) {
    hit = march_report(look(fragCoord));
}
#endif

// ---- Shading --------------------------------------------------------------------------------------------

// To the sun: yaw (0: +z) and height above the horizon.
vec3 to_sun() {
    return vec3(sin(sun_place.x) * cos(sun_place.y), sin(sun_place.y), cos(sun_place.x) * cos(sun_place.y));
}

vec3 sky(vec3 direction) {
    return mix(k_zenith, k_horizon, exp(-4.0 * max(direction.y, 0.0)));
}

vec3 shade_water(float t) {
    vec3 position = ray_origin + t * ray_direction;
    vec3 normal = seen_normal(normalize(water_gradient(position.xz)), ray_direction, 0.05);
    vec3 mirrored = reflect(ray_direction, normal);
    float mirror = 0.02 + 0.98 * fresnel(normal, ray_direction, 5.0);
    vec3 color = mix(water_color, sky(mirrored), mirror);
    color += 0.8 * mirror * pow(max(dot(mirrored, to_sun()), 0.0), 120.0) * k_sunlight;
    return mix(k_horizon, color, exp(-0.012 * t)); // haze
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float t = look(fragCoord);
    vec3 color = t < 0.0 ? sky(ray_direction) : shade_water(t);
    fragColor = vec4(pow(clamp(color, 0.0, 1.0), vec3(1.0 / 2.2)), 1.0);
}
