// The sound: mainSound gives left and right, -1..1, of each sample. `tidemark NAME` plays it in step with the picture,
// `tidemark capture NAME -o tune.wav` writes it.

const float k_tau = 6.28318531;
const float k_lowest = 220.0; // hertz

// A struck bar: its first partials (those of a bar that is free at both ends) with the higher ones dying sooner.
float bar(float hertz, float seconds) {
    float age = seconds * float(k_beats_a_second);
    float wave = sin(k_tau * hertz * seconds) + 0.4 * exp(-age) * sin(k_tau * 2.756 * hertz * seconds) +
                 0.2 * exp(-2.0 * age) * sin(k_tau * 5.404 * hertz * seconds);
    float attack = 1.0 - exp(-600.0 * seconds); // no click
    return attack * ringing(age) * wave;
}

vec2 mainSound(int samp, float time) {
    // Counted in whole samples: a note in the third minute is as fine as the first.
    int samples_a_beat = int(iSampleRate) / k_beats_a_second;
    int beat = samp / samples_a_beat;
    vec2 sum = vec2(0.0);
    for (int ago = 0; ago < k_ringing && ago <= beat; ++ago) {
        float seconds = float(samp - (beat - ago) * samples_a_beat) / iSampleRate;
        int note = note_at(beat - ago);
        float left = 0.3 + 0.4 * float(note) / 22.0; // low notes from the right, high ones from the left
        sum += vec2(left, 1.0 - left) * bar(k_lowest * exp2(float(note) / 12.0), seconds);
    }
    return 0.25 * sum;
}
