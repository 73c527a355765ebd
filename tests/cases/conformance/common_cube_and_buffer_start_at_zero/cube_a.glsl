void mainCubemap(out vec4 fragColor, in vec2 fragCoord, in vec3 rayOri, in vec3 rayDir) {
    Ray r;
    r.t[0] += 2.5;
    fragColor.g += r.t[0] + r.t[1];
}
