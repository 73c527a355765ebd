void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    Ray r = Ray(vec3(9.0), float[2](9.0, 9.0));
    raise(r);
    float[3] a = none(fragCoord.x < 0.0);
    fragColor.r = r.t[1] + r.t[0] + r.from.x + a[1];
}
