void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec3 direction = vec3(floor(uv), 1.0);
    vec3 slab = 1.0 / direction; // born +Inf: division by zero
    float near = min(slab.z, max(slab.x, slab.y));
    float haze = sqrt(uv.x - 1.5); // cures
    fragColor = vec4(near + haze);
}
