// What goes round and round as time goes on: phases and drifts that are as fine after a month as at the start.
// A product of two floats is taken apart into four products of halves, each exact, and each is reduced before
// they are added (T. J. Dekker's splitting, 1971, with reduction in between). What is left is the quantum of
// iTime itself: 2^-17 s after a minute, 1/16 s after 12 days.
#ifndef LIB_PHASE
#define LIB_PHASE

// The upper 12 bits of a float's 24; the rest, x - upper_half(x), has at most 12.
float upper_half(float x) {
    return uintBitsToFloat(floatBitsToUint(x) & 0xfffff000u);
}

vec4 exact_products(float a, float b) {
    vec2 x = vec2(upper_half(a), a - upper_half(a));
    vec2 y = vec2(upper_half(b), b - upper_half(b));
    return x.xxyy * y.xyxy;
}

// a b - floor(a b), 0..1, to 4e-7.
float fract_of_product(float a, float b) {
    vec4 parts = fract(exact_products(a, b));
    return fract(parts.x + parts.y + parts.z + parts.w);
}

// The same, and floor(a b) modulo 2^32 in `whole`.
float split_product(float a, float b, out int whole) {
    vec4 products = exact_products(a, b);
    vec4 floors = floor(products);
    vec4 parts = products - floors;
    ivec4 wholes = ivec4(floors - 4294967296.0 * floor(floors * (1.0 / 4294967296.0) + 0.5));
    float part = parts.x + parts.y + parts.z + parts.w;
    whole = wholes.x + wholes.y + wholes.z + wholes.w + int(part);
    return fract(part);
}

// rate * time, in radians, modulo 2 pi: 0..2 pi, to 1e-5 for rate * time up to 10^8. 1 / (2 pi) is taken in
// three parts, of which the first two have 12 bits.
float phase(float rate, float time) {
    vec2 r = vec2(upper_half(rate), rate - upper_half(rate));
    const vec2 turn = vec2(0.15911865234375, 3.628432750701904e-5);
    float turns = fract_of_product(r.x * turn.x, time) + fract_of_product(r.y * turn.x, time) +
                  fract_of_product(r.x * turn.y, time) + fract_of_product(r.y * turn.y, time) +
                  fract_of_product(rate * 6.420638316725915e-9, time);
    return 6.283185307 * fract(turns);
}
#endif
