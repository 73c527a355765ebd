//: pixel 58 58 7 255
// ShaderToy puts 53 lines before the text of Image: there __LINE__ is 58 in line 5.
#define HERE (__LINE__)
void mainImage(out vec4 c, in vec2 p) {
    int a = __LINE__, b = HERE;
#if __LINE__ == 59
    int d = 7;
#else
    int d = 0;
#endif
    c = vec4(float(a), float(b), float(d), 255.0) / 255.0;
}
