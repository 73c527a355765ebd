#if defined(GL_ES) && 0
this is no code
#elif __VERSION__ >= 300
#define OK 1
#else
neither is this
#endif
#ifdef OK
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(uv, 0.0, 1.0);
}
#endif
