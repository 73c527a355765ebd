struct Ray { vec3 from; float t[2]; };
void raise(out Ray r) { r.t[1] += 1.5; }
float[3] none(bool given) { if (given) return float[3](1.0, 1.0, 1.0); }
