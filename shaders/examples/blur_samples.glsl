// A disc of light as a lens out of focus makes it: SAMPLES looks at the picture on a spiral of golden angles
// (H. Vogel, 1979). The noise between them is the error that blur_samples.study.json measures.
#define SAMPLES 64
#iUniform float radius = 0.12 in { 0.0, 0.4 }

vec3 lights(vec2 p) {
    vec3 sum = vec3(0.02, 0.03, 0.06);
    for (int i = 0; i < 7; ++i) {
        float a = float(i);
        vec2 place = 0.35 * vec2(cos(2.4 * a + 0.1 * iTime), sin(3.1 * a));
        sum += exp(-900.0 * dot(p - place, p - place)) * (0.5 + 0.5 * cos(a + vec3(0.0, 2.0, 4.0))) * 12.0;
    }
    return sum;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < SAMPLES; ++i) {
        float part = (float(i) + 0.5) / float(SAMPLES);
        float angle = 2.39996323 * float(i);
        sum += lights(uv + radius * sqrt(part) * vec2(cos(angle), sin(angle)));
    }
    fragColor = vec4(sum / float(SAMPLES), 1.0);
}
