// The estimated load of a text on a driver: small texts pass, and unbounded growth is found.
#include "glsl_support.hpp"
#include "shader/driver_log.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace tidemark::glsl::driver_load_test {

DriverLoad load_of(const std::string& text) {
    text::MappedText source;
    source.append("#version 330 core\n" + text, "a.glsl", 1);
    return driver_load(source);
}

DriverLoad load_in_main(const std::string& statements) {
    return load_of("void main() { " + statements + " }\n");
}

std::string repeated(const std::string& piece, int count) {
    std::string all;
    for (int i = 0; i < count; ++i)
        all += piece;
    return all;
}

TEST(DriverLoad, OrdinaryTexts) {
    EXPECT_TRUE(load_in_main("float a = 1.0; a += sin(a);").modest());
    EXPECT_TRUE(
        load_of("float noise(vec2 p) { return fract(sin(dot(p, vec2(12.9, 78.2))) * 43758.5); }\n"
                "const vec2 k[9] = vec2[9](vec2(0), vec2(1), vec2(2), vec2(3), vec2(4), vec2(5), "
                "vec2(6), vec2(7), vec2(8));\n"
                "float fbm(vec2 p) { float s = 0.0; for (int i = 0; i < 9; ++i) s += noise(p + k[i]); "
                "return s; }\nvoid main() { float x = fbm(vec2(1)) + fbm(vec2(2)); }\n")
            .modest());
}

TEST(DriverLoad, MacrosThatDouble) {
    std::string text = "#define A0 x\n";
    for (int i = 1; i <= 40; ++i)
        text += fmt::format("#define A{} A{} + A{}\n", i, i - 1, i - 1);
    EXPECT_FALSE(load_of(text + "void main() { float x = 1.0; x = A40; }\n").modest());
    EXPECT_TRUE(load_of(text + "void main() { float x = 1.0; x = A4; }\n").modest());
}

TEST(DriverLoad, FunctionsThatDouble) {
    std::string text = "float f0(float x) { return sin(x) + x; }\n";
    for (int i = 1; i <= 25; ++i)
        text += fmt::format("float f{}(float x) {{ return f{}(x) + f{}(x + 1.0); }}\n", i, i - 1, i - 1);
    EXPECT_GT(load_of(text + "void main() { float x = f25(1.0); }\n").inlined, std::pow(2.0, 25));
    EXPECT_TRUE(
        load_of(text.substr(0, text.find("float f6")) + "void main() { float x = f5(1.0); }\n").modest());
    EXPECT_FALSE(load_of("float f(float x);\nvoid main() { " + repeated("f(1.0); ", 3000) +
                         "}\nfloat f(float x) { return x; }\n")
                     .modest());
}

TEST(DriverLoad, AFunctionThatIsCalledBeforeItsText) {
    std::string text = "void image();\nvoid main() { image(); }\nfloat f0(float x) { return x; }\n";
    for (int i = 1; i <= 25; ++i)
        text += fmt::format("float f{}(float x) {{ return f{}(x) + f{}(x + 1.0); }}\n", i, i - 1, i - 1);
    EXPECT_FALSE(load_of(text + "void image() { float x = f25(1.0); }\n").modest());
}

TEST(DriverLoad, Depth) {
    for (const auto& [open, close] : {std::pair{"sin(", ")"}, {"(", ")"}, {"- ", ""}, {"x + ", ""}}) {
        EXPECT_FALSE(
            load_in_main("float x = 1.0; x = " + repeated(open, 5000) + "x" + repeated(close, 5000) + ";")
                .modest())
            << open;
        EXPECT_TRUE(load_in_main("float x = 1.0; x = " + repeated(open, 50) + "x" + repeated(close, 50) + ";")
                        .modest())
            << open;
    }
    EXPECT_FALSE(load_in_main(repeated("{", 5000) + repeated("}", 5000)).modest());
}

TEST(DriverLoad, Elements) {
    EXPECT_EQ(load_of("float a[10];\nvoid main() { vec4 b[3], c; mat4x3 m[2][5]; }\n").elements, 120);
    EXPECT_EQ(load_of("vec2[3] a[4];\nvoid main() {}\n").elements, 24);
    EXPECT_EQ(load_of("const int N = 4 * (20 + 1);\nfloat a[N];\nvoid main() {}\n").elements, 84);
    EXPECT_EQ(load_of("#define N 80u\nint a[N * 2u];\nvoid main() {}\n").elements, 160);
    EXPECT_EQ(load_of("float a[] = float[](1.0, 2.0);\nvoid main() {}\n").elements, 0);
    EXPECT_EQ(
        load_of("struct A { float x[10]; vec3 y; };\nstruct B { A a[10]; } b;\nB c[2];\nvoid main() {}\n")
            .elements,
        3 * 130);
    for (const char* text :
         {"float a[100000000];", "float a[2147483647];", "float a[1000][1000][100];", "float a[int(1e9)];",
          "const int N = int(1e9);\nfloat a[N];", "const int N = 1 << 28;\nfloat a[N];", "float a[1 << 28];",
          "struct A { float x[1000]; };\nstruct B { A a[1000]; };\nB b[1000];",
          "float[100000] f() { return float[100000](0.0); }", "void f(float a[100000]) {}"})
        EXPECT_FALSE(load_of(std::string(text) + "\nvoid main() {}\n").modest()) << text;
}

TEST(DriverLoad, Blocks) {
    EXPECT_FALSE(load_of("uniform B { vec4 x[1000000000]; };\nvoid main() {}\n").modest());
    EXPECT_TRUE(load_of("uniform B { vec4 x[10]; };\nvoid main() {}\n").modest());
}

TEST(DriverLoad, NestedLoops) {
    const auto nested = [](int count) {
        std::string loops;
        for (int i = 0; i < count; ++i)
            loops += fmt::format("for (int i{0} = 0; i{0} < 2; ++i{0}) ", i);
        return loops + "x += 1.0;";
    };
    EXPECT_EQ(load_in_main("float x = 0.0; " + nested(5)).loops, 5);
    EXPECT_TRUE(load_in_main("float x = 0.0; " + nested(5)).modest());
    EXPECT_FALSE(load_in_main("float x = 0.0; " + nested(60)).modest());
    std::string text = "float f0(float x) { return x; }\n";
    for (int i = 1; i <= 12; ++i)
        text += fmt::format("float f{}(float x) {{ for (int i = 0; i < 8; ++i) x += f{}(x); return x; }}\n",
                            i, i - 1);
    EXPECT_EQ(load_of(text + "void main() { float x = f12(1.0); }\n").loops, 12);
}

TEST(DriverLoad, DivisionOfTheSmallestIntByMinus1) {
    for (const char* text : {"int x = (-2147483647 - 1) / -1;", "int x = int(0x80000000u) % -1;",
                             "int x = (1 << 31) / ~0;", "int x = (1 << 31) / (0 - 1);"})
        EXPECT_FALSE(load_in_main(text).modest()) << text;
    EXPECT_FALSE(load_of("#if (-9223372036854775807 - 1) / -1\n#endif\nvoid main() {}\n").modest());
    EXPECT_TRUE(load_in_main("uint n = 7u * 3518319155u; int i = -1; i /= 31;").modest());
    EXPECT_TRUE(
        load_in_main("uint n = 7u; n = n & 0x7fffffffu; float x = float(n) / 2147483647.0 - 1.0;").modest());
}

TEST(DriverLoad, LoadOfAScene) {
    EXPECT_TRUE(is_modest(scene_of("void mainImage(out vec4 c, in vec2 p) { c = vec4(p, 0, 1); }"),
                          Precision::single));
    EXPECT_FALSE(
        is_modest(scene_of("float a[100000];\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(a[3]); }"),
                  Precision::single));
}

} // namespace tidemark::glsl::driver_load_test
