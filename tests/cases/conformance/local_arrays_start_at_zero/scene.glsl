void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    int at = int(fragCoord.x) + 1;
    float a[5];
    vec3[4] b;
    int large[500];
    mat2 m[3];
    bool flag[2];
    a[at] += 1.0;
    b[at].y += 2.0;
    large[100 * at] += 3;
    m[at - 1][1] += 0.25;
    float other = 0.0;
    for (int i = 0; i < 500; ++i)
        if (i != 100 * at)
            other += float(large[i]);
    for (int i = 0; i < 5; ++i)
        if (i != at)
            other += a[i] + b[min(i, 3)].x;
    if (flag[at - 1])
        other += 1.0;
    fragColor = vec4(a[at], b[at].y, float(large[100 * at]) + m[at - 1][1].x + m[at - 1][1].y + other, 1.0);
}
