#define MAX_STEPS 64
void mainImage(out vec4 c, in vec2 p) {
    float sum = 0.0;
    for (int i = 1; i <= MAX_STEPS; ++i)
        sum += sin(float(i) * p.x) / (float(i) * float(i));
    c = vec4(vec3(sum), 1.0);
}
