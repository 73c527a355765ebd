uniform float time;
uniform vec2 resolution;
uniform vec2 mouse;
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = fragCoord.x < 1.0 ? vec4(time, resolution, 1.0) : vec4(mouse, 0.0, 1.0);
}
