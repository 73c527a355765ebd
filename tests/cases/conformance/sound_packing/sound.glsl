vec2 mainSound(int samp, float time) {
    return vec2(float(samp % 1000) / 1000.0 - 0.5, time < 8.0 ? 0.25 : -0.25);
}
