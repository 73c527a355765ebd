// Zeros in a text: where it counts on them, and nowhere else.
#include "glsl_support.hpp"
#include "shader/portability.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace tidemark::glsl::initialise_test {

text::MappedText mapped(const std::string& text) {
    text::MappedText source;
    source.append(text, "a.glsl", 1);
    return source;
}

std::string zeroed(const std::string& text) {
    text::MappedText source = mapped(text);
    start_at_zero(source, Version::core_330);
    return source.text();
}

/// In a body that runs.
std::string in_main(const std::string& statements) {
    const std::string head = "uniform float u;void main(){";
    const std::string result = zeroed(head + statements + "}\n");
    return result.substr(head.size(), result.size() - head.size() - 2);
}

TEST(Initialise, VariablesAssignedBeforeUseAreUnchanged) {
    for (const char* statements : {"float a; a = 1.; u + a;", "vec2 v; v.x = u; v.y = u; u * v;",
                                   "float a; if (u > 1.) a = 1.; else a = 2.; u + a;", "float unread;",
                                   "float a[900]; for (int i = 0; i < 900; i++) a[i] = u; a[7];"})
        EXPECT_EQ(in_main(statements), statements);
    for (const char* text :
         {"struct S { float a, b; };\nuniform float mine;\nconst float c = 1.;\nfloat f(float x, vec2 y);\n",
          "void f(out vec4 o, in vec2 p) { o = vec4(p, 0, 1); }\nvoid main() { vec4 c; f(c, c.xy = vec2(1)); "
          "}\n",
          "float f(inout float x) { x += 1.; return x; }\nvoid main() { float x = 1.; f(x); }\n",
          "#define D float a, b\n#define E(n) float n;\nvoid main() { }\n",
          "float never(float x) { float a; return a; }\nvoid main() { }\n",
          "uniform sampler2D s;\nlayout(location = 0) out vec4 o;\nin vec2 v;\nvoid main() { o += vec4(v, "
          "v); }\n"})
        EXPECT_EQ(zeroed(text), text);
}

TEST(Initialise, NumbersVectorsAndMatrices) {
    EXPECT_EQ(in_main("float a, b = 1., c; a + c;"), "float a=0.0, b = 1., c=0.0; a + c;");
    EXPECT_EQ(in_main("for (int i; i < 3; i++) { highp vec3 p; p += u; }"),
              "for (int i=0; i < 3; i++) { highp vec3 p=vec3(0.0); p += u; }");
    EXPECT_EQ(in_main("mat2x3 m; bvec2 b; uint n; m[0] + m[1]; b.x; n;"),
              "mat2x3 m=mat2x3(0.0); bvec2 b=bvec2(false); uint n=0u; m[0] + m[1]; b.x; n;");
    EXPECT_EQ(in_main("float a,\n// c\n  b; a + b;"), "float a=0.0,\n// c\n  b=0.0; a + b;");
}

TEST(Initialise, StructuresAndArrays) {
    const std::string types = "struct I{float d;vec2 k[2];};struct S{I i;bool b;};";
    EXPECT_EQ(zeroed(types + "void main(){S s; s.b;}\n"),
              types + "void main(){S s=S(I(0.0, vec2[2](vec2(0.0), vec2(0.0))), false); s.b;}\n");
    EXPECT_EQ(in_main("float a[2]; a[int(u)];"), "float a[2]=float[2](0.0, 0.0); a[int(u)];");
    EXPECT_EQ(
        in_main("vec2[900] a; a[1];"),
        "vec2[900] a;for(int tidemark_0=0;tidemark_0<900;++tidemark_0){a[tidemark_0]=vec2(0.0);} a[1];");
    EXPECT_EQ(in_main("float a[90][2]; a[1];"),
              "float a[90][2];for(int tidemark_0=0;tidemark_0<90;++tidemark_0)"
              "{a[tidemark_0]=float[2](0.0, 0.0);} a[1];");
    EXPECT_EQ(zeroed("const int N = 9 * 9;void main(){float a[N]; a[1];}\n"),
              "const int N = 9 * 9;void main(){float a[N];"
              "for(int tidemark_0=0;tidemark_0<a.length();++tidemark_0){a[tidemark_0]=0.0;} a[1];}\n");
    EXPECT_EQ(in_main("struct{float a;vec2 b;} s; s.a;"),
              "struct{float a;vec2 b;} s;s.a=0.0;s.b=vec2(0.0); s.a;");
    // A variable hides the structure's name.
    EXPECT_EQ(zeroed("struct Ray{float t;};void main(){Ray Ray; Ray.t;}\n"),
              "struct Ray{float t;};void main(){Ray Ray;Ray.t=0.0; Ray.t;}\n");
}

TEST(Initialise, exponentially_large_structures_are_unchanged) {
    std::string text = "struct S0{float a;};";
    for (int i = 1; i <= 60; ++i)
        text += fmt::format("struct S{0}{{S{1} a;S{1} b;}};", i, i - 1);
    text += "uniform float u;void main(){S60 s;if(s.a.a.a.a.a.a==u)discard;}\n";
    EXPECT_EQ(zeroed(text), text);
}

TEST(Initialise, OutParameters) {
    EXPECT_EQ(
        zeroed("void f(out vec4 o, vec2 p) { o += 1.; }\nvoid main() { vec4 c; f(c, vec2(1)); }\n"),
        "void f(out vec4 o, vec2 p) {o=vec4(0.0); o += 1.; }\nvoid main() { vec4 c; f(c, vec2(1)); }\n");
    for (const char* body :
         {"o.r = 1.;", "if (p.x > 0.) o = vec4(1);", "if (p.x>0.) return; o = vec4(0.0);", "p;"}) {
        const std::string head = "void f(out vec4 o, vec2 p) {";
        const std::string tail = std::string(" ") + body + " }\nvoid main() { vec4 c; f(c, vec2(1)); }\n";
        EXPECT_EQ(zeroed(head + tail), head + "o=vec4(0.0);" + tail);
    }
    EXPECT_EQ(zeroed("void f(out float a[99]) { a[1] = 1.; }\nvoid main() { float a[99]; f(a); }\n"),
              "void f(out float a[99]) {for(int tidemark_0=0;tidemark_0<99;++tidemark_0){a[tidemark_0]=0.0;} "
              "a[1] = 1.; }\nvoid main() { float a[99]; f(a); }\n");
}

TEST(Initialise, Globals) {
    EXPECT_EQ(zeroed("float g;\nvec3 h[2];\nvoid main() { g + h[1].x; }\n"),
              "float g=0.0;\nvec3 h[2]=vec3[2](vec3(0.0), vec3(0.0));\nvoid main() { g + h[1].x; }\n");
    EXPECT_EQ(zeroed("float g;\nvoid main() { g = 1.; g; }\n"), "float g;\nvoid main() { g = 1.; g; }\n");
    EXPECT_EQ(zeroed("int t[500];\nvoid main() { t[3]; }\n"),
              "int t[500];void tidemark_start();\nvoid main() {tidemark_start(); t[3]; }\n"
              "\nvoid tidemark_start() { for(int "
              "tidemark_0=0;tidemark_0<500;++tidemark_0){t[tidemark_0]=0;}}\n");
}

TEST(Initialise, FunctionsThatMayEndWithoutAReturn) {
    EXPECT_EQ(zeroed("vec2 f(float x) { if (x > 1.) return vec2(7); }\nvoid main() { f(1.); }\n"),
              "vec2 f(float x) { if (x > 1.) return vec2(7);return vec2(0.0); }\nvoid main() { f(1.); }\n");
    EXPECT_EQ(
        zeroed("float[99] f(float a[99]) { if (a[1] > 1.) return a; }\nvoid main() { f(float[99](1.)); }\n"),
        "float[99] f(float a[99]) { if (a[1] > 1.) return a;float[99] tidemark_value;"
        "for(int tidemark_0=0;tidemark_0<99;++tidemark_0){tidemark_value[tidemark_0]=0.0;}"
        "return tidemark_value; }\nvoid main() { f(float[99](1.)); }\n");
    const std::string none = "float f(float x) { x; }\nvoid main() { f(1.); }\n"; // an error everywhere
    EXPECT_EQ(zeroed(none), none);
}

TEST(Initialise, DeclarationsInMacros) {
    EXPECT_EQ(zeroed("#define V vec2\nvoid main() { V a; a; }\n"),
              "#define V vec2\nvoid main() { V a=vec2(0.0); a; }\n");
    EXPECT_EQ(zeroed("#define m(O) mat2 r; O = r\nvoid main() { mat2 a; m(a); }\n"),
              "#define m(O) mat2 r=mat2(0.0); O = r\nvoid main() { mat2 a; m(a); }\n");
    EXPECT_EQ(zeroed("#define D(T, n) T n\nvoid main() { D(float, a), b; a + b; }\n"),
              "#define D(T, n) T n\nvoid main() { D(float, a=0.0), b=0.0; a + b; }\n");
    // The name occurs twice in the macro's expansion, but the text has only one place for the zero.
    EXPECT_EQ(zeroed("#define D(n) float n; n += 1.\nvoid main() { D(a); }\n"),
              "#define D(n) float n=0.0; n += 1.\nvoid main() { D(a); }\n");
    EXPECT_EQ(zeroed("#define J(n) float n##_x;\nvoid main() { J(a) J(b) a_x + b_x; }\n"),
              "#define J(n) float n##_x=0.0;\nvoid main() { J(a) J(b) a_x + b_x; }\n");
    EXPECT_EQ(zeroed("#define L(n, k) float n[k];\nvoid main() { L(a, 80) L(b, 90) a[1] + b[1]; }\n"),
              "#define L(n, k) float n[k];\nvoid main() { L(a, 80) "
              "for(int tidemark_0=0;tidemark_0<80;++tidemark_0){a[tidemark_0]=0.0;}L(b, 90) "
              "for(int tidemark_0=0;tidemark_0<90;++tidemark_0){b[tidemark_0]=0.0;}a[1] + b[1]; }\n");
    EXPECT_EQ(zeroed("#define mainImage(O,U) void f(out vec4 O,vec2 U)\nmainImage(O,U){O-=O;}\n"
                     "void main() { vec4 c; f(c, vec2(1)); }\n"),
              "#define mainImage(O,U) void f(out vec4 O,vec2 U)\nmainImage(O,U){O=vec4(0.0);O-=O;}\n"
              "void main() { vec4 c; f(c, vec2(1)); }\n");
}

TEST(Initialise, MacrosWithDifferentNeedsPerUse) {
    // Another length: the zeros of the short array go after the macro's call.
    EXPECT_EQ(zeroed("#define L(n, k) float n[k];\nvoid main() { L(a, 80) L(b, 2) a[1] + b[1]; }\n"),
              "#define L(n, k) float n[k];\nvoid main() { L(a, 80) "
              "for(int tidemark_0=0;tidemark_0<80;++tidemark_0){a[tidemark_0]=0.0;}L(b, 2) "
              "b=float[2](0.0, 0.0);a[1] + b[1]; }\n");
    // A function that is never called, and one that is called.
    EXPECT_EQ(
        zeroed("#define G(f) void f(out float x) { x += 1.; }\nG(a)\nG(b)\nvoid main() { float x; a(x); }\n"),
        "#define G(f) void f(out float x) {x=0.0; x += 1.; }\nG(a)\nG(b)\nvoid main() { float x; a(x); "
        "}\n");
    // One has a value before it is read.
    EXPECT_EQ(zeroed("#define B float left, right;\nvoid main() { { B left + right; } { B left = right = 1.; "
                     "left; } }\n"),
              "#define B float left=0.0, right=0.0;\n"
              "void main() { { B left + right; } { B left = right = 1.; left; } }\n");
}

TEST(Initialise, MacrosDoNotChangeTheZeros) {
    for (const char* text :
         {"#define vec2 vec3\n#undef vec2\nvoid main() { vec2 a; a; }\n", // whether it holds is not asked
          "#define F(vec2) float b; b\nvoid main() { F(1.); }\n"}) {
        const std::string result = zeroed(text);
        EXPECT_EQ(result.find("vec2(0.0)"), std::string::npos) << result;
    }
}

TEST(Initialise, ParametersOfADefinitionHaveNames) {
    EXPECT_EQ(
        zeroed("float f(float, const in vec2[2], S s, T) { return 1.; }\nvoid g(void) {}\nfloat h(vec2);\n"),
        "float f(float tidemark_unnamed_1, const in vec2[2] tidemark_unnamed_2, S s, T tidemark_unnamed_4) "
        "{ return 1.; }\nvoid g(void) {}\nfloat h(vec2);\n");
    EXPECT_EQ(zeroed("#define P vec2,\nvoid f(P int i) { }\n"),
              "#define P vec2 tidemark_unnamed_1,\nvoid f(P int i) { }\n");
}

TEST(Initialise, LinesAndColumnsAreTheAuthors) {
    text::MappedText source = mapped("void main() {\n  float a; int b[90];\n  a + float(b[1]); WRONG\n}\n");
    start_at_zero(source, Version::core_330);
    const std::string& text = source.text();
    EXPECT_EQ(count(text, "\n"), 4);
    const auto column = [&](std::string_view piece) {
        const size_t at = text.find(piece);
        return int(at - text.rfind('\n', at));
    };
    EXPECT_EQ(source.lines().locate(2, column("int b[90]")).column, 12);
    EXPECT_EQ(source.lines().locate(3, column("WRONG")).column, 20);
}

TEST(Initialise, UnparsedTextsAreInitialisedByTokens) {
    const std::string odd = "#ifdef GL_UNHEARD_OF\n#endif\n#if GL_UNHEARD_OF\nfloat x;\n#endif\n";
    EXPECT_EQ(
        zeroed(
            odd +
            "struct S{float a;};\nvoid f(out vec2 o, out S s, inout float i){float a, b = 1., c[3];S t;}\n"),
        "#ifdef GL_UNHEARD_OF\n#endif\n#if GL_UNHEARD_OF\nfloat x=float(0);\n#endif\nstruct S{float a;};\n"
        "void f(out vec2 o, out S s, inout float i){o=vec2(0);float a=float(0), b = 1., c[3];S t;}\n");
    EXPECT_EQ(zeroed(odd + "#define V vec2\nV a;\n"),
              "#ifdef GL_UNHEARD_OF\n#endif\n#if GL_UNHEARD_OF\nfloat x=float(0);\n#endif\n#define V vec2\nV "
              "a=V(0);\n");
}

TEST(Initialise, JunkTakesLinearTime) {
    for (const char* piece :
         {"float a=(", "void main(){float a;a+", "struct {", "#define N(a) -a\n", "N(-", "for(float a",
          "float a,", "void f(out float b){b+=1.;}\n", "float g;void main(){g;}\n", "{"}) {
        std::string text;
        while (text.size() < 400'000)
            text += piece;
        EXPECT_GE(zeroed(text).size(), text.size()) << piece;
    }
}

} // namespace tidemark::glsl::initialise_test
