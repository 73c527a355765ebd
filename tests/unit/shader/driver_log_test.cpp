// Driver logs in the forms of Mesa, NVIDIA, and Intel, AMD and ANGLE.
#include "shader/driver_log.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace tidemark::glsl::driver_log_test {

std::string lines_of(const std::vector<DriverMessage>& messages) {
    std::string list;
    for (const DriverMessage& message : messages)
        list += to_string(message.diagnostic) + (message.follows ? " (follows)\n" : "\n");
    return list;
}

std::string repeated(std::string_view line, int times) {
    std::string text;
    for (int i = 0; i < times; ++i)
        text += line;
    return text;
}

/// What is made of a log about a text of ten lines of prologue, then three of lib.glsl, then a.glsl. Each
/// line is eight words in the columns 1, 3, 5, ….
std::string read(std::string_view log) {
    text::MappedText source;
    source.append_generated(repeated("- - - - - - - -\n", 10));
    source.append(repeated("+ + + + + + + +\n", 3), "lib.glsl", 5);
    source.append(repeated("* * * * * * * *\n", 9), "a.glsl", 1);
    return lines_of(parse_driver_log(log, source));
}

/// Of a log about `text`, which begins in line 1 of a.glsl, for people.
std::string told(std::string_view text, std::string_view log) {
    text::MappedText source;
    source.append(text, "a.glsl", 1);
    std::string list;
    for (const Diagnostic& diagnostic : for_people(parse_driver_log(log, source)))
        list += to_string(diagnostic) + "\n";
    return list;
}

/// LINE:COLUMN of what Mesa says of `line` and `column` of `text`, where `word` is undeclared.
std::string place(std::string_view text, int line, int column, std::string_view word) {
    text::MappedText source;
    source.append(text, "t", 1);
    const auto messages =
        parse_driver_log(fmt::format("0:{}({}): error: `{}' undeclared", line, column, word), source);
    const SourceLocation where = messages.at(0).diagnostic.where;
    return fmt::format("{}:{}", where.line, where.column);
}

TEST(DriverLog, mesa) {
    EXPECT_EQ(read("0:14(5): error: `x' undeclared\n"
                   "0:12(1): warning: `y' used uninitialized\n"
                   "0:20(12): error: type mismatch\n"),
              "a.glsl:1: error: `x' undeclared\n"
              "lib.glsl:6:1: warning: `y' used uninitialized (follows)\n"
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

TEST(DriverLog, three_of_mesas_candidates_are_kept) {
    EXPECT_EQ(read("0:14(5): error: no matching function for call to `f(int)'; candidates are:\n"
                   "0:14(5): error:    float f(float)\n"
                   "0:14(5): error:    vec2 f(vec2)\n"
                   "0:14(5): error:    vec3 f(vec3)\n"
                   "0:14(5): error:    vec4 f(vec4)\n"
                   "0:15(5): error: type mismatch\n"
                   "0:16(5): error:    float f(float)\n"),
              "a.glsl:1:5: error: no matching function for call to `f(int)'; candidates are:\n"
              "a.glsl:1:5: note: float f(float)\n"
              "a.glsl:1:5: note: vec2 f(vec2)\n"
              "a.glsl:1:5: note: vec3 f(vec3)\n"
              "a.glsl:2:5: error: type mismatch\n"
              "a.glsl:3:5: error:    float f(float)\n");
}

TEST(DriverLog, mesas_token_names_become_words) {
    EXPECT_EQ(read("0:14(5): error: syntax error, unexpected BASIC_TYPE_TOK, expecting '(' or IDENTIFIER\n"
                   "0:15(5): error: syntax error, unexpected $end\n"
                   "0:16(5): error: `IDENTIFIERS' undeclared\n"),
              "a.glsl:1:5: error: syntax error, unexpected a type, expecting '(' or a name\n"
              "a.glsl:2:5: error: syntax error, unexpected the end of the text\n"
              "a.glsl:3: error: `IDENTIFIERS' undeclared\n");
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
              "error: 2 compilation errors. No code generated. (follows)\n");
}

TEST(DriverLog, notes) {
    EXPECT_EQ(read("0:14(5): note: here\nNOTE: 0:14: here\n"), "a.glsl:1:5: note: here\n"
                                                               "a.glsl:1: note: here\n");
}

TEST(DriverLog, generated_lines_have_no_place) {
    EXPECT_EQ(read("0:3(5): error: `main' redefined\n0(10) : error C1: x\nERROR: 0:0: y\n"),
              "error: `main' redefined\n"
              "error: C1: x\n"
              "error: y\n");
}

// The numbers of these tests are Mesa's own, of version 22.3.6; driver_places_gl_test asks the driver at
// hand.

TEST(DriverLogColumns, a_run_of_blanks_and_comments_is_one_blank) {
    EXPECT_EQ(place("    float a = bad;\n", 1, 12, "bad"), "1:15");
    EXPECT_EQ(place("\tfloat a = bad;\n", 1, 12, "bad"), "1:12");
    EXPECT_EQ(place("    float    q   =   1.0 +    bad;\n", 1, 18, "bad"), "1:31");
    EXPECT_EQ(place("    float r = /* comment */ bad;\n", 1, 12, "bad"), "1:29");
    EXPECT_EQ(place("    float s = /* k\xC3\xB6mm\xC3\xA4nt */ bad;\n", 1, 12, "bad"), "1:31") << "bytes";
    EXPECT_EQ(place("float a=bad;\n", 1, 9, "bad"), "1:9");
}

TEST(DriverLogColumns, lines_that_the_preprocessor_joins) {
    EXPECT_EQ(place("    float x = 1.0 \\\n       + bad;\n", 1, 18, "bad"), "2:10");
    EXPECT_EQ(place("    float y = /* multi\n      line */ bad;\n", 1, 12, "bad"), "2:15");
    EXPECT_EQ(place(" /* x\n */ float g = bad; float h = bad2;\n", 1, 27, "bad2"), "2:30");
}

TEST(DriverLogColumns, after_a_macro_a_word_is_found_by_name_only) {
    const std::string macros = "#define FOO(x) ((x) + 1.0)\n#define BAR 3.0\n";
    EXPECT_EQ(place(macros + "    float t = FOO(2.0) + bad;\n", 3, 28, "bad"), "3:26");
    EXPECT_EQ(place(macros + "    float w = BAR + bad;\n", 3, 18, "bad"), "3:21");
    EXPECT_EQ(place(macros + "    float w = bad + BAR + bad;\n", 3, 12, "bad"), "3:15");
    EXPECT_EQ(place(macros + "    float w = BAR + bad * bad;\n", 3, 18, "bad"), "3:0");
    EXPECT_EQ(place(macros + "#undef BAR\n    float w = BAR + bad * bad;\n", 4, 18, "bad"), "4:21");
    EXPECT_EQ(place("#define WORSE bad\n    float w = WORSE;\n", 2, 12, "bad"), "2:0");
    const std::string_view mismatch = "0:2(12): error: type mismatch\n";
    EXPECT_EQ(told("#define BAR 3.0\n    float w = BAR + 1;\n", mismatch),
              "a.glsl:2:15: error: type mismatch\n");
    EXPECT_EQ(told("#define NO\n    float w = NO 1 + 1;\n", mismatch), "a.glsl:2: error: type mismatch\n");
}

TEST(DriverLogColumns, macro_arguments_over_several_lines_count_as_one_line) {
    const std::string macros = "#define FOO(x) ((x) + 1.0)\n";
    const std::string text =
        macros + "float a = FOO(\n   1.0) + bad;\nfloat b =\n  bad2;\nfloat c = FOO(FOO(\n  1.0)\n"
                 ") + bad3;\nfloat d = bad4;\n";
    EXPECT_EQ(place(text, 2, 28, "bad"), "3:11");
    EXPECT_EQ(place(text, 4, 2, "bad2"), "5:3");
    EXPECT_EQ(place(text, 5, 38, "bad3"), "8:5");
    EXPECT_EQ(place(text, 6, 11, "bad4"), "9:11");
    EXPECT_EQ(place(macros + "float e = FOO(/* x\n  y */ 1.0);\nfloat f = bad;\n", 4, 11, "bad"), "4:11")
        << "a comment's lines count";
    EXPECT_EQ(place("#define CALL(x, y) x + y\nfloat a /* two\n lines */ = CALL(1. ,\n  2.) \\\n + 1.;\n"
                    "float b = CALL(1. \\\n ,\n 2.);\nfloat c = bad;\n",
                    5, 11, "bad"),
              "9:11")
        << "with the line ends that were put off until then";
    EXPECT_EQ(place("#ifdef GL_ES\n#define FOO(x) x\n#endif\nfloat e = FOO(\n  1.0);\nfloat f = bad;\n", 6,
                    11, "bad"),
              "6:0")
        << "perhaps a macro, perhaps not";
}

TEST(DriverLogColumns, preprocessor_columns_are_those_of_the_text) {
    EXPECT_EQ(told("  #error no\n", "0:1(3): preprocessor error: #error no\n"),
              "a.glsl:1:3: error: #error no\n");
    EXPECT_EQ(told("#if 1\n", "0:1(6): preprocessor error: Unterminated #if\n"),
              "a.glsl:1: error: Unterminated #if\n");
}

TEST(DriverLogColumns, edits_before_an_error_on_its_line_keep_its_column) {
    text::MappedText source;
    source.append("  float value = old + bad;\n", "a.glsl", 1);
    source.apply({{8, 13, "v"}, {16, 19, "fresh(a, b)"}});
    const auto column = [&](int at, std::string_view word) {
        return parse_driver_log(fmt::format("0:1({}): error: `{}' undeclared", at, word), source)
            .at(0)
            .diagnostic.where.column;
    };
    EXPECT_EQ(column(26, "bad"), 23);
    EXPECT_EQ(column(8, "v"), 9);
    EXPECT_EQ(column(12, "fresh"), 17);
    EXPECT_EQ(column(21, "b"), 17) << "written where what it replaces was";
}

TEST(DriverLogFolding, consequences_of_a_wrong_swizzle_are_folded) {
    EXPECT_EQ(told("float d = 1.0 + length(uv.xw) + x;\n",
                   "0:1(24): error: invalid swizzle / mask `xw'\n"
                   "0:1(24): error: type mismatch\n"
                   "0:1(17): error: no matching function for call to `length(error)'; candidates are:\n"
                   "0:1(17): error:    float length(float)\n"
                   "0:1(17): error:    float length(vec2)\n"
                   "0:1(11): error: operands to arithmetic operators must be numeric\n"
                   "0:1(33): error: `x' undeclared\n"
                   "0:1(11): error: operands to arithmetic operators must be numeric\n"
                   "0:2(1): warning: `d' used uninitialized\n"),
              "a.glsl:1:24: error: invalid swizzle / mask `xw'\n"
              "a.glsl:1:24: note: … and 3 more that follow from it\n"
              "a.glsl:1:33: error: `x' undeclared\n"
              "a.glsl:1:33: note: … and 2 more that follow from it\n");
}

TEST(DriverLogFolding, errors_of_a_failed_return_value_are_folded) {
    EXPECT_EQ(told("float f() { return g(); }\n",
                   "0:1(20): error: no function with name 'g'\n"
                   "0:1(13): error: could not implicitly convert return value to float, in function `f'\n"),
              "a.glsl:1:20: error: no function with name 'g'\n"
              "a.glsl:1:20: note: … and 1 more that follows from it\n");
    EXPECT_EQ(told("float f() { return vec2(1); }\n",
                   "0:1(13): error: could not implicitly convert return value to float, in function `f'\n"),
              "a.glsl:1:13: error: could not implicitly convert return value to float, in function `f'\n");
}

TEST(DriverLogFolding, an_unknown_name_is_reported_once) {
    EXPECT_EQ(told("x;\nx;\ny;\n", "0:1(1): error: `x' undeclared\n"
                                   "0:2(1): error: `x' undeclared\n"
                                   "0:3(1): error: `y' undeclared\n"),
              "a.glsl:1:1: error: `x' undeclared\n"
              "a.glsl:1:1: note: … and 1 more that follows from it\n"
              "a.glsl:3:1: error: `y' undeclared\n");
    EXPECT_EQ(told("x\n", "0(1) : error C1503: undefined variable \"x\"\n"
                          "0(1) : error C7011: implicit cast from \"float\" to \"int\"\n"
                          "0(2) : error C1503: undefined variable \"x\"\n"
                          "0(3) : error C1035: assignment of incompatible types\n"
                          "0(3) : error C1035: assignment of incompatible types\n"),
              "a.glsl:1: error: C1503: undefined variable \"x\"\n"
              "a.glsl:1: note: … and 2 more that follow from it\n"
              "a.glsl:3: error: C1035: assignment of incompatible types\n"
              "a.glsl:3: error: C1035: assignment of incompatible types\n");
    EXPECT_EQ(told("x\n", "ERROR: 0:1: 'x' : undeclared identifier\n"
                          "ERROR: 0:1: '=' : dimension mismatch\n"
                          "ERROR: 0:1: 'assign' : cannot convert from 'highp float' to 'highp 3-component "
                          "vector of float'\n"
                          "ERROR: 0:1: 'y' : undeclared identifier\n"
                          "ERROR: 4 compilation errors. No code generated.\n"),
              "a.glsl:1: error: 'x' : undeclared identifier\n"
              "a.glsl:1: note: … and 2 more that follow from it\n"
              "a.glsl:1: error: 'y' : undeclared identifier\n"
              "a.glsl:1: note: … and 1 more that follows from it\n");
}

TEST(DriverLogFolding, independent_errors_stay) {
    EXPECT_EQ(told("int a = 1.0; int b = 2.0;\nvec3 g() { bad; }\n",
                   "0:1(1): error: initializer of type float cannot be assigned to variable of type int\n"
                   "0:1(14): error: initializer of type float cannot be assigned to variable of type int\n"
                   "0:2(12): error: `bad' undeclared\n"
                   "0:2(1): error: function `g' has non-void return type vec3, but no return statement\n"),
              "a.glsl:1:1: error: initializer of type float cannot be assigned to variable of type int\n"
              "a.glsl:1:14: error: initializer of type float cannot be assigned to variable of type int\n"
              "a.glsl:2:12: error: `bad' undeclared\n"
              "a.glsl:2:1: error: function `g' has non-void return type vec3, but no return statement\n");
}

TEST(DriverLogFolding, errors_come_before_warnings_and_keep_their_notes) {
    EXPECT_EQ(told("a;\nb;\nc;\n", "0:1(1): warning: odd\n"
                                   "0:1(1): note: here\n"
                                   "0:2(1): error: wrong\n"
                                   "0:3(1): note: because of this\n"),
              "a.glsl:2:1: error: wrong\n"
              "a.glsl:3:1: note: because of this\n"
              "a.glsl:1:1: warning: odd\n"
              "a.glsl:1:1: note: here\n");
}

TEST(DriverLog, other_lines_are_kept) {
    EXPECT_EQ(read("Something went wrong"), "error: Something went wrong\n");
    EXPECT_EQ(read("0:14: x"), "error: 0:14: x\n");
    EXPECT_EQ(read("0:99999999999(5): error: x"), "error: 0:99999999999(5): error: x\n");
    EXPECT_EQ(read("0:-14(5): error: x"), "error: 0:-14(5): error: x\n");
}

TEST(DriverLog, empty_lines_and_line_ends_are_dropped) {
    EXPECT_EQ(read(""), "");
    EXPECT_EQ(read("\n\r\n  \n"), "");
    EXPECT_EQ(read(std::string_view("0:14(5): error: x \r\n\0", 21)), "a.glsl:1:5: error: x\n");
    EXPECT_EQ(read("0:14(5): error: x"), "a.glsl:1:5: error: x\n");
}

TEST(DriverLog, names_are_the_authors) {
    EXPECT_EQ(read("0:14(1): error: no matching function for call to `st_input(vec2)'; candidates are:\n"
                   "0:14(1): error:    float st_input(float)\n"),
              "a.glsl:1:1: error: no matching function for call to `input(vec2)'; candidates are:\n"
              "a.glsl:1:1: note: float input(float)\n");
    EXPECT_EQ(read("0:14(1): error: `tidemark_color' undeclared\n"),
              "a.glsl:1: error: `gl_FragColor' undeclared\n");
    EXPECT_EQ(read("0:14(1): error: no function with name 'tidemark_double_wave'\n"),
              "a.glsl:1: error: no function with name 'wave'\n");
    EXPECT_EQ(read("0:14(1): error: `st_tile' undeclared\n"), "a.glsl:1: error: `st_tile' undeclared\n")
        << "an author's own name";
}

} // namespace tidemark::glsl::driver_log_test
