// The wave equation, d2h/dt2 = c^2 laplacian(h), a step a frame: drag the mouse through the water.
//
// A buffer keeps four floats a pixel, not a colour, and may read what it wrote in the frame before.
#iChannel0 "self"

#iUniform float stillness = 0.004 in { 0.0, 0.1 } // part of the movement that a frame takes away

// (c dt / dx)^2: how far a wave goes in a frame, squared. In two dimensions steps are stable up to 1/2.
const float k_courant_squared = 0.25;
const int k_frames_between_drops = 90;
const int k_frames_of_a_drop = 16; // it sinks in bit by bit: a jump would be seen
const float k_drop_radius = 6.0; // pixels

// -1..1 for a whole number, the same on every GPU: rounds of multiplying and folding the high bits onto the low.
float random(uint n) {
    n = (n ^ (n >> 16)) * 0x7feb352du;
    n = (n ^ (n >> 15)) * 0x846ca68bu;
    n ^= n >> 16;
    return float(n >> 8) * (2.0 / 16777215.0) - 1.0;
}

// How much of a drop at `middle` a pixel gets, 0..1.
float drop(vec2 pixel, vec2 middle) {
    vec2 away = (pixel - middle) / k_drop_radius;
    return exp(-dot(away, away));
}

// What falls into the water in this frame.
float pushed(vec2 pixel) {
    float push = iMouse.z > 0.0 ? 0.2 * drop(pixel, iMouse.xy) : 0.0;
    int frame = iFrame % k_frames_between_drops;
    if (frame < k_frames_of_a_drop) {
        uint number = uint(iFrame / k_frames_between_drops);
        vec2 place = vec2(random(2u * number), random(2u * number + 1u));
        float strength = 0.15 * sin(3.14159265 * float(frame) / float(k_frames_of_a_drop));
        push += strength * drop(pixel, (0.5 + 0.4 * place) * iResolution.xy);
    }
    return -push;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 place = ivec2(fragCoord);
    Cell here = cell_at(iChannel0, place);
    float around = cell_at(iChannel0, place + ivec2(1, 0)).x + cell_at(iChannel0, place - ivec2(1, 0)).x +
                   cell_at(iChannel0, place + ivec2(0, 1)).x + cell_at(iChannel0, place - ivec2(0, 1)).x;
    // First the movement, then the height from the new movement: in the other order energy would grow.
    float movement = (1.0 - stillness) * here.y + k_courant_squared * (around - 4.0 * here.x) + pushed(fragCoord);
    fragColor = vec4(here.x + movement, movement, 0.0, 1.0);
}
