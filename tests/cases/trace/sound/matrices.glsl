void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    mat3 m = mat3(1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 4.0);
    mat3 back = inverse(m) * m;
    mat2x3 n = mat2x3(vec3(uv, 1.0), vec3(1.0));
    m[1].xy += uv;
    m *= 0.5;
    fragColor = vec4(back * vec3(uv, 1.0) + n * uv, determinant(m));
}
