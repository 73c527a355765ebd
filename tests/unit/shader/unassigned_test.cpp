// Variables without a value: those that some read surely sees so, and none that may have one.
#include "shader/undefined_behaviour.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace tidemark::glsl::unassigned_test {

/// `name:line` of each read, with a `?` where only some way leaves it without a value; `name:-` for an `out`
/// that is never written, `name:-line` where some `return` (or the body's end) leaves it so, `name()` for a
/// function that may end without one.
std::string found(const std::string& text) {
    text::MappedText source;
    source.append(text, "a.glsl", 1);
    const auto parsed = ParsedText::read(std::move(source), {});
    if (!parsed)
        return to_string(parsed.error());
    using Why = Unassigned::Why;
    std::string all;
    for (const Unassigned& each : find_unassigned(**parsed, find_facts(**parsed))) {
        const std::string line = std::to_string((*parsed)->used((*parsed)->tree()[each.at].word).line);
        const std::string how = each.why == Why::never              ? ":" + line
                                : each.why == Why::on_some_way      ? "?:" + line
                                : each.why == Why::not_given        ? ":-"
                                : each.why == Why::left_on_some_way ? ":-" + line
                                                                    : "()";
        all += fmt::format("{}{}{}", all.empty() ? "" : " ", (*parsed)->word_of(each.what), how);
    }
    return all;
}

std::string in_main(const std::string& statements) {
    return found("uniform float u;\nvoid main() {\n" + statements + "\n}\n");
}

TEST(Unassigned, AReadBeforeAnyWriteIsFound) {
    EXPECT_EQ(in_main("float a; float b = a;"), "a:3");
    EXPECT_EQ(in_main("vec3 v; v += 1.0;"), "v?:3");
    EXPECT_EQ(in_main("float a[2], b;\nb = a[0];"), "a:4");
    EXPECT_EQ(in_main("float a; if (u > 0.0) a = 1.0;\nelse u + a;"), "a?:4");
    EXPECT_EQ(in_main("float a; { float a = 1.0; u + a; }\nu + a;"), "a:4");
    EXPECT_EQ(in_main("int i;\ni++;"), "i?:4");
}

TEST(Unassigned, TheFirstIterationOfALoopIsFound) {
    EXPECT_EQ(in_main("float i;\nfor (; i++ < 9.0;) u + i;"), "i?:4");
    EXPECT_EQ(in_main("for (int i;\ni < 3; ++i) u;"), "i?:4");
    EXPECT_EQ(in_main("float a;\nfor (int i = 0; i < 3; ++i) { u + a; a = 1.0; }"), "a?:4");
}

TEST(Unassigned, APathWithoutAValueIsFound) {
    EXPECT_EQ(in_main("float a; if (u > 0.0) a = 1.0;\nu + a;"), "a?:4");
    EXPECT_EQ(in_main("float a; if (u > 0.0 && (a = 1.0) > u) u;\nu + a;"), "a?:4");
    EXPECT_EQ(in_main("float a; for (int i = 0; i < int(u); ++i) a = 1.0;\nu + a;"), "a?:4");
    EXPECT_EQ(in_main("float a; while (u > 0.0) { a = 1.0; }\nu + a;"), "a?:4");
    EXPECT_EQ(in_main("float a; do { if (u > 1.0) break; a = 1.0; } while (u > 0.0);\nu + a;"), "a?:4");
    EXPECT_EQ(in_main("float a; switch (int(u)) { case 0: a = 1.0; break; case 1: a = 2.0; }\nu + a;"),
              "a?:4");
    EXPECT_EQ(in_main("float a; for (int i = 0; i < 3; ++i) { if (i == 0) continue; a = 1.0; }\nu + a;"),
              "a?:4");
    EXPECT_EQ(in_main("float a;\nfor (int i = 0; i < 3; ++i) { if (i > 0) u + a; a = 1.0; }"), "a?:4");
}

TEST(Unassigned, ComponentsAreTrackedSeparately) {
    const std::string types = "struct I { float d; vec2 k[2]; };\nstruct S { I i; float e; };\n";
    EXPECT_EQ(found(types + "S f() { S s; s.i.d = 1.0;\nreturn s; }\nvoid main() { f(); }\n"), "s?:4");
    EXPECT_EQ(found(types + "void main() { S s; s.i.d = 1.0; s.e = s.i.d;\ns.i.k[1].y; }\n"), "s?:4");
    EXPECT_EQ(found(types + "void main() { S s; s.i.d = 1.0; s.e = 2.0; s.i.k[0] = vec2(1.0);\n"
                            "s.i.k[1].xy = vec2(2.0); S t = s; }\n"),
              "");
    EXPECT_EQ(in_main("vec2 v; v.x = 1.0;\nu + v.y;"), "v?:4");
    EXPECT_EQ(in_main("float a[2]; a[0] = 1.0;\nu + a[1];"), "a?:4");
    EXPECT_EQ(in_main("mat2 m; m[0] = vec2(1.0); m[1].x = u;\nm;"), "m?:4");
    EXPECT_EQ(in_main("vec3 v; v.xz = vec2(1.0); v.g = 1.0; u + v;"), "");
}

TEST(Unassigned, ValuesOnEveryPathPass) {
    for (const char* statements :
         {"float a; a = 1.0; u + a;", "float a; if (u > 0.0) a = 1.0; else a = 2.0; u + a;",
          "float a; if (u > 0.0) a = 1.0; else return; u + a;",
          "float a; if (u > 0.0) discard; else a = 1.0; u + a;",
          "float a; for (int i = 0; i < 3; ++i) { a = 1.0; if (u > 1.0) break; } u + a;",
          "float a; for (;;) { a = 1.0; if (u > 1.0) break; } u + a;",
          "float a; do a = 1.0; while (u > 0.0); u + a;",
          "float a; switch (int(u)) { case 0: a = 1.0; break; default: a = 2.0; } u + a;",
          "float a = u > 0.0 ? 1.0 : 2.0; u + a;", "vec2 v; v.x = 1.0; u + v.x;",
          "float a[40]; for (int i = 0; i < 40; ++i) a[i] = float(i); u + a[7];",
          "const int N = 40; float a[N]; int i; for (i = 0; i < N; i++) { a[i] = u; } u + a[i - 1];",
          "vec3 v; for (int i = 0; i < 3; ++i) v[i] = u; u + v.z;", "float w; modf(u, w); u + w;",
          "float a, b; a = b = 1.0; u + a + b;", "float unread;", "float a[3]; a.length();",
          "for (float i; u > 0.0;) { i = 1.0; u + i; }", "const float c = 1.0; u + c;"})
        EXPECT_EQ(in_main(statements), "") << statements;
}

TEST(Unassigned, LoopsThatSkipElementsDoNotFillAnArray) {
    EXPECT_EQ(in_main("float a[40]; for (int i = 0; i < 39; ++i) a[i] = u;\nu + a[7];"), "a?:4");
    EXPECT_EQ(in_main("float a[40]; for (int i = 1; i < 40; ++i) a[i] = u;\nu + a[7];"), "a?:4");
    EXPECT_EQ(in_main("float a[40]; for (int i = 0; i < 40; i += 2) a[i] = u;\nu + a[7];"), "a?:4");
    EXPECT_EQ(in_main("float a[40]; for (int i = 0; i < 40; ++i) { a[i] = u; ++i; }\nu + a[7];"), "a?:4");
    EXPECT_EQ(in_main("float a[40]; for (int i = 0; i < 40; ++i) { if (u > 1.0) continue; a[i] = u; }\n"
                      "u + a[7];"),
              "a?:4");
}

TEST(Unassigned, ArgumentsThatAFunctionWritesAreWrites) {
    EXPECT_EQ(found("void give(out float x) { x = 1.0; }\nvoid main() { float a; give(a); a + 1.0; }\n"), "");
    const std::string fill =
        "float give(out float x) { x = 1.0; return x; }\nvoid main() { float a[40], b;\n";
    EXPECT_EQ(found(fill + "for (int i = 0; i < 40; ++i) b = give(a[i]);\na[7] + 1.0; }\n"), "");
    EXPECT_EQ(found(fill + "for (int i = 0; i < 40; ++i) if (i > 0) give(a[i]);\na[7] + 1.0; }\n"), "a?:4");
    EXPECT_EQ(found("float twice(in float x) { return 2.0 * x; }\nvoid main() { float a;\ntwice(a); }\n"),
              "a:3");
}

TEST(Unassigned, OutParameters) {
    EXPECT_EQ(found("void f(out vec4 c) { c += 1.0; }\nvoid main() { vec4 v; f(v); }\n"), "c?:1");
    EXPECT_EQ(found("void f(out vec4 c) { }\nvoid main() { vec4 v; f(v); }\n"), "c:-");
    EXPECT_EQ(found("void f(inout vec4 c) { c += 1.0; }\nvoid main() { vec4 v = vec4(0); f(v); }\n"), "");
    EXPECT_EQ(found("void f(out vec4 c) {\nc.x = 1.0; }\nvoid main() { vec4 v; f(v); }\n"), "c:-1");
    EXPECT_EQ(found("float f(out bool c) { for (int i = 0; i < 9; ++i) if (i > 3)\nc = true;\nreturn 1.0; }\n"
                    "void main() { bool b; f(b); }\n"),
              "c:-3");
    EXPECT_EQ(found("void f(out float c) { if (c > 1.0) { c = 1.0; return; } c = 2.0; }\n"
                    "void main() { float v; f(v); }\n"),
              "c?:1");
    EXPECT_EQ(found("void f(out float);\nvoid main() { float v; f(v); v + 1.0; }\nvoid f(out float) { }\n"),
              "");
    EXPECT_EQ(found("void f(inout float x) { x += 1.0; }\nvoid main() { float v;\nf(v); }\n"), "v?:3");
}

TEST(Unassigned, AmbiguousOverloadsPass) {
    EXPECT_EQ(found("void f(out float x) { x = 1.0; }\nvoid f(vec2 x) { }\n"
                    "void main() { float v; f(v); v + 1.0; }\n"),
              "");
}

TEST(Unassigned, FunctionsThatMayEndWithoutAReturn) {
    EXPECT_EQ(found("float f(float x) { if (x > 1.0) return 7.0; }\nvoid main() { f(1.0); }\n"), "f()");
    EXPECT_EQ(
        found("float f(float x) { if (x > 1.0) return 7.0; else return 8.0; }\nvoid main() { f(1.0); }\n"),
        "");
    EXPECT_EQ(found("float f(float x) { for (;;) if (x++ > 1.0) return 7.0; }\nvoid main() { f(1.0); }\n"),
              "");
    EXPECT_EQ(found("float f(int x) { switch (x) { case 0: return 1.0; default: return 2.0; } }\n"
                    "void main() { f(1); }\n"),
              "");
    EXPECT_EQ(found("void f(float x) { if (x > 1.0) return; }\nvoid main() { f(1.0); }\n"), "");
}

TEST(Unassigned, GlobalsThroughCalls) {
    EXPECT_EQ(found("float g;\nvoid main() { g + 1.0; }\n"), "g:2");
    EXPECT_EQ(found("float g;\nvoid set() { g = 1.0; }\nvoid main() {\ng + 1.0; set(); }\n"), "g?:4");
    EXPECT_EQ(found("float g;\nvoid set() { g = 1.0; }\nvoid main() { set(); g + 1.0; }\n"), "");
    EXPECT_EQ(found("float g;\nfloat get() {\nreturn g; }\nvoid set() { if (get() > 1.0) g = 1.0; }\n"
                    "void main() { set(); }\n"),
              "g?:3");
    EXPECT_EQ(found("float g;\nfloat h = g;\nvoid main() { g = 1.0; }\n"), "g?:2");
    EXPECT_EQ(found("float g;\nvoid late();\nvoid main() { late(); g + 1.0; }\nvoid late() { g = 1.0; }\n"),
              "");
    EXPECT_EQ(found("uniform float g;\nin vec2 h;\nvoid main() { g + h.x; }\n"), "");
}

TEST(Unassigned, UnreachableCodePasses) {
    EXPECT_EQ(found("float dead() { float a; return a; }\nvoid main() { }\n"), "");
}

} // namespace tidemark::glsl::unassigned_test
