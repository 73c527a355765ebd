// A glowing ball of drifting smoke, integrated along each ray in STEPS equal parts. How many are enough is what
// volume_steps.study.json asks.
#define STEPS 64
#iUniform float density = 3.0 in { 0.0, 10.0 }
#iUniform float detail = 2.5 in { 0.5, 8.0 }

// Smooth everywhere, so that the error of the sum falls with the square of the step.
float smoke(vec3 p) {
    float ball = exp(-3.0 * dot(p, p));
    vec3 q = detail * p + vec3(0.0, -iTime, 0.3 * iTime);
    return ball * (1.2 + sin(q.x + sin(q.y)) * sin(q.y + sin(q.z)) + 0.5 * sin(2.7 * q.z + q.x));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    vec3 origin = vec3(0.0, 0.0, -2.0);
    vec3 direction = normalize(vec3(uv, 1.0));
    float part = 4.0 / float(STEPS);
    float clear = 1.0;
    vec3 light = vec3(0.0);
    for (int i = 0; i < STEPS; ++i) {
        vec3 p = origin + part * (float(i) + 0.5) * direction;
        float here = part * density * smoke(p);
        // Half of the part's own smoke stands before its middle.
        light += clear * exp(-0.5 * here) * here * mix(vec3(1.0, 0.5, 0.2), vec3(0.2, 0.5, 1.0), p.y + 0.5);
        clear *= exp(-here);
    }
    fragColor = vec4(light + clear * vec3(0.02, 0.03, 0.05), 1.0);
}
