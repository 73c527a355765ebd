// Four buffers that each read themselves, and a picture of the four.
#iChannel0 "a.glsl"
#iChannel1 "b.glsl"
#iChannel2 "c.glsl"
#iChannel3 "d.glsl"
void mainImage(out vec4 color, in vec2 at) {
    ivec2 here = ivec2(at);
    color = vec4(texelFetch(iChannel0, here, 0).y, texelFetch(iChannel1, here, 0).y,
                 texelFetch(iChannel2, here, 0).y, 1.0) + 0.3 * texelFetch(iChannel3, here, 0).y;
}
