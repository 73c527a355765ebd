#extension GL_ARB_shading_language_420pack : enable
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float w[3] = { 1.0, 2.0, uv.x };
    vec2 v = { uv.x, uv.y };
    fragColor = vec4(v, w[1], w[2]);
}
