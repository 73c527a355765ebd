// Driver logs in the forms of Mesa, NVIDIA, and Intel, AMD and ANGLE.
#include "glsl/driver_log.hpp"

#include <gtest/gtest.h>

namespace tidemark::glsl {
namespace {

/// The diagnostics of a log about a text of ten lines of prologue, then three of lib.glsl, then a.glsl.
std::string read(std::string_view log) {
    text::LineMap lines;
    lines.begin_run(1, "", 0);
    lines.begin_run(11, "lib.glsl", 5);
    lines.begin_run(14, "a.glsl", 1);
    std::string list;
    for (const Diagnostic& diagnostic : parse_driver_log(log, lines))
        list += to_string(diagnostic) + "\n";
    return list;
}

TEST(DriverLog, mesa) {
    EXPECT_EQ(read("0:14(5): error: `x' undeclared\n"
                   "0:12(1): warning: `y' used uninitialized\n"
                   "0:20(12): error: type mismatch\n"),
              "a.glsl:1: error: `x' undeclared\n"
              "lib.glsl:6: warning: `y' used uninitialized\n"
              "a.glsl:7: error: type mismatch\n");
}

TEST(DriverLog, mesa_preprocessor) {
    EXPECT_EQ(read("0:14(2): preprocessor error: Unterminated #if\n"
                   "0:15(2): preprocessor warning: odd\n"),
              "a.glsl:1: error: Unterminated #if\n"
              "a.glsl:2: warning: odd\n");
}

TEST(DriverLog, mesa_link) {
    EXPECT_EQ(read("error: unresolved reference to function `mainImage'\n"
                   "warning: `color' is never written\n"),
              "error: unresolved reference to function `mainImage'\n"
              "warning: `color' is never written\n");
}

TEST(DriverLog, of_mesas_candidates_three_are_kept) {
    EXPECT_EQ(read("0:14(5): error: no matching function for call to `f(int)'; candidates are:\n"
                   "0:14(5): error:    float f(float)\n"
                   "0:14(5): error:    vec2 f(vec2)\n"
                   "0:14(5): error:    vec3 f(vec3)\n"
                   "0:14(5): error:    vec4 f(vec4)\n"
                   "0:15(5): error: type mismatch\n"
                   "0:16(5): error:    float f(float)\n"),
              "a.glsl:1: error: no matching function for call to `f(int)'; candidates are:\n"
              "a.glsl:1: note: float f(float)\n"
              "a.glsl:1: note: vec2 f(vec2)\n"
              "a.glsl:1: note: vec3 f(vec3)\n"
              "a.glsl:2: error: type mismatch\n"
              "a.glsl:3: error:    float f(float)\n");
}

TEST(DriverLog, mesas_tokens_in_words) {
    EXPECT_EQ(read("0:14(5): error: syntax error, unexpected BASIC_TYPE_TOK, expecting '(' or IDENTIFIER\n"
                   "0:14(5): error: syntax error, unexpected $end\n"
                   "0:14(5): error: `IDENTIFIERS' undeclared\n"),
              "a.glsl:1: error: syntax error, unexpected a type, expecting '(' or a name\n"
              "a.glsl:1: error: syntax error, unexpected the end of the text\n"
              "a.glsl:1: error: `IDENTIFIERS' undeclared\n");
}

TEST(DriverLog, nvidia) {
    EXPECT_EQ(read("0(14) : error C1503: undefined variable \"x\"\n"
                   "0(11) : warning C7050: \"y\" might be used before being initialized\n"
                   "0(16): error C0000: syntax error\n"),
              "a.glsl:1: error: C1503: undefined variable \"x\"\n"
              "lib.glsl:5: warning: C7050: \"y\" might be used before being initialized\n"
              "a.glsl:3: error: C0000: syntax error\n");
}

TEST(DriverLog, nvidia_link) {
    EXPECT_EQ(read("Fragment info\n"
                   "-------------\n"
                   "(0) : error C3001: no program defined\n"),
              "error: Fragment info\n"
              "error: -------------\n"
              "error: (0) : error C3001: no program defined\n");
}

TEST(DriverLog, intel_amd_and_angle) {
    EXPECT_EQ(read("ERROR: 0:14: 'x' : undeclared identifier\n"
                   "WARNING: 0:11: 'y' : no\n"
                   "ERROR: 0:15: error(#143) Undeclared identifier: z\n"
                   "ERROR: 2 compilation errors. No code generated.\n"),
              "a.glsl:1: error: 'x' : undeclared identifier\n"
              "lib.glsl:5: warning: 'y' : no\n"
              "a.glsl:2: error: error(#143) Undeclared identifier: z\n"
              "error: 2 compilation errors. No code generated.\n");
}

TEST(DriverLog, notes) {
    EXPECT_EQ(read("0:14(5): note: here\nNOTE: 0:14: here\n"), "a.glsl:1: note: here\n"
                                                               "a.glsl:1: note: here\n");
}

TEST(DriverLog, lines_of_our_own_making_have_no_place) {
    EXPECT_EQ(read("0:3(5): error: `main' redefined\n0(10) : error C1: x\nERROR: 0:0: y\n"),
              "error: `main' redefined\n"
              "error: C1: x\n"
              "error: y\n");
}

TEST(DriverLog, columns_of_drivers_are_not_trusted) {
    text::LineMap lines;
    lines.begin_run(1, "a.glsl", 1);
    EXPECT_EQ(parse_driver_log("0:2(5): error: x", lines).at(0).where, (SourceLocation{"a.glsl", 2, 0}));
}

TEST(DriverLog, other_lines_are_passed_on) {
    EXPECT_EQ(read("Something went wrong"), "error: Something went wrong\n");
    EXPECT_EQ(read("0:14: x"), "error: 0:14: x\n");
    EXPECT_EQ(read("0:99999999999(5): error: x"), "error: 0:99999999999(5): error: x\n");
    EXPECT_EQ(read("0:-14(5): error: x"), "error: 0:-14(5): error: x\n");
}

TEST(DriverLog, empty_lines_and_what_ends_a_line_are_dropped) {
    EXPECT_EQ(read(""), "");
    EXPECT_EQ(read("\n\r\n  \n"), "");
    EXPECT_EQ(read(std::string_view("0:14(5): error: x \r\n\0", 21)), "a.glsl:1: error: x\n");
    EXPECT_EQ(read("0:14(5): error: x"), "a.glsl:1: error: x\n");
}

} // namespace
} // namespace tidemark::glsl
