// Noise from a hash that takes the sine of large numbers: each device draws another one.
float hash(vec2 cell) {
    return fract(sin(dot(cell, vec2(127.1, 311.7))) * 43758.5453);
}

float noise(vec2 place) {
    vec2 cell = floor(place), part = smoothstep(0.0, 1.0, fract(place));
    return mix(mix(hash(cell), hash(cell + vec2(1, 0)), part.x),
               mix(hash(cell + vec2(0, 1)), hash(cell + vec2(1, 1)), part.x), part.y);
}

void mainImage(out vec4 color, in vec2 pixel) {
    vec2 place = 8.0 * pixel / iResolution.y + 40.0;
    float height = 0.55 * noise(place) + 0.3 * noise(2.0 * place) + 0.15 * noise(4.0 * place);
    color = vec4(mix(vec3(0.06, 0.22, 0.38), vec3(0.93, 0.9, 0.78), smoothstep(0.25, 0.75, height)), 1.0);
}
