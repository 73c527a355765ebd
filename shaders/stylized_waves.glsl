// Stylized waves: a toy sea that rolls in to an island, with nothing simulated while it runs.
//
// The idea, its stages and its names are those of "Stylized Ocean Waves Shader (Mobile)", made for the game
// Amikin Village: waves start on a circle round the island; for every place on the water the length of the
// shortest way from there, round all land, is baked beforehand; divided by the wave's length and with the time
// added its fraction is the wave's phase, and ramps over the phase give the wave its shape and its foam. Where
// the way is longer than the straight one the place lies behind something, and the wave is masked; where the
// floor is near it grows. The text, the island and the ramps are new, and so are the lattice of the foam, the
// caustics and the island's colours.
//
//     stage                  function            document's name
//     baked fields           baked               uv1.x, uv1.y, color.y (Houdini)
//     phase                  phase_of            wavePhase
//     ramp over the phase    wave_ramps          _WaveShape and the ramps of the foam
//     mask, growth at coast  wave_mask           waveMask, waveMaskByVertDistToBottom
//     displacement           water_height        heightOffset
//     front, tail, rollback  foam_cover          wave front, wave tail, wave rollback
//     depth gradient, specular, caustic, refraction    shade_water, caustic, refracted
//
// iChannel0 is what `tidemark_bake` writes: path distance, wave mask, depth, height; iChannel1 what
// `tidemark bake ramps` writes: height, front, tail, rollback over the phase. Another island of the same size
// can be given with --channel 0=FILE.
//
// Lengths are metres: x to the east, y up, z to the north, the sea's level at y = 0. Colours are as displayed.
// In the game's view the mouse turns the camera: round the island across the width, from low to high up the
// height. No number of the document is known but its formulas; the defaults are ours.
//
// Knobs that are compiled in: 0 leaves the code out, FOAM counts its layers (front, tail, rollback).
#define TOP_VIEW 0 // 1: straight down, as a map; 0: as in the game
#define FOAM 3
#define SPECULAR 1
#define CAUSTIC 1
#define REFRACTION 1
#define SHADOWS 1
#define CLOUDS 1
#define SOLVER MARCH_BRACKET // one of lib/march.glsl's, but for MARCH_CERTIFIED and MARCH_SEGMENT
#define MAX_STEPS 512        // field samples along a ray
#define HIT_DISTANCE 0.001   // MARCH_SPHERE: value of the field that counts as touching
#define FIXED_STEP 0.5       // MARCH_FIXED: distance of its samples; wants MAX_STEPS to cover what is looked at
const float map_extent = 64.0; // as baked, and
const float map_top = 6.0;     // nothing stands higher

// camera: metres from the middle, the middle's offset, field of view as a focal length; height of the map seen
#iUniform float camera_distance = 40.0 in { 15.0, 90.0 }
#iUniform vec2 camera_target = vec2(0.0, -1.0) in { -20.0, 20.0 }
#iUniform float focal_length = 1.7 in { 0.6, 4.0 }
#iUniform float map_height = 44.0 in { 10.0, 120.0 }
// 1: iMouse turns the view, as in the document, instead of the host's camera
#iUniform int document_mouse = 0 in { 0, 1 }
// waves: metres from crest to crest; seconds from one to the next, below 0 for waves that run with the path;
// metres of the highest; part of that on deep water; depths where growth begins and ends; part that is left
// where the water ends; how many lengths the fronts are bent by; metres they fall behind in shallow water, which
// turns them towards the coast
#iUniform float wave_length = 6.5 in { 1.5, 15.0 }
#iUniform float wave_speed = -4.0 in { -20.0, -1.1 }
#iUniform float wave_height = 1.1 in { 0.0, 2.0 }
#iUniform float offshore_height = 0.22 in { 0.0, 1.0 }
#iUniform float deep_water = 4.2 in { 2.0, 8.0 }
#iUniform float shallow_water = 0.9 in { 0.1, 1.8 }
#iUniform float swash = 0.36 in { 0.0, 1.0 }
#iUniform float bend = 0.35 in { 0.0, 1.0 }
#iUniform float coast_delay = 3.0 in { 0.0, 6.0 }
#iUniform float ripples = 0.5 in { 0.0, 1.5 }
// foam: cover of its layers; depth beyond which waves do not break; cells a metre of its lattice
#iUniform float foam_front = 1.0 in { 0.0, 1.5 }
#iUniform float foam_tail = 0.8 in { 0.0, 1.5 }
#iUniform float foam_rollback = 0.9 in { 0.0, 1.5 }
#iUniform float foam_depth = 3.0 in { 0.5, 6.0 }
#iUniform float foam_scale = 1.5 in { 0.3, 4.0 }
#iUniform color3 foam_color = color3(0.98, 1.0, 1.0)
// water: colours of the depth gradient, metres over which it runs, part of the light that a metre takes
#iUniform color3 shallow_color = color3(0.22, 0.80, 0.76)
#iUniform color3 deep_color = color3(0.02, 0.30, 0.52)
#iUniform float depth_gradient = 4.5 in { 0.5, 10.0 }
#iUniform float turbidity = 0.55 in { 0.05, 3.0 }
#iUniform float refraction = 1.0 in { 0.0, 2.0 }
#iUniform float caustic_strength = 0.9 in { 0.0, 3.0 }
#iUniform float caustic_scale = 0.9 in { 0.2, 3.0 }
#iUniform float specular = 0.7 in { 0.0, 3.0 }
#iUniform float specular_exponent = 90.0 in { 4.0, 400.0 }
// sun: degrees clockwise from north, degrees above the horizon
#iUniform float sun_azimuth = 305.0 in { 0.0, 360.0 }
#iUniform float sun_elevation = 42.0 in { 10.0, 85.0 }
// land and sky; cover of the clouds
#iUniform color3 sand_color = color3(0.93, 0.82, 0.58)
#iUniform color3 grass_color = color3(0.50, 0.66, 0.29)
#iUniform color3 bush_color = color3(0.20, 0.47, 0.20)
#iUniform color3 rock_color = color3(0.50, 0.47, 0.46)
#iUniform color3 zenith_color = color3(0.45, 0.70, 0.92)
#iUniform color3 horizon_color = color3(0.80, 0.91, 0.95)
#iUniform color3 sun_color = color3(1.0, 0.96, 0.87)
#iUniform float clouds = 0.45 in { 0.0, 1.0 }
#iChannel0 "../textures/island.exr"
#iChannel0::WrapMode "Clamp"
#iChannel1 "../textures/wave_ramps.png"

#include "lib/camera.glsl"
#include "lib/cells.glsl"
#include "lib/fog.glsl"
#include "lib/fresnel.glsl"
#include "lib/march.glsl"
#include "lib/noise.glsl"
#include "lib/orbit.glsl"
#include "lib/phase.glsl"
#include "lib/sky.glsl"
#include "lib/specular.glsl"

const float k_circle = 0.46875 * map_extent; // where the waves start
const float k_flat = 2.5 * k_circle;         // and before that: none beyond
const float k_land = 0.46 * map_extent;      // there is none beyond
const float k_below = 0.1;                   // the march looks this far below the plane of the sea, to cross it
const float k_slope = 2.5;                   // rise a metre that the march reckons with; see march_field

// ---- The baked fields -----------------------------------------------------------------------------------

// x: path distance, y: wave mask, z: depth, w: height. Beyond the land the sea is open, and as deep as at its
// rim: `rim` is the place to look that up, `field` what was found there.
vec2 rim(vec2 at) {
    return at * min(1.0, k_land / max(length(at), 1e-6));
}

vec4 open_sea(vec2 at, vec4 field) {
    float out_of_middle = length(at);
    return out_of_middle > k_land ? vec4(k_circle - out_of_middle, 1.0, field.zw) : field;
}

vec4 baked(vec2 at) {
    return open_sea(at, textureLod(iChannel0, rim(at) / map_extent + 0.5, 0.0));
}

// By the cubic B-spline, as four of the sampler's own: no kinks between texels, for what normals are made of.
vec4 baked_smooth(vec2 at) {
    float texels = float(textureSize(iChannel0, 0).x);
    vec2 texel = (rim(at) / map_extent + 0.5) * texels - 0.5;
    vec2 part = fract(texel);
    vec2 cell = texel - part + 0.5;
    vec2 rest = 1.0 - part;
    vec2 first = rest * rest * rest / 6.0;
    vec2 second = 2.0 / 3.0 - 0.5 * part * part * (2.0 - part);
    vec2 fourth = part * part * part / 6.0;
    vec2 low = first + second;
    vec2 high = 1.0 - low;
    vec2 left = (cell - 1.0 + second / low) / texels;
    vec2 right = (cell + 1.0 + fourth / high) / texels;
    vec4 south = low.x * textureLod(iChannel0, left, 0.0) +
                 high.x * textureLod(iChannel0, vec2(right.x, left.y), 0.0);
    vec4 north = low.x * textureLod(iChannel0, vec2(left.x, right.y), 0.0) +
                 high.x * textureLod(iChannel0, right, 0.0);
    return open_sea(at, low.y * south + high.y * north);
}

// The i-th of 0..3 ways along the axes, for differences: in a loop, so that a compiler need not hold four copies of
// what is looked up.
vec2 arm(int i) {
    float side = i < 2 ? 1.0 : -1.0;
    return (i & 1) == 0 ? vec2(side, 0.0) : vec2(0.0, side);
}

// ---- Waves ----------------------------------------------------------------------------------------------

float turns; // of the waves since the start, 0..1

float phase_of(vec4 field, vec2 at) {
    float bent = bend * (value_noise(0.13 * at + 7.3, ivec2(0)) - 0.5);
    float path = field.x - coast_delay * exp(-0.8 * field.z);
    return fract(path / wave_length + turns + bent);
}

// x: height, y: front, z: tail, w: rollback.
vec4 wave_ramps(float phase) {
    return textureLod(iChannel1, vec2(phase, 0.5), 0.0);
}

// 0..1: damped behind land, grown where the floor is near, spent on the beach, gone far outside.
float wave_mask(vec4 field, vec2 at) {
    float growth = mix(1.0, offshore_height, smoothstep(shallow_water, deep_water, field.z));
    float spent = mix(1.0, swash, smoothstep(-0.9, 0.15, field.w));
    float far = 1.0 - smoothstep(k_circle, k_flat, length(at));
    return clamp(field.y, 0.0, 1.0) * growth * spent * far;
}

float water_height(vec4 field, vec2 at) {
    return wave_height * wave_mask(field, at) * wave_ramps(phase_of(field, at)).x;
}

// ---- The ray --------------------------------------------------------------------------------------------

vec3 origin, direction; // of the ray in hand

// Height above what is higher of water and land, over what that can change by along the ray where the ground
// rises by k_slope a metre. The flanks of rocks and the fronts of waves are steeper: a ray may enter them by a
// step, and is led back to where it did. Passed by is only what it is inside of for less than a step.
float march_field(float t) {
    vec3 position = origin + t * direction;
    vec4 field = baked(position.xz);
    float above = position.y - max(field.w, water_height(field, position.xz));
    float slope = k_slope * max(1.0, 5.9 * wave_height / wave_length);
    return above / (slope * length(direction.xz) - direction.y);
}

// Metres that a pixel covers at `distance`, across the ray.
float footprint_at(float distance) {
#if TOP_VIEW
    return map_height / iResolution.y;
#else
    return distance * pixel_width(focal_length);
#endif
}

// The part of `range` within `radius` of the map's middle.
MarchRange clip_to_circle(MarchRange range, float radius) {
    float a = max(dot(direction.xz, direction.xz), 1e-12);
    float b = dot(origin.xz, direction.xz);
    float square = b * b - a * (dot(origin.xz, origin.xz) - radius * radius);
    float root = sqrt(max(square, 0.0));
    range.near = max(range.near, (-b - root) / a);
    range.far = square < 0.0 ? -1.0 : min(range.far, (root - b) / a);
    return range;
}

// Distance of what the ray meets, -1: the sky. No land is above map_top or beyond k_land, no wave above
// wave_height or beyond k_flat: there the sea is the plane y = 0, which is below all else.
float trace() {
    MarchRange all = MarchRange(0.0, 1e5, footprint_at(1.0), 2e-5);
    MarchRange land = clip_to_circle(clip_to_slab(all, origin, direction, -k_below, map_top), k_land);
    MarchRange waves = clip_to_circle(clip_to_slab(all, origin, direction, -k_below, wave_height), k_flat);
    if (land.near < land.far && waves.near < waves.far) {
        all.near = min(land.near, waves.near);
        all.far = max(land.far, waves.far);
    } else {
        all.near = land.near < land.far ? land.near : waves.near;
        all.far = land.near < land.far ? land.far : waves.far;
    }
    float distance = march(all);
    return distance < 0.0 && direction.y < 0.0 ? -origin.y / direction.y : distance;
}

// ---- Light ----------------------------------------------------------------------------------------------

Sky sky_now() {
    vec3 to_sun = direction_of(radians(vec2(sun_azimuth, sun_elevation)));
    return Sky(zenith_color, horizon_color, sun_color, to_sun, clouds);
}

// 0 in the land's shadow, 1 in the sun.
float sunlight(vec3 position, vec3 light) {
#if SHADOWS
    float lit = 1.0;
    float t = 0.25;
    for (int i = 0; i < 14; ++i) {
        vec3 at = position + t * light;
        float clear = at.y - baked(at.xz).w;
        lit = min(lit, 0.5 + 3.0 * clear / t);
        t += clamp(clear, 0.25, 0.9);
    }
    return smoothstep(0.0, 1.0, lit);
#else
    return 1.0;
#endif
}

// ---- Land -----------------------------------------------------------------------------------------------

struct Ground {
    vec3 normal;
    float steepness; // rise a metre
};

Ground ground_at(vec2 at, float e) {
    vec2 rise = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        rise += arm(i) * baked_smooth(at + e * arm(i)).w;
    }
    rise /= 2.0 * e;
    return Ground(normalize(vec3(-rise.x, 1.0, -rise.y)), length(rise));
}

// What the ground is made of; `normal` comes back with its grain, `bush` 0..1 where one grows.
vec3 ground_color(vec2 at, float height, float steepness, inout vec3 normal) {
    vec3 coarse = value_noise_gradient(0.55 * at, ivec2(0));
    vec3 fine = value_noise_gradient(2.7 * at + 31.7, ivec2(0));
    vec3 sand = sand_color * (0.94 + 0.1 * fine.x);
    vec3 rock = rock_color * (0.62 + 0.4 * coarse.x + 0.35 * fine.x);
    float stony = smoothstep(0.85, 1.2, steepness + 0.25 * (fine.x - 0.5));
    float green = smoothstep(0.62, 0.85, height + 0.5 * (coarse.x - 0.5) + 0.2 * (fine.x - 0.5));
    vec3 grass = grass_color * (0.8 + 0.3 * coarse.x + 0.18 * fine.x);

    vec3 bush = nearest_cell(1.35 * at, 0.0);
    float grows = step(0.45, value_noise(0.4 * at + 3.1, ivec2(0))) * smoothstep(0.9, 1.3, height);
    grows *= green * (1.0 - stony);
    float crown = grows * (1.0 - smoothstep(0.44, 0.52, bush.z));
    vec3 round_normal = normalize(vec3(-bush.x, 0.5, -bush.y));
    normal = normalize(mix(normal, round_normal, 0.75 * crown) +
                       stony * 0.35 * vec3(-fine.y, 0.0, -fine.z));
    vec3 color = mix(sand, grass, green);
    float tone = value_noise(1.7 * (1.35 * at + bush.xy), ivec2(0)); // one a bush
    color = mix(color, bush_color * (0.7 + 0.6 * tone) + vec3(0.08, 0.03, 0.0) * tone, crown);
    color *= 1.0 - 0.5 * grows * (1.0 - crown) * (1.0 - smoothstep(0.5, 0.75, bush.z));
    return mix(color, rock, stony);
}

vec3 shade_land(vec3 position, float height, vec3 light) {
    Ground ground = ground_at(position.xz, 0.16);
    vec3 normal = ground.normal;
    vec3 color = ground_color(position.xz, height, ground.steepness, normal);
    // What the last wave wetted.
    float above = height + 0.08 * value_noise(3.0 * position.xz, ivec2(0));
    color *= mix(0.62, 1.0, smoothstep(0.05, 0.06 + 0.42 * wave_height, above));
    float sun = max(dot(normal, light), 0.0) * sunlight(position + 0.02 * normal, light);
    return color * (1.05 * sun_color * sun + vec3(0.34, 0.40, 0.48) * (0.6 + 0.4 * normal.y));
}

// ---- Water ----------------------------------------------------------------------------------------------

// Noise that moves by `speed` lattice cells a second, and its gradient: without a jump, as fine after a month as
// at the start.
vec3 drifting(vec2 at, vec2 speed) {
    ivec2 whole;
    vec2 part = vec2(split_product(speed.x, seconds(), whole.x), split_product(speed.y, seconds(), whole.y));
    return value_noise_gradient(at + part, whole);
}

// Bright lines that wander: where two sheets of cells both are far from their points.
float caustic(vec2 at, float depth) {
#if CAUSTIC
    float round = fract_of_product(0.23, seconds());
    vec2 p = caustic_scale * at;
    float lines = min(nearest_cell(p, round).z, nearest_cell(1.31 * p.yx + 5.2, round).z);
    return caustic_strength * 2.6 * pow(lines, 3.0) * exp(-0.45 * depth) * smoothstep(0.0, 0.25, depth);
#else
    return 0.0;
#endif
}

// 0..1
float foam_cover(vec4 field, vec2 at, float above_floor) {
#if FOAM
    vec4 ramps = wave_ramps(phase_of(field, at));
    float round = fract_of_product(0.11, seconds());
    float lace = nearest_cell(foam_scale * at, round).z;
    float fine = nearest_cell(2.3 * foam_scale * at + 9.1, round).z;
    float net = 0.62 * lace + 0.38 * fine;
    float sets = smoothstep(0.12, 0.5, drifting(0.27 * at, vec2(0.05, 0.03)).x);
    float breaks = clamp(field.y, 0.0, 1.0) * (1.0 - smoothstep(0.35 * foam_depth, foam_depth, field.z));

    // The front is solid but for its ragged ends; the line where water meets land belongs to it.
    float edge = 0.85 * (1.0 - smoothstep(0.03, 0.16, above_floor - 0.12 * (lace - 0.4)));
    float cover = foam_front * max(breaks * sets * ramps.y, edge);
    cover = smoothstep(0.30, 0.42, cover - 0.45 * (0.75 - net));
#if FOAM > 1
    float tail = foam_tail * breaks * ramps.z;
    cover = max(cover, 0.85 * smoothstep(0.0, 0.1, tail - 1.05 * (0.88 - net)));
#endif
#if FOAM > 2
    float shore = 1.0 - smoothstep(0.1, 0.9, above_floor);
    float rollback = foam_rollback * clamp(field.y + 0.3, 0.0, 1.0) * shore * ramps.w;
    cover = max(cover, 0.8 * smoothstep(0.0, 0.12, rollback - 1.1 * (0.86 - net)));
#endif
    return clamp(cover, 0.0, 1.0);
#else
    return 0.0;
#endif
}

vec3 water_normal(vec2 at, float footprint) {
    float e = 0.12 + footprint;
    vec2 rise = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        vec2 there = at + e * arm(i);
        rise += arm(i) * water_height(baked_smooth(there), there);
    }
    rise /= 2.0 * e;
    vec2 grain = drifting(1.9 * at, vec2(0.83, 0.6)).yz +
                 drifting(3.7 * at.yx, vec2(-0.7, 1.1)).zy;
    rise += 0.09 * ripples * grain / (1.0 + 40.0 * footprint * footprint);
    return normalize(vec3(-rise.x, 1.0, -rise.y));
}

// Where on the floor the ray ends that enters the water at `position`: a few steps down, then between the last
// two.
vec2 refracted(vec3 position, vec3 normal, float depth) {
#if REFRACTION
    vec3 inside = refract(direction, normal, 0.75);
    vec3 way = 1.3 * depth * vec3(refraction * inside.xz / max(-inside.y, 0.35), -1.0).xzy / 6.0;
    vec3 at = position;
    float above = depth;
    for (int i = 0; i < 6; ++i) {
        float next = at.y + way.y - baked(at.xz + way.xz).w;
        if (next <= 0.0) {
            return at.xz + way.xz * above / (above - next + 1e-6);
        }
        at += way;
        above = next;
    }
    return at.xz;
#else
    return position.xz;
#endif
}

vec3 shade_water(vec3 position, vec4 field, float footprint, Sky sky) {
    vec3 normal = water_normal(position.xz, footprint);
    float depth = max(position.y - field.w, 0.0);
    vec3 light = sky.to_sun;
    float lit = sunlight(position, light);

    vec2 on_floor = refracted(position, normal, depth);
    vec4 floor_field = baked_smooth(on_floor);
    float floor_depth = max(position.y - floor_field.w, 0.0);
    Ground ground = ground_at(on_floor, 0.2);
    vec3 grain = ground.normal;
    vec3 below = ground_color(on_floor, floor_field.w, ground.steepness, grain);
    below *= 0.55 + 0.45 * lit * max(dot(grain, light), 0.0) + lit * caustic(on_floor, floor_depth);

    vec3 gradient = mix(shallow_color, deep_color, smoothstep(0.0, 1.0, floor_depth / depth_gradient));
    float crest = smoothstep(0.2, 1.0, position.y / max(wave_height, 0.01));
    gradient = mix(gradient, 1.15 * shallow_color, 0.55 * crest); // light through the top of a wave
    vec3 clear = exp(-turbidity * floor_depth * vec3(1.5, 0.8, 0.7));
    float slope_light = 0.5 + 0.5 * clamp(0.35 + 1.1 * dot(normal, light), 0.0, 1.4);
    vec3 color = mix(gradient * slope_light * mix(0.75, 1.0, lit), below, clear);

    color = mix(color, sky_mirrored(sky, direction, normal),
                0.02 + 0.55 * clamp(fresnel(normal, direction, 5.0), 0.0, 1.0));
#if SPECULAR
    // Ripples that are finer than a pixel spread the highlight and take from its brightness.
    float spread = 1.0 + 8.0 * min(footprint, 1.0);
    float sharpness = max(specular_exponent / spread, 4.0);
    color += specular / spread * lit * sun_color * blinn_phong(normal, light, -direction, sharpness);
#endif
    float foam = foam_cover(field, position.xz, depth);
    vec3 froth = foam_color * (0.62 + 0.38 * lit * clamp(0.15 + 1.15 * dot(normal, light), 0.0, 1.0));
    return mix(color, froth, foam);
}

// ---- The picture ----------------------------------------------------------------------------------------

void aim(vec2 frag_coord) {
#if TOP_VIEW
    vec2 at = (frag_coord - 0.5 * iResolution.xy) / iResolution.y * map_height;
    origin = vec3(at.x, map_top + 1.0, at.y);
    direction = vec3(0.0, -1.0, 0.0);
#else
    bool moved = orbits(document_mouse);
    vec2 first = vec2(0.5, 0.36);
    vec2 turned = clamp(moved ? first : mouse_turn(first), 0.0, 1.0);
    float azimuth = 6.283185307 * turned.x + 0.46;
    float elevation = radians(mix(6.0, 84.0, turned.y));
    float distance = camera_distance;
    vec3 pan = vec3(0.0);
    if (moved) {
        pan = orbit_pan(azimuth + 3.14159265, distance, focal_length);
        azimuth += iOrbit.x;
        elevation = clamp(elevation + iOrbit.y, -1.57079632, 1.57079632);
        distance *= iOrbit.z;
    }
    vec3 forward = -direction_of(vec2(azimuth, elevation));
    vec3 right = vec3(cos(azimuth), 0.0, -sin(azimuth));
    vec2 target = camera_target + pan.xz;
    vec3 arm = forward;
    if (moved) { // over land and waves, however low it is turned
        float lowest = max(baked(target - distance * forward.xz).w, wave_height) + 0.5;
        arm.y = min(forward.y - pan.y / distance, -lowest / distance);
    }
    origin = vec3(target.x, 0.0, target.y) - distance * arm;
    direction = pixel_ray(mat3(right, cross(right, forward), forward), frag_coord, focal_length);
#endif
}

vec3 picture(float distance) {
    Sky sky = sky_now();
    if (distance < 0.0) {
        return sky_color(sky, direction);
    }
    vec3 position = origin + distance * direction;
    vec4 field = baked_smooth(position.xz);
    float water = water_height(field, position.xz);
    vec3 color = field.w > water
                     ? shade_land(position, field.w, sky.to_sun)
                     : shade_water(vec3(position.x, water, position.z), field, footprint_at(distance), sky);
    return mix(horizon_color, color, squared_clearness(distance, 1.0 / 260.0));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    aim(fragCoord);
    turns = fract_of_product(1.0 / binary32(wave_speed), seconds());
    fragColor = vec4(picture(trace()), 1.0);
}

#ifdef TIDEMARK_HIT
void mainHit(out vec4 hit, in vec2 fragCoord) {
    aim(fragCoord);
    turns = fract_of_product(1.0 / binary32(wave_speed), seconds());
    hit = march_report(trace());
}
#endif
