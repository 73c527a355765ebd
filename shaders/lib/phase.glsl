// What goes round and round as time goes on: phases and drifts that are as fine after a month as at the start.
// Time comes in two floats, and a product with it is taken apart into products of halves, each exact, which are
// reduced before they are added (T. J. Dekker's splitting, 1971, with reduction in between). Rates are floats by
// definition: in a month the last bit of one is whole waves, so the ones that a scene promoted to double computes
// have to be the same.
#ifndef LIB_PHASE
#define LIB_PHASE

// What iTime, a float, leaves of the seconds; 0 where the host does not know it, as on ShaderToy, and where iTime
// is a double.
uniform float iTimeLow;

// Since the start, to 2^-48 of it: the sum of two floats.
vec2 seconds() {
    return vec2(iTime, iTimeLow);
}

// x as a float holds it. Rounds where the scene runs in double, and is nothing else.
float binary32(float x) {
    return uintBitsToFloat(floatBitsToUint(x));
}

vec2 binary32(vec2 x) {
    return uintBitsToFloat(floatBitsToUint(x));
}

vec4 binary32(vec4 x) {
    return uintBitsToFloat(floatBitsToUint(x));
}

// The product of two rates, or factors of one, as floats have it.
float rate_product(float a, float b) {
    return binary32(binary32(a) * binary32(b));
}

vec2 rate_product(vec2 a, vec2 b) {
    return binary32(binary32(a) * binary32(b));
}

vec4 rate_product(vec4 a, vec4 b) {
    return binary32(binary32(a) * binary32(b));
}

// The upper 12 bits of a float's 24; the rest, x - upper_half(x), has at most 12.
float upper_half(float x) {
    return uintBitsToFloat(floatBitsToUint(x) & 0xfffff000u);
}

vec4 exact_products(float a, float b) {
    vec2 x = vec2(upper_half(a), a - upper_half(a));
    vec2 y = vec2(upper_half(b), b - upper_half(b));
    return x.xxyy * y.xyxy;
}

// rate time - floor(rate time), 0..1, to 4e-7; `time` is the sum of its components, of which the second is small.
float fract_of_product(float rate, vec2 time) {
    rate = binary32(rate);
    vec4 parts = fract(exact_products(rate, time.x));
    return fract(parts.x + parts.y + parts.z + parts.w + rate * time.y);
}

// The same, and floor(rate time) modulo 2^32 in `whole`.
float split_product(float rate, vec2 time, out int whole) {
    rate = binary32(rate);
    vec4 products = exact_products(rate, time.x);
    vec4 floors = floor(products);
    vec4 parts = products - floors;
    ivec4 wholes = ivec4(floors - 4294967296.0 * floor(floors * (1.0 / 4294967296.0) + 0.5));
    float part = parts.x + parts.y + parts.z + parts.w + rate * time.y;
    whole = wholes.x + wholes.y + wholes.z + wholes.w + int(floor(part));
    return fract(part);
}

// rate time, in radians, modulo 2 pi: 0..2 pi, to 1e-5 for rate time up to 10^8. 1 / (2 pi) is taken in three
// parts, of which the first two have 12 bits.
float phase(float rate, vec2 time) {
    rate = binary32(rate);
    vec2 r = vec2(upper_half(rate), rate - upper_half(rate));
    const vec2 turn = vec2(0.15911865234375, 3.628432750701904e-5);
    float turns = fract_of_product(r.x * turn.x, time) + fract_of_product(r.y * turn.x, time) +
                  fract_of_product(r.x * turn.y, time) + fract_of_product(r.y * turn.y, time) +
                  fract_of_product(rate * 6.420638316725915e-9, time);
    return 6.283185307 * fract(turns);
}
#endif
