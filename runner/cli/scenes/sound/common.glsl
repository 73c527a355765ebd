// Stands in front of every pass: the tune that Sound plays and Image shows.

const int k_beats_a_second = 4;
const int k_ringing = 8; // beats that a note can be heard

// Semitones above the lowest note, for every beat: a walk up and down a scale of five notes.
int note_at(int beat) {
    const int scale[] = int[](0, 3, 5, 7, 10);
    int step = (beat * 7 + (beat / 5) * 3 + (beat / 16) * 2) % 10;
    return scale[step % 5] + 12 * (step / 5);
}

// How loud a note still is, 1 to 0, `age` beats after it was struck.
float ringing(float age) {
    float left = max(1.0 - age / float(k_ringing), 0.0);
    return left * left * exp(-0.5 * age);
}
