// The bars of the tune, each lit while it rings. `tidemark NAME` plays the sound with it.

#iUniform color3 metal = color3(0.12, 0.16, 0.22)
#iUniform color3 struck = color3(1.0, 0.65, 0.2)

const int k_notes = 10;
const int k_semitones[] = int[](0, 3, 5, 7, 10, 12, 15, 17, 19, 22);

// How loud that note is, 0..1 and more, from all the beats that still ring.
float loudness(int semitone) {
    float beats = iTime * float(k_beats_a_second);
    int now = int(beats);
    float sum = 0.0;
    for (int ago = 0; ago < k_ringing && ago <= now; ++ago) {
        if (note_at(now - ago) == semitone) {
            float age = beats - float(now - ago);
            sum += smoothstep(0.0, 0.3, age) * ringing(age); // lights up quickly, but does not jump
        }
    }
    return sum;
}

// 1 inside of a bar around (0, 0) of that size, with an edge of a pixel.
float bar_cover(vec2 from_middle, vec2 size) {
    vec2 inside = 0.5 * size - abs(from_middle);
    return clamp(min(inside.x, inside.y) * iResolution.y + 0.5, 0.0, 1.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float wide = iResolution.x / (iResolution.y * float(k_notes)); // a bar's place, in heights of the picture
    int number = clamp(int(uv.x * float(k_notes)), 0, k_notes - 1);
    vec2 from_middle = vec2((fract(uv.x * float(k_notes)) - 0.5) * wide, uv.y - 0.5);
    // The frequency of a bar goes with 1 / length^2.
    float length_of_bar = 0.75 * exp2(-float(k_semitones[number]) / 24.0);

    float loud = loudness(k_semitones[number]);
    float cover = bar_cover(from_middle, vec2(0.7 * wide, length_of_bar));
    vec3 color = mix(vec3(0.01, 0.012, 0.02), metal + loud * struck, cover);
    fragColor = vec4(pow(clamp(color, 0.0, 1.0), vec3(1.0 / 2.2)), 1.0);
}
