//: pixel 0 255 0
void mainImage(out vec4 o, vec2 p) {
    vec4 t = texture(iCh0.sampler, p) + texelFetch(iCh3.sampler, ivec2(0), 0);
    o = vec4(0.0 * t.x, 1.0, 0.0 * (iCh0.size.x + iCh1.time + float(iCh2.loaded)), 1.0);
    o.b += iChannel[1].resolution.x + iChannel[2].time;
}
