// The mirrored sun.
#ifndef LIB_SPECULAR
#define LIB_SPECULAR

// J. Blinn's highlight (1977): 1 where the unit normal halves the angle between the unit directions to the light
// and to the eye, 0 away from it; `exponent` >= 1, the larger the smaller.
float blinn_phong(vec3 normal, vec3 to_light, vec3 to_eye, float exponent) {
    return pow(max(dot(normal, normalize(to_light + to_eye)), 0.0), exponent);
}

// The exponent of a surface that is smooth by 0..1: 2..2048.
float smooth_exponent(float smoothness) {
    return exp2(1.0 + 10.0 * smoothness);
}
#endif
