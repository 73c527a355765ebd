//: pixel 0 255 0
#ifdef GL_ES
precision highp float;
#define GREEN 1.0
#else
#define GREEN float4(
#endif
#if defined(GL_ES) && __VERSION__ == 300 && !defined(__cplusplus)
void mainImage(out vec4 o, vec2 p) { o = vec4(0.0, GREEN, 0.0, 1.0); }
#else
half4 main(float2 p : TEXCOORD) { return half4(p, 0, 1); }
#endif
