void left(out float level[3]) { level[2] += 0.5; }
vec2 stereo(bool given) { if (given) return vec2(1.0); }
vec2 mainSound(int samp, float time) {
    float level[3] = float[3](1.0, 1.0, 1.0);
    left(level);
    vec2 sum;
    sum.x += level[2] + level[0] + stereo(time < 0.0).x;
    return sum;
}
