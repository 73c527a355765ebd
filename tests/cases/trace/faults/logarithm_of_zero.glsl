void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float octave = log(floor(uv.x)); // born -Inf: log of a number that is not above 0
    fragColor = vec4(octave);
}
