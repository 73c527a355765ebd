// Procedural ocean: ridged octaves that run against each other, coarse ones for the shape, fine ones for the
// light, and no texture at all.
//
// The scene is that of "ShaderLab Procedural Ocean in Unity URP": an octave of sine ridges bent by value noise,
// run forwards and backwards at once, summed with a turn between the octaves; few octaves to move a mesh, more
// to rebuild its normal in each pixel by differences; colours from deep to shallow by height and slope; a
// gradient sky mirrored by Fresnel; J. Blinn's highlight; foam where it is high and steep; fog. Its octave is
// that of A. Alekseev's "Seascape" (2014), whose numbers stand here where the document leaves them open. Instead
// of a mesh each pixel's ray is marched through the coarse octaves. The text is new.
//
//     stage                     function                    document's name
//     random numbers, noise     lib/hash, lib/noise         hash21, noise2
//     an octave                 ridges                      seaOctave
//     height                    height                      sampleWaveHeight
//     vertex and fragment       OCTAVES, FINE_OCTAVES       VERTEX_ITER, FRAGMENT_ITER
//     normal                    rise_at                     sampleWaveNormal
//     foam, colour              surface                     (fragment stage)
//
// Lengths are world units, times seconds, angles radians, colours 0..1 before `gamma`. The mouse turns the view;
// while it is at (0,0), where it is before its first click, the view is `default_turn`.
//
// Knobs that are compiled in:
#define SOLVER MARCH_BRACKET // how a ray finds the water: one of lib/march.glsl's, but for MARCH_SEGMENT
#define INTEGER_HASH 1       // 1: the same sea on every GPU; 0: fract(sin(n) * 43785.5), which is not
#define MAX_STEPS 512        // field samples along a ray
#define HIT_DISTANCE 0.001   // MARCH_SPHERE: value of the field that counts as touching
#define FIXED_STEP 0.5       // MARCH_FIXED: distance of its samples; wants MAX_STEPS to reach far_distance
#define OCTAVES 3            // 1..FINE_OCTAVES, of the shape: each 3.8 x finer and 0.22 x lower
#define FINE_OCTAVES 5       // 1..8, of the light
#define DIVIDED_NORMAL 1     // 0: differences are not divided by their distance, as in the document
#define FOAM 1               // each of these 0: without, and none of its code is compiled
#define REFLECTION 1
#define FOG 1
#define CLOUDS 1
//
// Knobs that are uniforms. The document's shape:
#iUniform float wave_height = 0.6 in { 0.0, 1.5 }
#iUniform float wave_frequency = 0.16 in { 0.02, 0.5 }
#iUniform float wave_speed = 0.8 in { -4.0, 4.0 }
#iUniform float wave_choppiness = 4.0 in { 1.0, 8.0 }
// size of everything: 2 is a sea of half as long and half as high waves
#iUniform float sea_scale = 1.0 in { 0.25, 4.0 }
// the distance that the normal's differences are taken over, at least (a pixel takes more far away), and how
// much of the slope it shows
#iUniform float normal_epsilon = 0.01 in { 0.001, 0.2 }
#iUniform float normal_strength = 1.0 in { 0.0, 3.0 }
// its lighting
#iUniform color3 deep_color = color3(0.0, 0.09, 0.18)
#iUniform color3 shallow_color = color3(0.32, 0.50, 0.42)
#iUniform color3 specular_color = color3(1.0, 0.92, 0.78)
#iUniform float smoothness = 0.72 in { 0.0, 1.0 }
#iUniform float fresnel_power = 3.0 in { 1.0, 8.0 }
// its foam: high + foam_steepness (1 - normal.y) against a threshold, soft by so much to either side
#iUniform color3 foam_color = color3(0.92, 0.96, 0.98)
#iUniform float foam_threshold = 0.74 in { 0.0, 2.0 }
#iUniform float foam_softness = 0.22 in { 0.01, 1.0 }
#iUniform float foam_steepness = 1.6 in { 0.0, 4.0 }
// solver: part of the height above the water that a step dares to go (1/4.53 is proved at the defaults), for waves
// as steep as the defaults: steeper ones take that much less; how far the water goes
#iUniform float step_scale = 0.75 in { 0.05, 1.0 }
#iUniform float far_distance = 400.0 in { 10.0, 1000.0 }
// camera: place, yaw and pitch before the mouse is used (parts of the ranges), their ranges, focal length
#iUniform vec3 camera_position = vec3(0.0, 4.0, 0.0) in { -50.0, 50.0 }
#iUniform vec2 default_turn = vec2(0.56, 0.42) in { 0.0, 1.0 }
#iUniform float yaw_range = 6.2832 in { 0.0, 12.5664 }
#iUniform float pitch_range = 2.8 in { 0.0, 3.1 }
#iUniform float focal_length = 1.2 in { 0.3, 5.0 }
// 1: iMouse turns the view, as in the document, instead of the host's camera
#iUniform int document_mouse = 0 in { 0, 1 }
// sky: the sun's place (yaw and height in radians), colours, cover of the clouds; density of the fog a unit;
// exponent of the encoded picture
#iUniform vec2 sun_place = vec2(0.35, 0.42) in { -3.1416, 3.1416 }
#iUniform color3 zenith_color = color3(0.16, 0.37, 0.66)
#iUniform color3 horizon_color = color3(0.62, 0.75, 0.84)
#iUniform float cloud_amount = 0.5 in { 0.0, 1.0 }
#iUniform float fog_density = 0.005 in { 0.0, 0.05 }
#iUniform float gamma = 0.65 in { 0.2, 1.5 }

#include "lib/camera.glsl"
#include "lib/fresnel.glsl"
#include "lib/march.glsl"
#include "lib/noise.glsl"
#include "lib/orbit.glsl"
#include "lib/phase.glsl"
#include "lib/seascape.glsl"
#include "lib/sky.glsl"
#include "lib/specular.glsl"

// ---- The sea of this frame ------------------------------------------------------------------------------

// How far each octave has run, worked out once a pixel: in cells of its noise (the fraction, and the whole, which
// moves the lattice), and in radians of its ridges.
float sea_drift[FINE_OCTAVES];
int sea_cells[FINE_OCTAVES];
float sea_phase[FINE_OCTAVES];
float sea_slope; // bound of the coarse water's: see ridges() and octave_height()

void make_sea() {
    float rate = rate_product(wave_frequency, wave_speed);
    float steepness = 2.0 * wave_height * wave_frequency * 5.2427;
    float choppiness = wave_choppiness;
    sea_slope = 0.0;
    for (int octave = 0; octave < FINE_OCTAVES; ++octave) {
        sea_drift[octave] = split_product(rate, seconds(), sea_cells[octave]);
        sea_phase[octave] = phase(rate, seconds());
        rate = rate_product(rate, 1.9);
        sea_slope += octave < OCTAVES ? steepness * (0.68 + 0.3 * choppiness) : 0.0;
        steepness *= 0.22 * 3.8;
        choppiness = mix(choppiness, 1.0, 0.2);
    }
}

// ---- The field ------------------------------------------------------------------------------------------

// Ridges along the lines where a sine of x or of y is zero, 0..1. A ridge's profile is w = (1 - s)(s + c) with
// s = |sin|, c = |cos|: w ~ 1 - d^2 / 2 at a crest, so w^0.65 has a slope there. Gradient at most
// 0.68 + 0.3 choppiness, for 1 <= choppiness <= 10 (sampled 400,000 times along the steepest line).
float ridges(vec2 at, float choppiness) {
    vec2 s = abs(sin(at));
    vec2 c = abs(cos(at));
    vec2 w = (1.0 - s) * (s + c);
    // A device's cosine may exceed 1 by a rounding: pow() of what is then below 0 is undefined.
    return pow(max(1.0 - pow(max(w.x * w.y, 0.0), 0.65), 0.0), choppiness);
}

// One octave run towards `side` (1 or -1), 0..1; `at` in its cells, at rest. Slope in cells at most
// (1 + 3 sqrt 2) of that of ridges(): the noise, -1..1 with slope 3, moves both coordinates.
float octave_height(vec2 at, int octave, float side, float choppiness) {
    float noise = 2.0 * value_noise(at + side * sea_drift[octave], ivec2(int(side) * sea_cells[octave])) - 1.0;
    return ridges(at + side * sea_phase[octave] + noise, choppiness);
}

// Height of the water, 0..2 wave_height sum 0.22^k; `octaves` a constant.
float height(vec2 place, int octaves) {
    vec2 at = sea_scale * place * vec2(0.75, 1.0);
    float frequency = wave_frequency;
    float amplitude = wave_height / sea_scale;
    float choppiness = wave_choppiness;
    float sum = 0.0;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += amplitude * (octave_height((at + 1.0) * frequency, octave, 1.0, choppiness) +
                            octave_height((at - 1.0) * frequency, octave, -1.0, choppiness));
        at = mat2(1.6, -1.2, 1.2, 1.6) * at;
        frequency *= 1.9;
        amplitude *= 0.22;
        choppiness = mix(choppiness, 1.0, 0.2);
    }
    return sum;
}

float highest() {
    return 2.0 * wave_height / (0.78 * sea_scale);
}

// ---- The ray --------------------------------------------------------------------------------------------

vec3 ray_origin;
vec3 ray_direction;

// The height above the coarse water, all but: its slope may reach 4.53 at the defaults (1.65 was seen), of which
// the water's own is 4.42.
float march_field(float t) {
    vec3 position = ray_origin + t * ray_direction;
    float dare = step_scale * 4.42 / max(sea_slope, 4.42);
    return dare * (position.y - height(position.xz, OCTAVES));
}

#if SOLVER == MARCH_CERTIFIED
vec2 march_clearance(float t) {
    vec3 position = ray_origin + t * ray_direction;
    float above = position.y - height(position.xz, OCTAVES);
    return vec2(above, above / (abs(ray_direction.y) + sea_slope * length(ray_direction.xz)));
}
#endif

// The ray through a pixel, and the distance of the water on it; -1: none.
float look(vec2 frag_coord) {
    View view = sea_view(document_mouse, camera_position, default_turn, vec2(yaw_range, pitch_range), focal_length,
                         highest() + 0.3);
    ray_origin = view.position;
    ray_direction = pixel_ray(view.axes, frag_coord, focal_length);
    make_sea();
    // The noise: of the ridges' sines some hundred units away.
    MarchRange range = MarchRange(0.0, far_distance, pixel_width(focal_length), 1e-5);
    return march(clip_to_slab(range, ray_origin, ray_direction, 0.0, highest()));
}

// ---- Shading --------------------------------------------------------------------------------------------

// The fine water's slope along x and z, and its height in z; differences over `epsilon` to one side.
vec3 rise_at(vec2 place, float epsilon) {
    vec3 h;
    // A loop, so that a compiler need not hold three copies of the octaves.
    for (int i = 0; i < 3; ++i) {
        h[i] = height(place + epsilon * vec2(i == 0, i == 1), FINE_OCTAVES);
    }
    vec2 rise = normal_strength * (h.xy - h.z);
#if DIVIDED_NORMAL
    rise /= epsilon;
#endif
    return vec3(rise, h.z);
}

Sky sky() {
    return Sky(zenith_color, horizon_color, specular_color, direction_of(sun_place), cloud_amount);
}

vec3 surface(float t, vec3 position) {
    float footprint = t * pixel_width(focal_length) / max(-ray_direction.y, 0.05);
    vec3 rise = rise_at(position.xz, max(normal_epsilon, 0.5 * footprint));
    vec3 normal = normalize(vec3(-rise.x, 1.0, -rise.y));
    normal = seen_normal(normal, ray_direction, 0.1);
    float high = clamp(rise.z * sea_scale / max(wave_height * 2.4, 0.001), 0.0, 1.0);

    vec3 sun = direction_of(sun_place);
    float lit = max(dot(normal, sun), 0.0);
    vec3 ambient = 0.6 * mix(horizon_color, zenith_color, 0.5 + 0.5 * normal.y);
    float shallow = clamp(high * high * 1.4 + 0.4 * (1.0 - normal.y), 0.0, 1.0);
    vec3 color = mix(deep_color, shallow_color, shallow) * (ambient + 0.6 * lit * specular_color + 0.35);

#if REFLECTION
    float mirror = min(fresnel(normal, ray_direction, fresnel_power), 1.0);
    color = mix(color, sky_mirrored(sky(), ray_direction, normal), mirror);
#endif
    float exponent = smooth_exponent(smoothness);
    color += specular_color * (exponent + 8.0) * 0.012 * blinn_phong(normal, sun, -ray_direction, exponent);

#if FOAM
    float crest = high + (1.0 - normal.y) * foam_steepness;
    float foam = smoothstep(foam_threshold - foam_softness, foam_threshold + foam_softness, crest);
    color = mix(color, foam_color * (ambient + 0.55 * lit * specular_color + 0.1), foam);
#endif
    return color;
}

#ifdef TIDEMARK_HIT
void mainHit(out vec4 hit, in vec2 fragCoord) {
    hit = march_report(look(fragCoord));
}
#endif

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float t = look(fragCoord);
    vec3 color = seascape(t, ray_origin, ray_direction);
    fragColor = vec4(pow(clamp(color, 0.0, 1.0), vec3(gamma)), 1.0);
}
