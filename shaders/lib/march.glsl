// Where a ray meets a surface that is the zero of a field. SOLVER chooses how, at compile time; only the
// chosen one is compiled. A scene defines, anywhere in its text,
//
//     float march_field(float t);
//         the field at distance t along the ray in hand, divided by a bound of its slope, so that it is a
//         distance: no zero is nearer than |value|. Positive outside. What happens when the bound is wished
//         for rather than proved stands at each solver.
//     vec2 march_clearance(float t);        (MARCH_CERTIFIED alone)
//         the field, and how far ahead it is proved to have no zero.
//     vec2 march_fall(float t, float reach);        (MARCH_SEGMENT alone)
//         the field, and a proved bound of how fast it falls anywhere from t to t + reach.
//
// and calls march(). The ray is the scene's own affair; it keeps it in global variables.
//
//     SOLVER            finds the first zero, when                     samples a step
//     MARCH_SPHERE      the slope bound holds and MAX_STEPS suffice    1
//     MARCH_ENHANCED    the slope bound holds                          1, and 1 for each step taken back
//     MARCH_AUTO        the slope bound holds                          1, and 1 for each step taken back
//     MARCH_CERTIFIED   always: the field brings its own proof         1 clearance
//     MARCH_BRACKET     the slope bound holds; but for what is         1, and 1 for each step taken back
//                       thinner than k_gap of a pixel
//     MARCH_SEGMENT     always: the field brings a bound for a stretch  1 field and bound
//     MARCH_FIXED       no two zeros are nearer than FIXED_STEP        1
//
// All take at most MAX_STEPS samples on the way (those of the last interpolation not counted) and do not look
// beyond range.far. A ray whose steps run out has met the surface if it is within a pixel of it
// (MARCH_SPHERE: wherever it is).
//
// With TIDEMARK_HIT defined, counters are kept for mainHit; else there are none.
#ifndef LIB_MARCH
#define LIB_MARCH
#define MARCH_SPHERE 1
#define MARCH_ENHANCED 2
#define MARCH_AUTO 3
#define MARCH_CERTIFIED 4
#define MARCH_BRACKET 5
#define MARCH_FIXED 6
#define MARCH_SEGMENT 7

struct MarchRange {
    float near;  // where the field may first be looked at, world units
    float far;   // beyond this there is nothing
    float pixel; // width of a pixel at distance 1
    float noise; // of the field: smaller values are rounding
};

// The part of `range` where y can be between `lowest` and `highest`: exact, and for many rays nothing.
// Empty (near > far) when the ray misses that slab; a ray that starts below it keeps its start.
MarchRange clip_to_slab(MarchRange range, vec3 origin, vec3 direction, float lowest, float highest) {
    if (direction.y < 0.0) {
        range.near = max(range.near, (highest - origin.y) / direction.y);
        range.far = min(range.far, max(range.near, (lowest - origin.y) / direction.y));
    } else if (origin.y > highest) {
        range.far = -1.0;
    } else if (direction.y > 0.0) {
        range.far = min(range.far, (highest - origin.y) / direction.y);
    }
    return range;
}

float march_field(float t);

#ifdef TIDEMARK_HIT
const int k_hit_exhausted = 1; // the steps ran out
const int k_hit_negative = 2;  // below zero where the slope bound promised otherwise: it does not hold there
const int k_hit_inside = 4;    // the range begins below zero
float march_samples = 0.0;
float march_last = 0.0;
int march_flags = 0;

float march_count(float value) {
    march_last = value;
    march_samples += 1.0;
    if (march_samples == 1.0 && value < 0.0) {
        march_flags |= k_hit_inside;
    }
    return value;
}

float march_sample(float t) {
    return march_count(march_field(t));
}

// What mainHit gives for the distance that march() gave.
vec4 march_report(float distance) {
    return vec4(distance, march_samples, march_last, float(march_flags));
}

#define MARCH_FLAG(flag, condition) if (condition) march_flags |= flag
#else
#define march_sample march_field
#define march_count(value)
#define MARCH_FLAG(flag, condition)
#endif

// The value that counts as touching: what 1/500 of a pixel is wide, and more than the field's noise.
float march_touch(MarchRange range, float t) {
    return max(range.noise, 0.002 * range.pixel * t);
}

// The steps ran out at t: there is a surface if it is within a pixel.
float march_exhausted(MarchRange range, float t, float value) {
    MARCH_FLAG(k_hit_exhausted, true);
    return value < range.pixel * t ? t : -1.0;
}

#if SOLVER == MARCH_SPHERE
#include "march/sphere.glsl"
#elif SOLVER == MARCH_ENHANCED
#include "march/enhanced.glsl"
#elif SOLVER == MARCH_AUTO
#include "march/auto_relaxed.glsl"
#elif SOLVER == MARCH_CERTIFIED
#include "march/certified.glsl"
#elif SOLVER == MARCH_BRACKET
#include "march/bracket.glsl"
#elif SOLVER == MARCH_SEGMENT
#include "march/segment.glsl"
#elif SOLVER == MARCH_FIXED
#include "march/fixed_step.glsl"
#else
#error SOLVER has to be one of the MARCH_... of lib/march.glsl
#endif
#endif
