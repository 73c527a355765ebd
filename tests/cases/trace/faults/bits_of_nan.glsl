void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float odd = uintBitsToFloat(0x7fc00000u + uint(uv.x)); // born NaN: the bits do not encode a finite number
    fragColor = vec4(odd);
}
