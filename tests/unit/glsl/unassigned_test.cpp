// Variables without a value: those that some read surely sees so, and none that may have one.
#include "glsl/watch/unassigned.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace tidemark::glsl {
namespace {

/// `name:line` of each read, `name:-` for an `out` that is never written.
std::string found(const std::string& text) {
    text::MappedText source;
    source.append(text, "a.glsl", 1);
    const auto parsed = ParsedText::read(std::move(source), {});
    if (!parsed)
        return to_string(parsed.error());
    std::string all;
    for (const Unassigned& each : find_unassigned(**parsed, find_facts(**parsed)))
        all += fmt::format("{}{}:{}", all.empty() ? "" : " ", (*parsed)->word_of(each.variable),
                           each.read == k_no_node
                               ? "-"
                               : std::to_string((*parsed)->used((*parsed)->tree()[each.read].word).line));
    return all;
}

std::string in_main(const std::string& statements) {
    return found("uniform float u;\nvoid main() {\n" + statements + "\n}\n");
}

TEST(Unassigned, AReadBeforeAnyWriteIsFound) {
    EXPECT_EQ(in_main("float a; float b = a;"), "a:3");
    EXPECT_EQ(in_main("vec3 v; v += 1.0;"), "v:3");
    EXPECT_EQ(in_main("float a[2], b;\nb = a[0];"), "a:4");
    EXPECT_EQ(in_main("float a; if (u > 0.0) a = 1.0;\nelse u + a;"), "a:4");
    EXPECT_EQ(in_main("float a; { float a = 1.0; u + a; }\nu + a;"), "a:4");
    EXPECT_EQ(in_main("int i;\ni++;"), "i:4");
}

TEST(Unassigned, TheFirstIterationOfALoopIsFound) {
    EXPECT_EQ(in_main("float i;\nfor (; i++ < 9.0;) u + i;"), "i:4");
    EXPECT_EQ(in_main("for (int i;\ni < 3; ++i) u;"), "i:4");
    EXPECT_EQ(in_main("float a;\nfor (int i = 0; i < 3; ++i) { u + a; a = 1.0; }"), "a:4");
}

TEST(Unassigned, WhatMayHaveAValueIsLeftAlone) {
    for (const char* statements :
         {"float a; a = 1.0; u + a;", "float a; if (u > 0.0) a = 1.0; u + a;",
          "float a; for (int i = 0; i < 3; ++i) { if (i > 0) u + a; a = 1.0; }",
          "float a; for (int i = 0; i < 3; a = 1.0, ++i) { if (i == 0) continue; u + a; }",
          "vec2 v; v.x = 1.0; u + v.x;", "float a[2]; a[0] = 1.0; u + a[1];",
          "float a; for (int i = 0; i < 3; ++i) for (int k = 0; k < i; ++k) { if (k > 0) u + a; a = 1.0; }",
          "float w; modf(u, w); u + w;", "float a, b; a = b = 1.0; u + a + b;", "float unread;",
          "for (float i; u > 0.0;) { i = 1.0; u + i; }", "const float c = 1.0; u + c;"})
        EXPECT_EQ(in_main(statements), "") << statements;
}

TEST(Unassigned, ArgumentsThatAFunctionWritesAreWrites) {
    EXPECT_EQ(found("void give(out float x) { x = 1.0; }\nvoid main() { float a; give(a); a + 1.0; }\n"), "");
    EXPECT_EQ(found("float twice(in float x) { return 2.0 * x; }\nvoid main() { float a;\ntwice(a); }\n"),
              "a:3");
}

TEST(Unassigned, ParametersThatGoOut) {
    EXPECT_EQ(found("void f(out vec4 c) { c += 1.0; }\nvoid main() { vec4 v; f(v); }\n"), "c:1");
    EXPECT_EQ(found("void f(out vec4 c) { }\nvoid main() { vec4 v; f(v); }\n"), "c:-");
    EXPECT_EQ(found("void f(inout vec4 c) { c += 1.0; }\nvoid main() { vec4 v = vec4(0); f(v); }\n"), "");
    EXPECT_EQ(found("void f(out vec4 c) { c.x = 1.0; }\nvoid main() { vec4 v; f(v); }\n"), "");
}

TEST(Unassigned, GlobalsThatNothingWrites) {
    EXPECT_EQ(found("float g;\nvoid main() { g + 1.0; }\n"), "g:2");
    EXPECT_EQ(found("float g;\nvoid set() { g = 1.0; }\nvoid main() { g + 1.0; set(); }\n"), "");
    EXPECT_EQ(found("uniform float g;\nin vec2 h;\nvoid main() { g + h.x; }\n"), "");
}

TEST(Unassigned, WhatMainNeverComesToIsLeftAlone) {
    EXPECT_EQ(found("float dead() { float a; return a; }\nvoid main() { }\n"), "");
}

} // namespace
} // namespace tidemark::glsl
