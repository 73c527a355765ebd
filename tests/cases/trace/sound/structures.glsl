struct Ray { vec3 origin, direction; };
struct Hit { float t; Ray ray; int id; bool met; };
Hit cast(Ray r) { Hit h = Hit(1.0, r, 3, true); h.t /= 2.0; return h; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    Hit h = cast(Ray(vec3(0.0), vec3(uv, 1.0)));
    fragColor = vec4(h.t * h.ray.direction, float(h.id));
}
