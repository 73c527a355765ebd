// The text after specialising, level by level, and the parts that must stay.
#include "glsl_support.hpp"
#include "scene/knob.hpp"
#include "shader/specialise.hpp"
#include "shader/uniform_expressions.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace tidemark::glsl::specialise_test {

scene::Knob knob(std::string name, scene::KnobType type, scene::KnobValue value) {
    scene::Knob knob;
    knob.name = std::move(name);
    knob.type = type;
    knob.value = value;
    return knob;
}

const std::vector<scene::Knob> k_knobs = {knob("foam", scene::KnobType::float1, {0.5}),
                                          knob("count", scene::KnobType::int1, {3}),
                                          knob("wind", scene::KnobType::vec2, {1, -2})};

constexpr std::string_view k_head =
    "uniform float foam; uniform int count; uniform vec2 wind; uniform float iTime;\n";

Specialised specialised(std::string_view text, Specialise how, std::string_view version = "330 core") {
    text::MappedText source;
    source.append_generated(fmt::format("#version {}\n{}", version, k_head));
    source.append(text, "a.glsl", 1);
    return specialise(source, k_knobs, how);
}

/// The author's part of the result; runs of blanks come down to one, and none stand at an end.
std::string left_of(std::string_view text, Specialise how, std::string_view version = "330 core") {
    const std::string whole = specialised(text, how, version).source.text();
    std::string left;
    for (const char c : whole.substr(whole.find("iTime;") + 6)) {
        const bool blank = c == ' ' || c == '\n';
        if (!blank || (!left.empty() && left.back() != ' '))
            left += blank ? ' ' : c;
    }
    if (left.ends_with(' '))
        left.pop_back();
    return left;
}

std::string reached(std::string_view text) {
    return left_of(text, Specialise::unreachable);
}
std::string settled(std::string_view text) {
    return left_of(text, Specialise::invariant_uniforms);
}
int hoisted(std::string_view text, std::string_view version = "330 core") {
    return specialised(text, Specialise::invariant_uniforms, version).left_out.loop_invariants;
}

TEST(Specialise, removes_unreachable_functions_and_their_dependencies) {
    EXPECT_EQ(
        reached("struct P { float x; }; const float k = 2.0; float g; P make() { g = k; return P(g); }\n"
                "float used() { return 1.0; }\n"
                "float unused() { return make().x + used(); }\n"
                "void main() { used(); }"),
        "float used() { return 1.0; } void main() { used(); }");
}

TEST(Specialise, keeps_every_overload_and_prototype_of_a_name_that_is_reached) {
    constexpr std::string_view k_text = "float f(float x); float f(vec2 x) { return x.x; } "
                                        "void main() { f(1.0); } float f(float x) { return x; }";
    EXPECT_EQ(reached(k_text), k_text);
    EXPECT_EQ(reached("float f(float x); void main() {} float f(float x) { return x; }"), "void main() {}");
}

TEST(Specialise, keeps_code_that_only_seems_unreachable) {
    for (const std::string_view text :
         {"const float a = 1.0; const float b = a; void main() { float c = b; }", // through an initialiser
          "float n; float next() { return n++; } float start = next(); void main() {}", // changes n
          "const int k_n = 2; void main() { float a[k_n]; }",
          "struct S { float x; } s; void main() { s.x = 1.0; }",
          "struct S { float x; } s; void main() { S t; }",
          "layout(location = 0) out vec4 colour; void main() {}",
          "float f() { return 1.0; } void main() { float f = f(); }"}) // shadowed by what it is the value of
        EXPECT_EQ(reached(text), text);
    constexpr std::string_view k_by_macros[][2] = {
        {"#define F f\nfloat F() { return 1.0; } void main() { f(); }", "float F()"},
        {"#define CALL(x) x()\nfloat f() { return 1.0; } void main() { CALL(f); }", "float f()"},
        {"#define JOIN(a, b) a##b\nfloat fg() { return 1.0; } void main() { JOIN(f, g)(); }", "float fg()"}};
    for (const auto& [text, kept] : k_by_macros)
        EXPECT_NE(reached(text).find(kept), std::string::npos) << text;
}

TEST(Specialise, removes_unnamed_arrays_structs_and_globals) {
    EXPECT_EQ(
        reached(
            "const vec2 k_all[2] = vec2[2](vec2(0.0), vec2(1.0)); struct A { float x; }; struct B { A a; };\n"
            "B b; float x = sin(1.0); void main() {}"),
        "void main() {}");
}

TEST(Specialise, takes_no_part_of_a_macro) {
    // Both functions are written by one macro: neither can go alone, and what they need stays.
    const std::string both = reached("#define TWO(n) float n##1() { return k; } float n##2() { return k; }\n"
                                     "const float k = 1.0;\nTWO(f)\nvoid main() { f1(); }");
    EXPECT_NE(both.find("TWO(f)"), std::string::npos);
    EXPECT_NE(both.find("const float k"), std::string::npos);
    // A whole call of a macro can, with its brackets.
    EXPECT_EQ(reached("#define ONE(n) float n() { return 1.0; }\nONE(f)\nvoid main() {}"),
              "#define ONE(n) float n() { return 1.0; } void main() {}");
    // The value of ID(…) is its argument, and its parenthesis belongs to the call.
    EXPECT_EQ(hoisted("#define ID(x) x\nvoid main() { for (int i = 0; i < 9; ++i) { ID(sin(iTime)); } }"), 0);
}

TEST(Specialise, keeps_directives_and_lines) {
    constexpr std::string_view k_text =
        "float unused()\n{\n#define A 1\n    return 1.0;\n#if A\n#endif\n}\nvoid main()\n{\n  broken;\n}\n";
    const Specialised result = specialised(k_text, Specialise::unreachable);
    EXPECT_EQ(result.left_out.lines, 4);
    EXPECT_EQ(count(result.source.text(), "#define A 1\n"), 1);
    const int line = line_of(result.source, "broken");
    EXPECT_EQ(result.source.lines().locate(line, 3), (SourceLocation{"a.glsl", 10, 3}));
}

TEST(Specialise, keeps_texts_that_cannot_be_parsed) {
    for (const std::string_view text : {"void main() { float x = ; }", "float f( { void main() {}",
                                        "#ifdef GL_ARB_gpu_shader5\nfloat f;\n#endif\nvoid main() {}"}) {
        const Specialised result = specialised(text, Specialise::invariant_uniforms);
        EXPECT_FALSE(result.left_out.anything());
        EXPECT_NE(result.left_out.kept_whole.find("a.glsl:"), std::string::npos)
            << result.left_out.kept_whole;
        EXPECT_NE(result.source.text().find(text), std::string::npos);
    }
    EXPECT_EQ(specialised("void main() {}", Specialise::invariant_uniforms).left_out.kept_whole,
              "there is nothing to leave out");
    EXPECT_FALSE(specialised("float f; void main() {}", Specialise::nothing).left_out.anything());
}

TEST(Specialise, hoists_loop_invariant_expressions) {
    EXPECT_EQ(
        settled("void main() { for (int i = 0; i < 9; ++i) { float x = sin(iTime * 2.0) * float(i); } }"),
        "float tidemark_hoisted0 = sin(iTime * 2.0); "
        "void main() { for (int i = 0; i < 9; ++i) { float x = tidemark_hoisted0 * float(i); } }");
    // In a function that a loop calls, through local variables, and by functions that only compute.
    EXPECT_EQ(settled("mat2 turn(float a) { float s = sin(a), c = cos(a); return mat2(c, -s, s, c); }\n"
                      "float map(vec2 p) { float angle = 0.3 * iTime; p *= turn(angle); return p.x; }\n"
                      "void main() { int i = 0; while (i++ < 9) map(vec2(i)); }"),
              "mat2 turn(float a) { float s = sin(a), c = cos(a); return mat2(c, -s, s, c); } "
              "mat2 tidemark_hoisted0 = turn((0.3 * iTime)); "
              "float map(vec2 p) { float angle = 0.3 * iTime; p *= tidemark_hoisted0 ; return p.x; } "
              "void main() { int i = 0; while (i++ < 9) map(vec2(i)); }");
}

TEST(Specialise, keeps_double_signs_and_integer_types) {
    EXPECT_EQ(
        settled("void main() { for (int i = 0; i < 9; ++i) { float a = 2; float x = sin(- -iTime / a); } }"),
        "float tidemark_hoisted0 = sin(- -iTime / float(2)); "
        "void main() { for (int i = 0; i < 9; ++i) { float a = 2; float x = tidemark_hoisted0 ; } }");
}

TEST(Specialise, hoists_nothing_that_may_change_within_a_frame) {
    const auto in_loop = [](std::string_view body, std::string_view before = "") {
        return hoisted(fmt::format("{}void main() {{ float a = 0.0; for (int i = 0; i < 9; ++i) {{ {} }} }}",
                                   before, body));
    };
    EXPECT_EQ(in_loop("float x = cos(iTime);"), 1);
    EXPECT_EQ(in_loop("float x = cos(iTime + float(i));"), 0);
    EXPECT_EQ(in_loop("a += 1.0; float x = cos(a);"), 0);
    EXPECT_EQ(in_loop("float x = cos(gl_FragCoord.x);"), 0);
    EXPECT_EQ(in_loop("float x = cos(1.0);"), 0);    // a constant: the driver's affair
    EXPECT_EQ(in_loop("float x = iTime * 2.0;"), 0); // not worth it
    EXPECT_EQ(in_loop("float x = dFdx(sin(gl_FragCoord.x) * iTime);"), 0);
    EXPECT_EQ(in_loop("float t = iTime; t += 1.0; float x = cos(t);"), 0);
    EXPECT_EQ(in_loop("float t = iTime; modf(a, t); float x = cos(t);"), 0);
    EXPECT_EQ(
        in_loop("float t = iTime; change(t); float x = cos(t);", "void change(inout float x) { x = 1.0; }\n"),
        0);
    EXPECT_EQ(in_loop("float x = f(iTime);", "float g; float f(float x) { return sin(x) + g; }\n"), 0);
    EXPECT_EQ(in_loop("float x = f(iTime);", "float f(float x) { return sin(x) + f(x); }\n"), 0);
    EXPECT_EQ(in_loop("float x = f(iTime);", "float f(float x) { if (x > 1.0) discard; return sin(x); }\n"),
              0);
    constexpr std::string_view k_shadowing =
        "float g; float f(float x) { float y = g; { float g = 2.0; y += g; } return sin(x * y); }\n";
    EXPECT_EQ(in_loop("g = float(i); float x = f(iTime);", k_shadowing), 0);
    // Might not end, and might not be called.
    constexpr std::string_view k_looping =
        "float f(float k) { float y; for (float i = 0.0; i < 1.0; i += k) y = cos(k); return y; }\n";
    EXPECT_EQ(in_loop("if (iTime > 0.0) a += f(iTime);", k_looping), 0);
    EXPECT_EQ(in_loop("float iTime = a; float x = cos(iTime);"), 0); // shadowed
    EXPECT_EQ(in_loop("float x = cos(iTime);", "#define iTime (a + 1.0)\n"), 0);
    EXPECT_EQ(hoisted("void main() { float x = cos(iTime); }"), 0); // no loop
    EXPECT_EQ(hoisted("void main() { for (float t = cos(iTime); t < 1.0; t += 1.0) ; }"), 0);
    EXPECT_EQ(hoisted("void main() { for (int i = 0; i < 9; ++i) { cos(iTime); } }", "300 es"), 0);
}

TEST(Specialise, writes_knobs_as_constants_on_request) {
    const std::string text =
        specialised("void main() { float x = foam; }", Specialise::constants).source.text();
    EXPECT_NE(text.find("const float foam = float(0.500000000);"), std::string::npos) << text;
    EXPECT_NE(text.find("const int count = int(int(3));"), std::string::npos) << text;
    EXPECT_NE(text.find("const vec2 wind = vec2(1.00000000, -2.00000000);"), std::string::npos) << text;
}

TEST(Specialise, follows_chains_of_any_length) {
    std::string text = "float f0(float x) { return sin(x); }\n";
    for (int i = 1; i < 3000; ++i)
        text += fmt::format("float f{}(float x) {{ float a{} = {}; return f{}(x); }}\n", i, i,
                            i > 1 ? "iTime" : "1.0", i - 1);
    text += "void main() { float b0 = iTime;\n";
    for (int i = 1; i < 3000; ++i)
        text += fmt::format("float b{} = b{} + 1.0;\n", i, i - 1);
    text += "for (int i = 0; i < 9; ++i) f2999(sin(b2999)); }";
    const Specialised result = specialised(text, Specialise::invariant_uniforms);
    EXPECT_EQ(result.left_out.lines, 0);
    EXPECT_EQ(count(result.source.text(), "f2999("), 2);
}

/// Returns the text of `assign_globals_in_main` with runs of blanks as one blank.
std::string with_globals_in_main(const std::string& text) {
    const std::string written = assign_globals_in_main(*parsed("#version 450\n" + text));
    std::string squeezed;
    for (const char c : written)
        if (c != ' ' || (!squeezed.empty() && squeezed.back() != ' ' && squeezed.back() != '\n'))
            squeezed += c;
    return squeezed;
}

TEST(GlobalValues, are_assigned_at_the_start_of_main_with_their_lines) {
    EXPECT_EQ(with_globals_in_main("float a = 2.0,\n b = a;\nvoid main() {\n a += b; }"),
              "#version 450\nfloat a , \nb ; \nvoid main ( ) { "
              "\n#line 2\na = 2.0 ;\n#line 3\nb = a ;\n#line 4\n\na += b ; } ");
}

TEST(GlobalValues, in_macros_are_found) {
    EXPECT_EQ(with_globals_in_main("#define SET(x) float x = 3.0;\nSET(a)\nvoid main() {}"),
              "#version 450\n\nfloat a ; \nvoid main ( ) { \n#line 3\na = 3.0 ;\n#line 4\n} ");
}

TEST(GlobalValues, of_unsized_arrays_set_the_size) {
    EXPECT_EQ(with_globals_in_main("float a[] = float[](1.0, 2.0);\nvoid main() {}"),
              "#version 450\nfloat a [ (float [ ] ( 1.0 , 2.0 ) ).length()] ; \nvoid main ( ) { "
              "\n#line 2\na = float [ ] ( 1.0 , 2.0 ) ;\n#line 3\n} ");
    EXPECT_EQ(with_globals_in_main("float a[] = {1.0, 2.0};\nvoid main() {}"),
              "#version 450\nfloat a [ 2] ; \nvoid main ( ) { "
              "\n#line 2\n{ float tidemark_value [ ] = { 1.0 , 2.0 } ; a = tidemark_value; }\n#line 3\n} ");
}

TEST(GlobalValues, constants_and_uniforms_stay) {
    const std::string text = "const float a = 2.0;\nuniform float u = 1.0;\nfloat b;\nvoid main() {}\n";
    EXPECT_EQ(assign_globals_in_main(*parsed("#version 450\n" + text)), "#version 450\n" + text);
}

} // namespace tidemark::glsl::specialise_test
