void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float a = 0.0, b = uv.x;
    a = floor(b), b = log(a), fragColor = vec4(b); // born -Inf: log of a number that is not above 0; column 23
}
