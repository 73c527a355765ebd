#iChannel0 "keyboard"
#iChannel1 "noise"
vec2 mainSound(int samp, float time) {
    bool keyboard = iChannelResolution[0].x > 0.0 || texelFetch(iChannel0, ivec2(0), 0) != vec4(0, 0, 0, 1);
    bool noise = iChannelResolution[1].x > 0.0 && texelFetch(iChannel1, ivec2(0), 0) != vec4(0, 0, 0, 1);
    return vec2(keyboard ? 0.5 : -0.5, noise ? 0.25 : -0.25);
}
