// The water of Buffer A, seen from above, over a tiled floor.
#iChannel0 "buffer_a.glsl"

#iUniform float depth = 40.0 in { 0.0, 200.0 } // pixels that a slope of 1 moves the floor by
#iUniform float tile = 45.0 in { 10.0, 200.0 } // pixels
#iUniform color3 water_color = color3(0.25, 0.62, 0.7)

// Rise per pixel: central differences.
vec2 slope_at(ivec2 place) {
    float right = cell_at(iChannel0, place + ivec2(1, 0)).x, left = cell_at(iChannel0, place - ivec2(1, 0)).x;
    float above = cell_at(iChannel0, place + ivec2(0, 1)).x, below = cell_at(iChannel0, place - ivec2(0, 1)).x;
    return 0.5 * vec2(right - left, above - below);
}

// 0 on the joints between tiles, 1 on a tile, with an edge of a pixel.
float tiles(vec2 pixel) {
    vec2 joint = abs(fract(pixel / tile) - 0.5) * tile;
    return smoothstep(0.0, 1.5, 0.5 * tile - max(joint.x, joint.y) - 0.5);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 slope = slope_at(ivec2(fragCoord));
    vec3 normal = normalize(vec3(-slope, 0.35)); // steeper than it is, to be seen
    vec3 to_light = normalize(vec3(-0.4, 0.6, 1.0));
    float lit = 0.55 + 0.45 * dot(normal, to_light);
    float glint = pow(max(reflect(-to_light, normal).z, 0.0), 24.0);
    vec3 color = water_color * lit * mix(0.7, 1.0, tiles(fragCoord - depth * slope)) + 0.25 * glint;
    fragColor = vec4(pow(clamp(color, 0.0, 1.0), vec3(1.0 / 2.2)), 1.0);
}
