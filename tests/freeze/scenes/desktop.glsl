void mainImage(out vec4 c, in vec2 p) {
    double d = 1.0lf;
    c = vec4(float(d) * iCamera[3].x);
}
