//: pixel 0 255 0
void mainImage(out vec4 o, vec2 p) {
    uint a = packHalf2x16(vec2(1)), b = packSnorm2x16(vec2(1)), c = packUnorm2x16(vec2(1));
    o = vec4(0, unpackHalf2x16(a).x * unpackSnorm2x16(b).y * unpackUnorm2x16(c).x, floatBitsToInt(0.0), 1);
    float t[2][2] = float[2][2](float[2](0., 0.), float[2](0., 0.));
    o.b += t[1][0];
}
