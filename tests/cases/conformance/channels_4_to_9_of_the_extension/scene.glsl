#iChannel4 "four.glsl"
#iChannel9 "nine.glsl"
#iChannel9::MinFilter "Nearest"
void mainImage(out vec4 c, in vec2 p) {
    c.rgb = p.x < 1.0 ? texelFetch(iChannel4, ivec2(2, 1), 0).rgb
          : p.x < 2.0 ? texelFetch(iChannel9, ivec2(0), 0).rgb : iChannelResolution[9];
}
