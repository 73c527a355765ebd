// One step of a reaction and diffusion (Gray and Scott 1983) of two substances in x and y, started from stripes.
#iChannel0 "self"
void mainImage(out vec4 color, in vec2 at) {
    ivec2 here = ivec2(at), last = ivec2(iResolution.xy) - 1;
    if (iFrame == 0) {
        color = vec4(1.0, step(0.9, sin(0.1 * at.x + KIND) * sin(0.13 * at.y)), 0.0, 1.0);
        return;
    }
    vec2 sum = vec2(0.0);
    for (int i = 0; i < 9; ++i) {
        ivec2 beside = clamp(here + ivec2(i % 3, i / 3) - 1, ivec2(0), last);
        sum += texelFetch(iChannel0, beside, 0).xy * (i == 4 ? -1.0 : i % 2 == 1 ? 0.2 : 0.05);
    }
    vec2 uv = texelFetch(iChannel0, here, 0).xy;
    float reaction = uv.x * uv.y * uv.y, feed = 0.03 + 0.002 * KIND;
    color = vec4(uv + vec2(sum.x - reaction + feed * (1.0 - uv.x), 0.5 * sum.y + reaction - (0.06 + feed) * uv.y), 0.0, 1.0);
}
