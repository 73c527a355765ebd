// How much more a surface mirrors at a glancing look.
#ifndef LIB_FRESNEL
#define LIB_FRESNEL

// (1 - cos)^exponent of the angle between the unit normal and the unit direction of the look, 0..1 on the side
// that the normal points to, up to 2^exponent behind it (C. Schlick, 1994, has it with exponent 5). Unit
// vectors may have a cosine a rounding above 1: pow() of what is then below 0 would be undefined.
float fresnel(vec3 normal, vec3 look, float exponent) {
    return pow(max(1.0 + dot(normal, look), 0.0), exponent);
}

// The unit normal, turned towards the eye where its cosine with the way back to the eye is below `least`: facets
// that look away are hidden by those before them.
vec3 seen_normal(vec3 normal, vec3 look, float least) {
    return normalize(normal - look * max(dot(normal, look) + least, 0.0));
}
#endif
