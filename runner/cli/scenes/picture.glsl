// Rings that spread from the mouse.
//
// mainImage is called for each pixel of each frame, and knows of no other pixel and no earlier frame. It reads
//
//     vec3  iResolution   size of the picture, pixels
//     float iTime         seconds since the start
//     int   iFrame        frames since the start
//     vec4  iMouse        xy: where the mouse was last down, pixels from the bottom left; (0, 0) before its first click
//
// and the rest of ShaderToy's uniforms: `tidemark help uniforms`.

// Knobs: values in this text, sliders in the window (Tab), `--set rings=12` on the command line.
#iUniform float rings = 8.0 in { 1.0, 30.0 }
#iUniform float speed = 0.5 in { -2.0, 2.0 }
#iUniform color3 deep = color3(0.01, 0.06, 0.15)
#iUniform color3 light = color3(0.45, 0.75, 0.85)

const float k_tau = 6.28318531;

// From pixels to heights of the picture, (0, 0) in its middle: a circle is round in a window of any shape.
vec2 place_of(vec2 pixel) {
    return (pixel - 0.5 * iResolution.xy) / iResolution.y;
}

// How bright the rings are at a distance from their middle, 0..1. They are `rings` to the height of the picture, and
// `speed` of them pass a second; they fade with the distance.
float rings_at(float distance) {
    return exp(-2.0 * distance) * (0.5 + 0.5 * cos(k_tau * (rings * distance - speed * iTime)));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 middle = iMouse.xy == vec2(0.0) ? vec2(0.0) : place_of(iMouse.xy);
    float bright = rings_at(length(place_of(fragCoord) - middle));
    vec3 color = mix(deep, light, bright);
    fragColor = vec4(pow(color, vec3(1.0 / 2.2)), 1.0); // from light to the numbers that screens take
}
