#iChannel0 "wide.png"
vec2 mainSound(int samp, float time) {
    return iChannelResolution[0].xy / 16.0 - vec2(0.0625, 0.0);
}
