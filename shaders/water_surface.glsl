// Water surface: a choppy sea as the zero of a height-like field, found by marching each pixel's ray.
//
// The idea, its stages and its numbers are those of "Procedural Water Surface Shader" by Xuetong Fu: crests
// made of several octaves of folded value noise that drift along z, a slow bobbing on top, a tint taken from
// a noise picture, a Fresnel glint and a fog of distance cubed. Noise from random numbers on a lattice,
// smoothly interpolated, is K. Perlin's idea; summing ever finer octaves of it is B. Mandelbrot's. The text
// is new.
//
//     stage           function              document's name
//     wave height     crests, bob           computeWave
//     distance field  march_field           evaluateDistanceField
//     raymarching     march (lib/march)     traceWater
//     normal          rise_at               (in mainImage)
//     detail          ripples               sampleNoiseTexture
//     tint, lighting  shade                 (in mainImage)
//
// The defaults are the document's numbers. Lengths are world units (the coarsest lattice cell is 6.7
// wide), angles radians, times seconds, colours 0..1 before `gamma`. The camera stands at `camera_position`
// and is turned by the mouse: yaw -pi..pi across the width, pitch -135..135 degrees up the height, of which it
// takes the part from straight down to straight up. While the mouse is at (0,0), where it is before its first
// click, the view is `default_turn`: the document's, whose camera turns round beyond straight down, so that this
// corner is a look along z, 45 degrees down. (.75, .4) of the size is a good view of the open sea.
//
// Knobs that are compiled in:
#define DOCUMENT 0 // 1: all of the document's own: its solver, hash, normal, and a drift that starts again
#if DOCUMENT
#define SOLVER MARCH_SPHERE
#define INTEGER_HASH 0
#define ANALYTIC_NORMAL 0
#define MAX_STEPS 128
#define DRIFT_PERIOD 62.83
#define TURNING_POLES 1
#define MARCH_PAST_FAR 1
#else
#define SOLVER MARCH_BRACKET // how a ray finds the water: one of lib/march.glsl's
#define INTEGER_HASH 1       // 1: the same sea on every GPU; 0: the document's fract(sin(n) * 43785.5)
#define ANALYTIC_NORMAL 1    // 1: from the noise's own slope; 0: from differences over SLOPE_DISTANCE
#define MAX_STEPS 512        // field samples along a ray
#define TURNING_POLES 0      // 1: beyond straight up and down the view turns round at once; 0: it rests there
// The sine hash knows few cells before its sines lose their bits.
#define DRIFT_PERIOD (INTEGER_HASH == 1 || drift_period > 0.0 ? drift_period : 62.83)
#endif
#define OCTAVES 7           // 1..12; the document's iterationCount. Each is 1.75 x finer and 0.51 x lower
#define HIT_DISTANCE 0.0001 // MARCH_SPHERE: value of the field that counts as touching
#define BEND_SCALE 1.0      // MARCH_CERTIFIED: part of the proved bend that its steps reckon with; below 1 they dare
#define FIXED_STEP 0.1      // MARCH_FIXED: distance of its samples; wants MAX_STEPS to reach far_distance
#define SLOPE_DISTANCE 0.01 // half of the distance that differences are taken over
//
// Knobs that are uniforms, camera first (its turn in parts of the two ranges):
#iUniform vec3 camera_position = vec3(0.0, 2.5, 8.0) in { -100.0, 100.0 }
#iUniform vec2 default_turn = vec2(0.5, 0.33333) in { 0.0, 1.0 }
#iUniform float yaw_range = 6.2831 in { 0.0, 12.5664 }
#iUniform float pitch_range = 4.7124 in { 0.0, 6.2832 }
#iUniform float focal_length = 1.0 in { 0.2, 5.0 }
// 1: iMouse turns the view, as in the document, instead of the host's camera
#iUniform int document_mouse = 0 in { 0, 1 }
// waves: height of the whole sum before the first gain; ratio of heights and of frequencies from octave to
// octave; lattice cells per unit; drift in z per second; the seconds after which the drift starts again, a
// visible cut (0: never; the document's 62.83); amplitude and rate of the turn between octaves; bobbing height
// (the document's 0.3, which its factor 1/2 makes 0.6), rate and radians per unit along x
#iUniform float wave_height = 3.0 in { 0.0, 8.0 }
#iUniform float wave_gain = 0.51 in { 0.1, 0.8 }
#iUniform float wave_lacunarity = 1.75 in { 1.1, 2.5 }
#iUniform float wave_scale = 0.15 in { 0.01, 0.5 }
#iUniform float wave_speed = 3.0 in { -10.0, 10.0 }
#iUniform float drift_period = 0.0 in { 0.0, 1000.0 }
#iUniform float turn_angle = 0.001 in { 0.0, 0.5 }
#iUniform float turn_rate = 0.15 in { 0.0, 2.0 }
#iUniform float bob_height = 0.6 in { 0.0, 3.0 }
#iUniform float bob_rate = 1.0 in { 0.0, 5.0 }
#iUniform float bob_frequency = 0.3 in { 0.0, 2.0 }
// solver: part of the height above the water that a step dares to go (the document's 0.5; at 1.0 crests are
// overrun), for waves as steep as the defaults: steeper ones take that much less; first and last distance
#iUniform float step_scale = 0.7 in { 0.05, 1.0 }
#iUniform float near_distance = 0.1 in { 0.0, 10.0 }
#iUniform float far_distance = 43.0 in { 1.0, 400.0 }
// light: how much of the true slope the normal shows; exponent, gain and brightness of the Fresnel glint;
// density of the fog per unit cubed; exponent of the encoded picture
#iUniform float slope_scale = 0.5 in { 0.0, 2.0 }
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

#include "lib/camera.glsl"
#include "lib/fog.glsl"
#include "lib/fresnel.glsl"
#include "lib/march.glsl"
#include "lib/noise.glsl"
#include "lib/orbit.glsl"
#include "lib/phase.glsl"

// ---- The sea of this frame ------------------------------------------------------------------------------

// What depends on uniforms alone, worked out once a pixel instead of once a field sample.
vec2 sea_seconds;          // of the drift, as lib/phase has them
float sea_bob_phase;       // 0..2 pi
mat2 sea_finer;            // x and y from one octave to the next: turned and scaled
float sea_drift[OCTAVES];  // in cells of the octave: the fraction,
int sea_cells[OCTAVES];    // and the whole, which moves the lattice
float sea_step;            // part of the height above the water that a step goes

void make_sea() {
    vec2 now = DOCUMENT == 1 ? vec2(iTime, 0.0) : seconds();
    sea_bob_phase = phase(bob_rate, now);

    float angle = turn_angle * sin(phase(turn_rate, now));
    float c = wave_lacunarity * cos(angle);
    float s = wave_lacunarity * sin(angle);
    sea_finer = mat2(c, -s, s, c);

    sea_seconds = DRIFT_PERIOD > 0.0 ? vec2(mod(iTime, DRIFT_PERIOD), now.y) : now;
    float rate = rate_product(wave_scale, wave_speed);
    float slope = 1.0 + bob_height * bob_frequency; // bound of the height's, octave by octave
    float steepness = 1.5 * 3.14 * wave_height * wave_scale;
    for (int octave = 0; octave < OCTAVES; ++octave) {
        sea_drift[octave] = split_product(rate, sea_seconds, sea_cells[octave]);
        rate = rate_product(rate, wave_lacunarity);
        steepness *= wave_gain;
        slope += steepness;
        steepness *= wave_lacunarity;
    }
    // 6.7 is that bound at the defaults.
    sea_step = DOCUMENT == 1 ? 0.5 : step_scale * 6.7 / max(slope, 6.7);
}

// From one octave's lattice to the next.
vec3 finer(vec3 point) {
    return vec3(sea_finer * point.xy, wave_lacunarity * point.z);
}

vec3 drifted(vec3 point, int octave) {
    return vec3(point.xy, point.z - sea_drift[octave]);
}

// ---- The field ------------------------------------------------------------------------------------------

// sin(x) for 0 <= x <= 1/2 to 2.4e-8: less than a rounding of the result, and the same on every GPU.
float short_sine(float x) {
    float xx = x * x;
    return x * (0.99999966 + xx * (-0.16665588 + xx * 0.008246925));
}

// How far the folded octaves push the water down: 0..4.66 at the defaults, slope 5.52 at most.
float crests(vec3 position) {
    vec3 point = wave_scale * position;
    float depth = 0.0;
    float height = 3.14 * wave_height;
    for (int octave = 0; octave < OCTAVES; ++octave) {
        height *= wave_gain;
        float noise = value_noise(drifted(point, octave), ivec3(0, 0, -sea_cells[octave]));
        depth += height * short_sine(abs(noise - 0.5));
        point = finer(point);
    }
    return depth;
}

// The crests in x and their slope along world x and z in yz.
vec3 crests_slope(vec3 position) {
    vec3 point = wave_scale * position;
    mat2 turn = mat2(wave_scale); // world x and y to the octave's lattice,
    float stretch = wave_scale;   // and world z
    vec3 sum = vec3(0.0);
    float height = 3.14 * wave_height;
    for (int octave = 0; octave < OCTAVES; ++octave) {
        height *= wave_gain;
        vec4 noise = value_noise_gradient(drifted(point, octave), ivec3(0, 0, -sea_cells[octave]));
        float sine = short_sine(abs(noise.x - 0.5));
        float cosine = sqrt(1.0 - sine * sine);
        float fold = noise.x < 0.5 ? -cosine : cosine;
        sum += height * vec3(sine, fold * dot(turn[0], noise.yz), fold * stretch * noise.w);
        point = finer(point);
        turn = sea_finer * turn;
        stretch *= wave_lacunarity;
    }
    return sum;
}

// -bob_height..bob_height
float bob(float x) {
    return bob_height * sin(sea_bob_phase + bob_frequency * x);
}

// ---- The ray --------------------------------------------------------------------------------------------

vec3 ray_origin;
vec3 ray_direction;

// The height above the water, all but: its slope may reach 6.70 at the defaults (3.75 was seen), so that it
// is a distance, proved, when multiplied by 0.149. At sea_step, which is larger, a step can sink in a little.
float march_field(float t) {
    vec3 position = ray_origin + t * ray_direction;
    return sea_step * (position.y + crests(position) + bob(position.x));
}

#if SOLVER == MARCH_CERTIFIED
// How far v + s x - b x^2 / 2 stays above zero, from x = 0 on.
float free_ahead(float v, float s, float b) {
    if (v <= 0.0) {
        return 0.0;
    }
    float root = sqrt(s * s + 2.0 * b * v);
    return s < 0.0 ? 2.0 * v / (root - s) : (s + root) / max(b, 1e-9);
}

// No octave is negative, so every sum of the coarsest ones is a lower bound, and as it bends less it may prove
// more than the whole: the best of all of them. Where an octave folds, the branch that it is on goes on smoothly
// below the fold, |sin(n - 1/2)| >= +-sin(n - 1/2), so that no kink has to be reckoned with. The second
// derivative of that, along a unit of the lattice, is at most 6 + sin(1/2) (3/2)^2 < 7.1 (lib/noise.glsl).
vec2 march_clearance(float t) {
    vec3 position = ray_origin + t * ray_direction;
    float bob_rise = bob_height * bob_frequency * ray_direction.x;
    float sum = position.y + bob(position.x);
    float slope = ray_direction.y + bob_rise * cos(sea_bob_phase + bob_frequency * position.x);
    float bend = abs(bob_rise * bob_frequency * ray_direction.x);
    float clearance = free_ahead(sum, slope, bend);
    vec3 point = wave_scale * position;
    vec3 along = wave_scale * ray_direction;
    float stretch = wave_scale;
    float height = 3.14 * wave_height;
    for (int octave = 0; octave < OCTAVES; ++octave) {
        height *= wave_gain;
        vec2 noise = value_noise_along(drifted(point, octave), along, ivec3(0, 0, -sea_cells[octave]));
        float sine = short_sine(abs(noise.x - 0.5));
        float cosine = sqrt(1.0 - sine * sine);
        sum += height * sine;
        slope += height * (noise.x < 0.5 ? -cosine : cosine) * noise.y;
        bend += BEND_SCALE * 7.1 * height * stretch * stretch;
        clearance = max(clearance, free_ahead(sum, slope, bend));
        point = finer(point);
        along = finer(along);
        stretch *= wave_lacunarity;
    }
    return vec2(sea_step * sum, clearance);
}
#elif SOLVER == MARCH_SEGMENT
// Largest slope of the fade 3 s^2 - 2 s^3 between a and b, which lie in 0..1.
vec3 steepest_fade(vec3 a, vec3 b) {
    vec3 nearest = clamp(vec3(0.5), min(a, b), max(a, b));
    return 6.0 * nearest * (1.0 - nearest);
}

// Bound of the noise's slope from `point` to `point + along`: of the corners' differences while that stays in
// one cell, else 3/2 a unit.
float steepest_noise(vec3 point, vec3 along, ivec3 beyond) {
    vec3 cell = floor(point);
    float anywhere = 1.5 * length(along);
    if (any(notEqual(floor(point + along), cell))) {
        return anywhere;
    }
    vec4 left, right;
    lattice_cube(cell, beyond, left, right);
    vec4 x = abs(right - left);
    vec4 y = abs(vec4(left.yw - left.xz, right.yw - right.xz));
    vec4 z = abs(vec4(left.zw - left.xy, right.zw - right.xy));
    vec3 steps = vec3(max(max(x.x, x.y), max(x.z, x.w)), max(max(y.x, y.y), max(y.z, y.w)),
                      max(max(z.x, z.y), max(z.z, z.w)));
    vec3 fade = steepest_fade(point - cell, point + along - cell);
    return min(anywhere, k_hash_unit * dot(steps * fade, abs(along)));
}

// The field, and how fast it can fall anywhere from t to t + reach.
vec2 march_fall(float t, float reach) {
    vec3 position = ray_origin + t * ray_direction;
    float sum = position.y + bob(position.x);
    float fall = bob_height * bob_frequency * abs(ray_direction.x) - ray_direction.y;
    vec3 point = wave_scale * position;
    vec3 along = wave_scale * reach * ray_direction;
    float height = 3.14 * wave_height;
    for (int octave = 0; octave < OCTAVES; ++octave) {
        height *= wave_gain;
        ivec3 beyond = ivec3(0, 0, -sea_cells[octave]);
        vec3 at = drifted(point, octave);
        sum += height * short_sine(abs(value_noise(at, beyond) - 0.5));
        fall += height * steepest_noise(at, along, beyond) / reach;
        point = finer(point);
        along = finer(along);
    }
    return sea_step * vec2(sum, fall);
}
#endif

View camera() {
    vec2 ranges = vec2(yaw_range, pitch_range);
#if TURNING_POLES
    vec2 angles = mouse_angles(iMouse.xy / iResolution.xy, ranges);
    if (abs(angles.y) > 1.57079632) {
        angles = vec2(angles.x + 3.14159265, sign(angles.y) * 3.14159265 - angles.y);
    }
    return View(camera_position, camera_axes(angles.x, angles.y));
#else
    return sea_view(document_mouse, camera_position, default_turn, ranges, focal_length, bob_height + 0.3);
#endif
}

// The ray through a pixel, and the distance of the water on it; -1: none.
float look(vec2 frag_coord) {
    View view = camera();
    ray_origin = view.position;
    ray_direction = pixel_ray(view.axes, frag_coord, focal_length);
    make_sea();
    // The noise: of the coordinates of the finest octave, times its slope.
    MarchRange range = MarchRange(near_distance, far_distance, pixel_width(focal_length), 2e-6);
#if !DOCUMENT
    float deepest = 3.14 * wave_height * sin(0.5) * wave_gain / (1.0 - wave_gain);
    range = clip_to_slab(range, ray_origin, ray_direction, -deepest - bob_height, bob_height);
#endif
    return march(range);
}

// ---- Shading --------------------------------------------------------------------------------------------

// The water's slope along x and z, and the depth of the crests in z.
vec3 rise_at(vec3 position) {
#if ANALYTIC_NORMAL
    vec3 rise = crests_slope(position);
    rise.y += bob_height * bob_frequency * cos(sea_bob_phase + bob_frequency * position.x);
    return rise.yzx;
#else
    // A loop, so that a compiler need not hold four copies of the octaves.
    const float e = SLOPE_DISTANCE;
    vec2 rise = vec2(bob(position.x + e) - bob(position.x - e), 0.0);
    for (int i = 0; i < 4; ++i) {
        vec2 axis = (i & 1) == 0 ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
        float side = i < 2 ? 1.0 : -1.0;
        rise += side * axis * crests(position + side * e * vec3(axis.x, 0.0, axis.y));
    }
    return vec3(rise / (2.0 * e), crests(position));
#endif
}

// Four octaves of the noise picture, 0.05..0.5 at a contrast above 0. Repeats after 8.
float ripples(vec2 uv) {
    float sum = 0.5 * texture(iChannel0, 0.125 * uv).r + 0.25 * texture(iChannel0, 0.25 * uv).r +
                0.125 * texture(iChannel0, 0.5 * uv).r + 0.125 * texture(iChannel0, uv).r;
    return 0.45 * pow(sum, ripple_contrast) + 0.05;
}

// The noise picture, laid along the lattice of the octave after the last.
float ripples_at(vec3 position) {
    float stretch = 1.0;
    for (int octave = 0; octave < OCTAVES; ++octave) {
        position.xy = sea_finer * position.xy;
        stretch = rate_product(stretch, wave_lacunarity);
    }
    vec2 scale = vec2(broad_scale, fine_scale);
    vec2 rate = 0.125 * rate_product(scale, vec2(rate_product(stretch, wave_speed)));
    vec2 drift = 8.0 * vec2(fract_of_product(rate.x, sea_seconds), fract_of_product(rate.y, sea_seconds));
    vec2 at = vec2(position.x, stretch * position.z);
    return ripples(scale.x * at - vec2(0.0, drift.x)) + fine_weight * ripples(scale.y * at - vec2(0.0, drift.y));
}

// `slope_scale` 1/2 is the document's: its field carries the factor 1/2 while its vertical part does not.
vec3 shade(float t, vec3 position, float ripple) {
    vec3 rise = rise_at(position);
    vec3 normal = normalize(vec3(slope_scale * rise.x, 1.0, slope_scale * rise.y));
    float glint = clamp(glint_gain * fresnel(normal, ray_direction, glint_exponent), 0.0, 1.0);
    float tint = clamp(crest_tint * rise.z + ripple_tint * ripple, 0.0, 1.0);
    vec3 water = mix(deep_color, bright_color, tint) + glint_brightness * glint;
    return mix(air_color, water, cubic_clearness(t, fog_density));
}

#ifdef TIDEMARK_HIT
void mainHit(out vec4 hit, in vec2 fragCoord) {
    hit = march_report(look(fragCoord));
}
#endif

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float t = look(fragCoord);
    vec3 position = ray_origin + (t < 0.0 ? far_distance : t) * ray_direction;

    // Looked up for every pixel, the ones in the air too: beside the water's edge a texture read inside the
    // branch would have no neighbour to take its mipmap level from.
    float ripple = ripples_at(position);

    vec3 color = air_color;
    if (t >= 0.0) {
        color = shade(t, position, ripple);
    }
    fragColor = vec4(pow(max(color, 0.0), vec3(gamma)), 1.0);
}
