//: pixel 0 255 51
// Conditions among the arguments of a macro: the site's preprocessor follows them there.
#define SPATIAL
#define SECOND(a, b) (b)
#define ONE(a) (a)
float split() {
    return SECOND(
#ifdef SPATIAL
        0.5, ONE(1.0)
#else
        0.5, vec2(0)
#endif
    );
}
float nested() {
    return ONE(SECOND(0.0,
#if 0
    #ifdef SPATIAL
        1.0
    #endif
#elif __VERSION__ >= 300
        0.2
#else
        (((
#endif
    ));
}
// Conditions around whole calls are left to the driver.
#ifdef SPATIAL
float whole() { return ONE(1.0); }
#endif
void mainImage(out vec4 o, vec2 p) { o = vec4(0, split() * whole(), nested(), 1); }
