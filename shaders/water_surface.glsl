// Water surface: a choppy sea as the zero of a height-like field, found by marching each pixel's ray.
//
// The idea, its stages and its numbers are those of "Procedural Water Surface Shader" by Xuetong Fu: crests
// made of several octaves of folded value noise that drift along z, a slow bobbing on top, a tint taken from
// a noise picture, a Fresnel glint and a fog of distance cubed. Noise from random numbers on a lattice,
// smoothly interpolated, is K. Perlin's idea; summing ever finer octaves of it is B. Mandelbrot's. The text
// is new.
//
//     stage           function        document's name
//     wave height     crests, bob     computeWave
//     distance field  (in march)      evaluateDistanceField
//     raymarching     march           traceWater
//     normal          normal_at       (in mainImage)
//     detail          ripples         sampleNoiseTexture
//     tint, lighting  shade           (in mainImage)
//
// The defaults are the document's numbers. Lengths are world units (the coarsest lattice cell is 6.7
// wide), angles radians, times seconds, colours 0..1 before `gamma`. The camera stands at `camera_position`
// and is turned by the mouse: yaw -pi..pi across the width, pitch -135..135 degrees up the height. Beyond a
// pitch of 90 degrees the view turns round rather than over, so the mouse at (0,0), the first of both, is a
// look along z, 45 degrees down. (.75, .4) of the size is a good view of the open sea.
//
// Knobs that are compiled in:
#define OCTAVES 7      // 0..12; the document's iterationCount. Each octave is 1.75 x finer and 0.51 x lower
#define MAX_STEPS 128  // field samples along a ray; too few leave false water along the crests
#define INTEGER_HASH 1 // 1: the same sea on every GPU; 0: the document's fract(sin(n) * 43785.5), which is not
//
// Knobs that are uniforms, camera first:
#iUniform vec3 camera_position = vec3(0.0, 2.5, 8.0) in { -100.0, 100.0 }
#iUniform float yaw_range = 6.2831 in { 0.0, 12.5664 }
#iUniform float pitch_range = 4.7124 in { 0.0, 6.2832 }
#iUniform float focal_length = 1.0 in { 0.2, 5.0 }
// waves: height of the whole sum before the first gain; ratio of heights and of frequencies from octave to
// octave; lattice cells per unit; drift in z per second; the seconds after which the drift starts again (a
// visible cut: the noise does not repeat); amplitude and rate of the turn between octaves; bobbing height
// (the document's 0.3, which its factor 1/2 makes 0.6), rate and radians per unit along x
#iUniform float wave_height = 3.0 in { 0.0, 8.0 }
#iUniform float wave_gain = 0.51 in { 0.1, 0.8 }
#iUniform float wave_lacunarity = 1.75 in { 1.1, 2.5 }
#iUniform float wave_scale = 0.15 in { 0.01, 0.5 }
#iUniform float wave_speed = 3.0 in { -10.0, 10.0 }
#iUniform float drift_period = 62.83 in { 1.0, 100000.0 }
#iUniform float turn_angle = 0.001 in { 0.0, 0.5 }
#iUniform float turn_rate = 0.15 in { 0.0, 2.0 }
#iUniform float bob_height = 0.6 in { 0.0, 3.0 }
#iUniform float bob_rate = 1.0 in { 0.0, 5.0 }
#iUniform float bob_frequency = 0.3 in { 0.0, 2.0 }
// solver: part of the height above the water that a step dares to go (at 1.0 crests are overrun); value of
// the field that counts as touching; first and last distance
#iUniform float step_scale = 0.5 in { 0.05, 1.0 }
#iUniform float hit_distance = 0.0001 in { 0.000005, 0.01 }
#iUniform float near_distance = 0.1 in { 0.0, 10.0 }
#iUniform float far_distance = 43.0 in { 1.0, 400.0 }
// light: how much of the true slope the normal shows, and over which distance it is taken; exponent, gain
// and brightness of the Fresnel glint; density of the fog per unit cubed; exponent of the encoded picture
#iUniform float slope_scale = 0.5 in { 0.0, 2.0 }
#iUniform float slope_distance = 0.01 in { 0.001, 0.2 }
#iUniform float glint_exponent = 5.0 in { 1.0, 12.0 }
#iUniform float glint_gain = 1.5 in { 0.0, 10.0 }
#iUniform float glint_brightness = 0.4 in { 0.0, 2.0 }
#iUniform float fog_density = 0.00005 in { 0.0, 0.001 }
#iUniform float gamma = 0.55 in { 0.2, 1.5 }
// tint: the two ends and the air; how much crests and the noise picture move it; repeats of that picture per
// unit of the finest octave for the broad and the fine pattern; weight of the fine one; contrast
#iUniform color3 deep_color = color3(0.05, 0.1, 0.2)
#iUniform color3 bright_color = color3(0.1, 0.3, 0.9)
#iUniform color3 air_color = color3(0.05, 0.07, 0.1)
#iUniform float crest_tint = 0.1 in { 0.0, 1.0 }
#iUniform float ripple_tint = 0.8 in { 0.0, 2.0 }
#iUniform float broad_scale = 0.0005 in { 0.0, 0.01 }
#iUniform float fine_scale = 0.005 in { 0.0, 0.1 }
#iUniform float fine_weight = 0.5 in { 0.0, 2.0 }
#iUniform float ripple_contrast = 1.2 in { 0.1, 4.0 }
#iChannel0 "noise"

// What depends on uniforms alone, worked out once a pixel instead of once a field sample.
struct Sea {
    float drift;     // in z
    float bob_phase; // 0..2 pi
    mat2 finer;      // x and y from one octave to the next: turned and scaled
};

Sea sea_now() {
    Sea sea;
    sea.drift = wave_speed * mod(iTime, drift_period);

    // Two parts of 2 pi, the first with few bits: reduced here, the phase keeps its resolution in space when
    // the time is large.
    float bob_time = bob_rate * iTime;
    float turns = floor(bob_time / 6.283185307);
    sea.bob_phase = (bob_time - turns * 6.28125) - turns * 0.001935307180;

    float angle = turn_angle * sin(turn_rate * iTime);
    float c = wave_lacunarity * cos(angle);
    float s = wave_lacunarity * sin(angle);
    sea.finer = mat2(c, -s, s, c);
    return sea;
}

// ---- Value noise ----------------------------------------------------------------------------------------

#if INTEGER_HASH
// A lattice point is one number mod 2^32: a sum with odd weights that are powers of the root of x^4 = x + 1,
// inverted, times 2^32, so that neighbours fall far apart. Folding the high half onto the low one and one odd
// multiplication then leave the upper 24 bits without correlation at any offset up to 6 (3.4 sigma at most
// over 1,098 offsets, of the values and of their distance from the mean).
const uvec3 k_lattice_weight = uvec3(3518319155u, 2882110345u, 2360945575u);
const float k_lattice_unit = 1.0 / 16777216.0;

vec4 scatter(uvec4 point) {
    return vec4(ivec4(((point ^ (point >> 15)) * 0xb995450du) >> 8));
}

void lattice(vec3 cell, out vec4 left, out vec4 right) {
    const uvec3 w = k_lattice_weight;
    uvec3 at = uvec3(ivec3(cell)) * w;
    uvec4 points = uvec4(0u, w.y, w.z, w.y + w.z) + (at.x + at.y + at.z);
    left = scatter(points);
    right = scatter(points + w.x);
}
#else
const float k_lattice_unit = 1.0;

vec4 scatter(vec4 point) {
    return fract(sin(point) * 43785.5);
}

void lattice(vec3 cell, out vec4 left, out vec4 right) {
    const vec3 w = vec3(7.0, 157.0, 113.0);
    vec4 points = vec4(0.0, w.y, w.z, w.y + w.z) + dot(cell, w);
    left = scatter(points);
    right = scatter(points + w.x);
}
#endif

// 0..1. The four values at x and at x + 1 stand in the order (y, z) = 00, 10, 01, 11.
float value_noise(vec3 position) {
    vec3 cell = floor(position);
    vec3 part = position - cell;
    part *= part * (3.0 - 2.0 * part);
    vec4 left, right;
    lattice(cell, left, right);
    // a + t (b - a) by hand: software rasterisers spend one operation more on mix().
    vec4 edge = left + part.x * (right - left);
    vec2 face = edge.xz + part.y * (edge.yw - edge.xz);
    return k_lattice_unit * (face.x + part.z * (face.y - face.x));
}

// ---- The field ------------------------------------------------------------------------------------------

// sin(x) for 0 <= x <= 1/2 to 6e-9: less than a rounding of the result, and the same on every GPU.
float short_sine(float x) {
    float xx = x * x;
    return x * (1.0 + xx * (-1.0 / 6.0 + xx * (1.0 / 120.0 - xx * (1.0 / 5040.0))));
}

// How far the folded octaves push the water down, 0..4.66 at the defaults; `point` in cells of the coarsest.
float crests(vec3 point, Sea sea) {
    float depth = 0.0;
    float height = 3.14 * wave_height;
    for (int octave = 0; octave < OCTAVES; ++octave) {
        height *= wave_gain;
        depth += height * short_sine(abs(value_noise(point) - 0.5));
        point = vec3(sea.finer * point.xy, wave_lacunarity * point.z);
    }
    return depth;
}

// -bob_height..bob_height
float bob(float x, Sea sea) {
    return bob_height * sin(sea.bob_phase + bob_frequency * x);
}

vec3 lattice_point(vec3 position, Sea sea) {
    return wave_scale * (position - vec3(0.0, 0.0, sea.drift));
}

// ---- The ray --------------------------------------------------------------------------------------------

struct Hit {
    bool water;
    float distance;
    float sampled; // where the field was last looked at: short of `distance` only when the steps ran out
    float depth;   // of the crests there
};

// Steps by a part of the field's value. That is sphere tracing but for its proof: the field's slope may reach
// 3.35 times step_scale / 0.5, so a ray can sink in a little (0.05 at most was seen at the defaults).
Hit march(vec3 origin, vec3 direction, Sea sea) {
    Hit hit = Hit(false, far_distance, far_distance, 0.0);
    // Nothing of the sea is above bob_height: a ray from there that does not fall meets none.
    if (origin.y > bob_height && direction.y >= 0.0) {
        return hit;
    }
    vec3 start = lattice_point(origin, sea);
    vec3 along = wave_scale * direction;
    hit.distance = near_distance;
    for (int i = 0; i < MAX_STEPS; ++i) {
        hit.sampled = hit.distance;
        vec3 position = origin + hit.sampled * direction;
        hit.depth = crests(start + hit.sampled * along, sea);
        float field = step_scale * (position.y + hit.depth + bob(position.x, sea));
        if (field < hit_distance || hit.sampled > far_distance) {
            break;
        }
        hit.distance += field;
    }
    hit.water = hit.distance <= far_distance;
    return hit;
}

// ---- Shading --------------------------------------------------------------------------------------------

// Unit normal from central differences. `slope_scale` 1/2 is the document's: its field carries the factor
// 1/2 while its vertical part does not. A loop, so that a compiler need not hold four copies of the octaves.
vec3 normal_at(vec3 position, Sea sea) {
    vec3 point = lattice_point(position, sea);
    float e = slope_distance;
    vec2 rise = vec2(bob(position.x + e, sea) - bob(position.x - e, sea), 0.0);
    for (int i = 0; i < 4; ++i) {
        vec2 axis = (i & 1) == 0 ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
        float side = i < 2 ? 1.0 : -1.0;
        rise += side * axis * crests(point + side * wave_scale * e * vec3(axis.x, 0.0, axis.y), sea);
    }
    return normalize(vec3(slope_scale * rise.x, 2.0 * e, slope_scale * rise.y));
}

// 0.05..0.5 at a contrast above 0
float ripples(vec2 uv) {
    float sum = 0.5 * texture(iChannel0, 0.125 * uv).r + 0.25 * texture(iChannel0, 0.25 * uv).r +
                0.125 * texture(iChannel0, 0.5 * uv).r + 0.125 * texture(iChannel0, uv).r;
    return 0.45 * pow(sum, ripple_contrast) + 0.05;
}

// Where the next finer octave would look, in world units: the noise picture is laid along it.
vec2 finest(vec3 position, Sea sea) {
    vec3 point = position - vec3(0.0, 0.0, sea.drift);
    for (int octave = 0; octave < OCTAVES; ++octave) {
        point = vec3(sea.finer * point.xy, wave_lacunarity * point.z);
    }
    return point.xz;
}

vec3 shade(Hit hit, vec3 position, vec3 direction, float ripple, Sea sea) {
    vec3 normal = normal_at(position, sea);
    // Unit vectors may give a cosine a rounding above 1; pow() of what is then below 0 is undefined.
    float facing = max(1.0 + dot(normal, direction), 0.0);
    float glint = clamp(glint_gain * pow(facing, glint_exponent), 0.0, 1.0);
    float tint = clamp(crest_tint * hit.depth + ripple_tint * ripple, 0.0, 1.0);
    vec3 water = mix(deep_color, bright_color, tint) + glint_brightness * glint;
    float clear = exp(-fog_density * hit.distance * hit.distance * hit.distance);
    return mix(air_color, water, clear);
}

// Columns: right, up, forward. Right is cross(forward, y) made unit by hand, so that straight down has one.
mat3 camera_axes() {
    vec2 turned = clamp(iMouse.xy / iResolution.xy, 0.0, 1.0) - 0.5;
    float yaw = yaw_range * turned.x;
    float pitch = pitch_range * turned.y;
    float level = cos(pitch);
    vec3 forward = vec3(sin(yaw) * level, sin(pitch), cos(yaw) * level);
    vec3 right = (level < 0.0 ? -1.0 : 1.0) * vec3(-cos(yaw), 0.0, sin(yaw));
    return mat3(right, cross(right, forward), forward);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = (fragCoord / iResolution.xy - 0.5) * vec2(iResolution.x / iResolution.y, 1.0);
    vec3 direction = camera_axes() * normalize(vec3(uv, focal_length));
    Sea sea = sea_now();
    Hit hit = march(camera_position, direction, sea);

    // Looked up for every pixel, the ones in the air too: beside the water's edge a texture read inside the
    // branch would have no neighbour to take its mipmap level from.
    vec2 grain = finest(camera_position + hit.sampled * direction, sea);
    float ripple = ripples(broad_scale * grain) + fine_weight * ripples(fine_scale * grain);

    vec3 color = air_color;
    if (hit.water) {
        color = shade(hit, camera_position + hit.distance * direction, direction, ripple, sea);
    }
    fragColor = vec4(pow(max(color, 0.0), vec3(gamma)), 1.0);
}
