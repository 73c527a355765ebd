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
// iChannel0 is what `tidemark bake island` writes: path distance, wave mask, depth, height; iChannel1 what
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
#define MAX_STEPS 64 // field samples along a ray
const float map_extent = 64.0; // as baked, and
const float map_top = 6.0;     // nothing stands higher

// camera: metres from the middle, the middle's offset, field of view as a focal length; height of the map seen
#iUniform float camera_distance = 40.0 in { 15.0, 90.0 }
#iUniform vec2 camera_target = vec2(0.0, -1.0) in { -20.0, 20.0 }
#iUniform float focal_length = 1.7 in { 0.6, 4.0 }
#iUniform float map_height = 44.0 in { 10.0, 120.0 }
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
// land and sky
#iUniform color3 sand_color = color3(0.93, 0.82, 0.58)
#iUniform color3 grass_color = color3(0.50, 0.66, 0.29)
#iUniform color3 bush_color = color3(0.20, 0.47, 0.20)
#iUniform color3 rock_color = color3(0.50, 0.47, 0.46)
#iUniform color3 sky_color = color3(0.45, 0.70, 0.92)
#iUniform color3 horizon_color = color3(0.80, 0.91, 0.95)
#iChannel0 "../textures/island.exr"
#iChannel0::WrapMode "Clamp"
#iChannel1 "../textures/wave_ramps.png"

const float k_circle = 0.46875 * map_extent; // where the waves start
const float k_flat = 2.5 * k_circle;         // where they come from: beyond there are none
const float k_land = 0.46 * map_extent;       // there is none beyond
const float k_open_depth = 5.0;
const float k_texels = 512.0;                // of the map, for its smooth look-ups: any size will do
const float k_slope = 1.0;                   // rise a metre that the march reckons with
const float k_touch = 0.0004;                // height of a hit, part of its distance

// ---- Noise ----------------------------------------------------------------------------------------------

// Two numbers 0..1 from a lattice point; the same on every GPU.
vec2 hash22(ivec2 at) {
    uint x = uint(at.x) * 0x9e3779b1u ^ uint(at.y) * 0x85ebca77u;
    x = (x ^ (x >> 15)) * 0x2c1b3c6du;
    x = (x ^ (x >> 12)) * 0x297a2d39u;
    x ^= x >> 15;
    return vec2(float(x & 0xffffu), float(x >> 16)) / 65535.0;
}

// Value noise, 0..1, and its gradient.
vec3 noise(vec2 at) {
    vec2 cell = floor(at);
    vec2 part = at - cell;
    vec2 curve = part * part * (3.0 - 2.0 * part);
    vec2 slope = 6.0 * part * (1.0 - part);
    ivec2 i = ivec2(cell);
    float a = hash22(i).x;
    float b = hash22(i + ivec2(1, 0)).x;
    float c = hash22(i + ivec2(0, 1)).x;
    float d = hash22(i + ivec2(1, 1)).x;
    float twist = a - b - c + d;
    return vec3(a + (b - a) * curve.x + (c - a) * curve.y + twist * curve.x * curve.y,
                slope * (vec2(b - a, c - a) + twist * curve.yx));
}

// Distance to the nearest of points that circle in the cells of a lattice, and the way to it: 0..about 1.1.
vec3 cells(vec2 at, float turns) {
    vec2 cell = floor(at);
    vec3 nearest = vec3(4.0, 0.0, 0.0);
    for (int i = 0; i < 9; ++i) {
        vec2 beside = cell + vec2(i % 3 - 1, i / 3 - 1);
        vec2 angle = 6.2831853 * (hash22(ivec2(beside)) + vec2(turns, -turns));
        vec2 way = beside + 0.5 + 0.38 * sin(angle) - at;
        float square = dot(way, way);
        if (square < nearest.x) {
            nearest = vec3(square, way);
        }
    }
    return vec3(sqrt(nearest.x), nearest.yz);
}

// ---- Time -----------------------------------------------------------------------------------------------

// fract(seconds * rate) for seconds >= 0 and |rate| < 1. The whole seconds are counted in 2^-32 turns by
// integers, which wrap as turns do: nothing is lost however late it is but what iTime itself cannot hold.
float turns_of(float seconds, float rate) {
    float whole = floor(seconds);
    uint turned = uint(whole) * uint(abs(rate) * 4294967296.0);
    float turns = float(turned >> 8) / 16777216.0 + (seconds - whole) * abs(rate);
    return fract(rate < 0.0 ? -turns : turns);
}

// ---- The baked fields -----------------------------------------------------------------------------------

// x: path distance, y: wave mask, z: depth, w: height.
vec4 open_sea(vec2 at) {
    return vec4(k_circle - length(at), 1.0, k_open_depth, -k_open_depth);
}

vec4 baked(vec2 at) {
    if (dot(at, at) > k_land * k_land) {
        return open_sea(at);
    }
    return textureLod(iChannel0, at / map_extent + 0.5, 0.0);
}

// By the cubic B-spline, as four of the sampler's own: no kinks between texels, for what normals are made of.
vec4 baked_smooth(vec2 at) {
    if (dot(at, at) > k_land * k_land) {
        return open_sea(at);
    }
    vec2 texel = (at / map_extent + 0.5) * k_texels - 0.5;
    vec2 part = fract(texel);
    vec2 cell = texel - part + 0.5;
    vec2 rest = 1.0 - part;
    vec2 first = rest * rest * rest / 6.0;
    vec2 second = 2.0 / 3.0 - 0.5 * part * part * (2.0 - part);
    vec2 fourth = part * part * part / 6.0;
    vec2 low = first + second;
    vec2 high = 1.0 - low;
    vec2 left = (cell - 1.0 + second / low) / k_texels;
    vec2 right = (cell + 1.0 + fourth / high) / k_texels;
    return low.y * (low.x * textureLod(iChannel0, left, 0.0) +
                    high.x * textureLod(iChannel0, vec2(right.x, left.y), 0.0)) +
           high.y * (low.x * textureLod(iChannel0, vec2(left.x, right.y), 0.0) +
                     high.x * textureLod(iChannel0, right, 0.0));
}

// ---- Waves ----------------------------------------------------------------------------------------------

float phase_of(vec4 field, vec2 at, float turns) {
    float bent = bend * (noise(0.13 * at + 7.3).x - 0.5);
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

float water_height(vec4 field, vec2 at, float turns) {
    return wave_height * wave_mask(field, at) * wave_ramps(phase_of(field, at, turns)).x;
}

// ---- The ray --------------------------------------------------------------------------------------------

struct Ray {
    vec3 origin, direction;
};

struct Hit {
    float distance; // -1: the sky
    float field;    // last value: height above what is higher of water and land
#ifdef TIDEMARK_HIT
    int samples;
    int flags; // 1: steps ran out, 2: a sample lay below, 4: so did the first
#endif
};

// Where the ray is below `top`, as far as it lies within `radius` of the map's middle: x to y, empty if x > y.
vec2 within(Ray ray, float top, float radius) {
    vec2 o = ray.origin.xz;
    vec2 d = ray.direction.xz;
    float a = max(dot(d, d), 1e-12);
    float b = dot(o, d);
    float root = b * b - a * (dot(o, o) - radius * radius);
    float fall = (top - ray.origin.y) / ray.direction.y;
    if (root < 0.0) {
        return vec2(1.0, 0.0);
    }
    root = sqrt(root);
    return vec2(max(fall, (-b - root) / a), (-b + root) / a);
}

// Height above what is higher of water and land.
float field_at(Ray ray, float t, float turns, inout Hit hit) {
    vec3 position = ray.origin + t * ray.direction;
    vec4 field = baked(position.xz);
    hit.distance = t;
    hit.field = position.y - max(field.w, water_height(field, position.xz, turns));
#ifdef TIDEMARK_HIT
    hit.samples += 1;
    hit.flags |= hit.field < 0.0 ? (hit.samples == 1 ? 6 : 2) : 0;
#endif
    return hit.field;
}

// A step of field / (fall + slope * advance) stays above ground that is nowhere steeper than `slope`. The flanks
// of rocks and the fronts of waves are: a ray may enter them by a step, and is then led back to where it did by
// the Illinois rule (M. Dowell, P. Jarratt, 1971). Passed by is only what the ray is inside of for less than a
// step. Water is nowhere below y = 0: a ray that falls has an end.
Hit march(Ray ray, float turns) {
    Hit hit;
    hit.distance = -1.0;
    hit.field = 0.0;
#ifdef TIDEMARK_HIT
    hit.samples = 0;
    hit.flags = 0;
#endif
    float fall = -ray.direction.y;
    if (fall < 1e-4) {
        return hit;
    }
    float end = ray.origin.y / fall;
    vec2 over_waves = within(ray, wave_height, k_flat);
    float t = over_waves.x < over_waves.y ? max(over_waves.x, 0.0) : end;
    vec2 over_land = within(ray, map_top, k_land);
    if (over_land.x < over_land.y) {
        t = min(t, max(over_land.x, 0.0));
    }
    float pace = 1.0 / (fall + k_slope * length(ray.direction.xz));
    float field = field_at(ray, t, turns, hit);
    vec2 above = vec2(t, field);
    int step = 1;
    for (; step < MAX_STEPS && field > k_touch * t && t < end; ++step) {
        above = vec2(t, field);
        t += max(pace * field, 8.0 * k_touch * t);
        t = t < min(over_waves.y, end) ? t : end;
        field = field_at(ray, t, turns, hit);
    }
#ifdef TIDEMARK_HIT
    hit.flags |= field > k_touch * t && t < end ? 1 : 0;
#endif
    vec2 below = vec2(t, field);
    for (int i = 0; i < 6 && below.y < 0.0 && above.y > 0.0 && abs(hit.field) > k_touch * hit.distance; ++i) {
        t = (above.x * below.y - below.x * above.y) / (below.y - above.y);
        field = field_at(ray, t, turns, hit);
        if (field > 0.0) {
            above = vec2(t, field);
            below.y *= 0.5;
        } else {
            below = vec2(t, field);
            above.y *= 0.5;
        }
    }
    return hit;
}

// ---- Light ----------------------------------------------------------------------------------------------

vec3 to_sun() {
    vec2 angle = radians(vec2(sun_azimuth, sun_elevation));
    return vec3(sin(angle.x) * cos(angle.y), sin(angle.y), cos(angle.x) * cos(angle.y));
}

vec3 sky(vec3 direction) {
    vec3 color = mix(horizon_color, sky_color, 1.0 - exp(-4.0 * max(direction.y, 0.0)));
    float sun = max(dot(direction, to_sun()), 0.0);
    return color + vec3(0.25, 0.2, 0.12) * pow(sun, 24.0);
}

// 0 in the land's shadow, 1 in the sun.
float sunlight(vec3 position) {
#if SHADOWS
    vec3 light = to_sun();
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
    vec2 rise = vec2(baked_smooth(at + vec2(e, 0.0)).w - baked_smooth(at - vec2(e, 0.0)).w,
                     baked_smooth(at + vec2(0.0, e)).w - baked_smooth(at - vec2(0.0, e)).w) / (2.0 * e);
    return Ground(normalize(vec3(-rise.x, 1.0, -rise.y)), length(rise));
}

// What the ground is made of; `normal` comes back with its grain, `bush` 0..1 where one grows.
vec3 ground_color(vec2 at, float height, float steepness, inout vec3 normal) {
    vec3 coarse = noise(0.55 * at);
    vec3 fine = noise(2.7 * at + 31.7);
    vec3 sand = sand_color * (0.94 + 0.1 * fine.x);
    vec3 rock = rock_color * (0.62 + 0.4 * coarse.x + 0.35 * fine.x);
    float stony = smoothstep(0.85, 1.2, steepness + 0.25 * (fine.x - 0.5));
    float green = smoothstep(0.62, 0.85, height + 0.5 * (coarse.x - 0.5) + 0.2 * (fine.x - 0.5));
    vec3 grass = grass_color * (0.8 + 0.3 * coarse.x + 0.18 * fine.x);

    vec3 bush = cells(1.35 * at, 0.0);
    float grows = step(0.45, noise(0.4 * at + 3.1).x) * green * (1.0 - stony) * smoothstep(0.9, 1.3, height);
    float crown = grows * smoothstep(0.52, 0.44, bush.x);
    vec3 round_normal = normalize(vec3(-bush.y, 0.5, -bush.z));
    normal = normalize(mix(normal, round_normal, 0.75 * crown) +
                       stony * 0.35 * vec3(-fine.y, 0.0, -fine.z));
    vec3 color = mix(sand, grass, green);
    float tone = noise(1.7 * (1.35 * at + bush.yz)).x; // one a bush
    color = mix(color, bush_color * (0.7 + 0.6 * tone) + vec3(0.08, 0.03, 0.0) * tone, crown);
    color *= 1.0 - 0.5 * grows * (1.0 - crown) * smoothstep(0.75, 0.5, bush.x);
    return mix(color, rock, stony);
}

vec3 shade_land(vec3 position, float height) {
    Ground ground = ground_at(position.xz, 0.16);
    vec3 normal = ground.normal;
    vec3 color = ground_color(position.xz, height, ground.steepness, normal);
    // What the last wave wetted.
    color *= mix(0.62, 1.0, smoothstep(0.05, 0.42 * wave_height, height + 0.08 * noise(3.0 * position.xz).x));
    float sun = max(dot(normal, to_sun()), 0.0) * sunlight(position + 0.02 * normal);
    return color * (vec3(1.05, 1.0, 0.9) * sun + vec3(0.34, 0.40, 0.48) * (0.6 + 0.4 * normal.y));
}

// ---- Water ----------------------------------------------------------------------------------------------

// Bright lines that wander: where two sheets of cells both are far from their points.
float caustic(vec2 at, float depth) {
#if CAUSTIC
    float turns = turns_of(iTime, 0.23);
    vec2 p = caustic_scale * at;
    float lines = min(cells(p, turns).x, cells(1.31 * p.yx + 5.2, turns).x);
    return caustic_strength * 2.6 * pow(lines, 3.0) * exp(-0.45 * depth) * smoothstep(0.0, 0.25, depth);
#else
    return 0.0;
#endif
}

// 0..1
float foam_cover(vec4 field, vec2 at, float turns, float above_floor) {
#if FOAM
    vec4 ramps = wave_ramps(phase_of(field, at, turns));
    float lattice = turns_of(iTime, 0.11);
    float lace = cells(foam_scale * at, lattice).x;
    float fine = cells(2.3 * foam_scale * at + 9.1, lattice).x;
    float net = 0.62 * lace + 0.38 * fine;
    float sets = smoothstep(0.12, 0.5, noise(0.27 * at + vec2(8.0 * turns_of(iTime, 0.004))).x);
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

vec3 water_normal(vec2 at, float turns, float footprint) {
    float e = 0.12 + footprint;
    vec2 rise = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        vec2 axis = (i & 1) == 0 ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
        float side = i < 2 ? 1.0 : -1.0;
        vec2 there = at + side * e * axis;
        rise += side * axis * water_height(baked_smooth(there), there, turns);
    }
    rise /= 2.0 * e;
    vec2 drift = vec2(turns_of(iTime, 0.0131), turns_of(iTime, 0.0173));
    vec2 grain = noise(1.9 * at + 64.0 * drift).yz + noise(3.7 * at.yx - 64.0 * drift).zy;
    rise += 0.09 * ripples * grain / (1.0 + 40.0 * footprint * footprint);
    return normalize(vec3(-rise.x, 1.0, -rise.y));
}

// Where on the floor the ray ends that enters the water at `position`: a few steps down, then between the last
// two.
vec2 refracted(vec3 position, vec3 direction, vec3 normal, float depth) {
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

vec3 shade_water(vec3 position, vec3 direction, vec4 field, float turns, float footprint) {
    vec3 normal = water_normal(position.xz, turns, footprint);
    float depth = max(position.y - field.w, 0.0);
    vec3 light = to_sun();
    float lit = sunlight(position);

    vec2 on_floor = refracted(position, direction, normal, depth);
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

    float facing = max(-dot(direction, normal), 0.0);
    vec3 mirrored = reflect(direction, normal);
    mirrored.y = abs(mirrored.y);
    color = mix(color, sky(mirrored), 0.02 + 0.55 * pow(1.0 - facing, 5.0));
#if SPECULAR
    // Ripples that are finer than a pixel spread the highlight and take from its brightness.
    vec3 between = normalize(light - direction);
    float spread = 1.0 + 8.0 * min(footprint, 1.0);
    color += specular / spread * lit * vec3(1.0, 0.95, 0.85) *
             pow(max(dot(normal, between), 0.0), max(specular_exponent / spread, 4.0));
#endif
    float foam = foam_cover(field, position.xz, turns, depth);
    vec3 froth = foam_color * (0.62 + 0.38 * lit * clamp(0.15 + 1.15 * dot(normal, light), 0.0, 1.0));
    return mix(color, froth, foam);
}

// ---- The picture ----------------------------------------------------------------------------------------

Ray ray_of(vec2 fragCoord) {
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
#if TOP_VIEW
    vec2 at = uv * map_height;
    return Ray(vec3(at.x, map_top + 1.0, at.y), vec3(0.0, -1.0, 0.0));
#else
    vec2 turned = iMouse.x > 0.0 || iMouse.y > 0.0 ? clamp(iMouse.xy / iResolution.xy, 0.0, 1.0) : vec2(0.5, 0.36);
    float azimuth = 6.2831853 * (turned.x - 0.5) + 3.6;
    float elevation = radians(mix(6.0, 84.0, turned.y));
    vec3 back = vec3(sin(azimuth) * cos(elevation), sin(elevation), cos(azimuth) * cos(elevation));
    vec3 right = vec3(cos(azimuth), 0.0, -sin(azimuth));
    vec3 origin = vec3(camera_target.x, 0.0, camera_target.y) + camera_distance * back;
    return Ray(origin, normalize(uv.x * right + uv.y * cross(back, right) - focal_length * back));
#endif
}

// Metres that a pixel covers at `distance`, across the ray.
float footprint_at(float distance) {
#if TOP_VIEW
    return map_height / iResolution.y;
#else
    return distance / (focal_length * iResolution.y);
#endif
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    Ray ray = ray_of(fragCoord);
    float turns = turns_of(iTime, 1.0 / wave_speed);
    Hit hit = march(ray, turns);
    vec3 color;
    if (hit.distance < 0.0) {
        color = sky(ray.direction);
    } else {
        vec3 position = ray.origin + hit.distance * ray.direction;
        vec4 field = baked_smooth(position.xz);
        float water = water_height(field, position.xz, turns);
        color = field.w > water ? shade_land(position, field.w)
                                : shade_water(vec3(position.x, water, position.z), ray.direction, field, turns,
                                              footprint_at(hit.distance));
        float air = 1.0 - exp(-pow(hit.distance / 260.0, 2.0));
        color = mix(color, horizon_color, air);
    }
    fragColor = vec4(color, 1.0);
}

#ifdef TIDEMARK_HIT
void mainHit(out vec4 hit, in vec2 fragCoord) {
    Hit found = march(ray_of(fragCoord), turns_of(iTime, 1.0 / wave_speed));
    hit = vec4(found.distance, float(found.samples), found.field, float(found.flags));
}
#endif
