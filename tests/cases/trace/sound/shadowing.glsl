void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float x = uv.x;
    { float x = 2.0; x += 1.0; { vec2 x = uv; fragColor = vec4(x, 0.0, 1.0); } }
    fragColor *= x;
}
