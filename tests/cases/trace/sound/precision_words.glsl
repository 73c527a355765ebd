precision highp float;
precision mediump int;
highp float half_of(in highp float x) { lowp float y = x; return y * 0.5; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    mediump vec2 v = uv;
    fragColor = vec4(v, half_of(uv.x), 1.0);
}
