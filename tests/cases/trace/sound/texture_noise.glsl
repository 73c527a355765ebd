void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = texture(iChannel0, uv) + texelFetch(iChannel0, ivec2(1), 0) + textureLod(iChannel0, uv, 0.0) / 8.0;
    fragColor.xy += vec2(textureSize(iChannel0, 0)) * 1e-4;
}
