// The work of a text: weights of operations by kind and size, and the blocks that a device runs as a whole.
#include "glsl_support.hpp"
#include "shader/lens_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>

namespace tidemark::glsl::lens_work_test {

WorkText counted(const std::string& text, const WorkWeights& weights = {},
                 WorkAnswer answer = WorkAnswer::sites) {
    const auto read = parsed(text);
    return *count_operations(*read, find_facts(*read), answer, weights);
}

double sum_of(const WorkText& text) {
    double sum = 0;
    for (const WorkSite& site : text.sites)
        sum += site.work();
    return sum;
}

/// The work of an expression of x (float) and v (vec3).
double work(const std::string& expression, const WorkWeights& weights = {}) {
    return sum_of(
        counted("void mainImage(out vec4 c, in vec2 p) { float x = p.x; vec3 v = p.xyx; c.xyz = vec3(" +
                    expression + "); }",
                weights));
}

/// The work of statements in a function with the parameter p (vec2) that sets c (vec4).
double work_of_statements(const std::string& statements, const std::string& before = "") {
    return sum_of(counted(before + "void mainImage(out vec4 c, in vec2 p) {" + statements + "}"));
}

TEST(Work, counts_each_component) {
    EXPECT_EQ(work("x + x"), 1);
    EXPECT_EQ(work("v * x"), 3);
    EXPECT_EQ(work("v += x"), 3);
    EXPECT_EQ(work("v = vec3(x)"), 0);
    EXPECT_EQ(work("sin(v)"), 48);
    EXPECT_EQ(work("length(v)"), 22);
    EXPECT_EQ(work("mat3(1.0) * v"), 18);
}

TEST(Work, of_a_quotient_is_that_of_its_inverse) {
    EXPECT_EQ(work("x / x"), 4);
    EXPECT_EQ(work("v / v"), 12);
    EXPECT_EQ(work("v / x"), 6);
    EXPECT_EQ(work("v / 3.0"), 3);
}

TEST(Work, of_literals_is_done_by_the_compiler) {
    EXPECT_EQ(work("x + sin(2.0) * 3.0"), 1);
    EXPECT_EQ(work("pow(x, 2.0)"), 1);
    EXPECT_EQ(work("pow(x, 2.5)"), 16);
    EXPECT_EQ(work("mod(x, 2.0)"), 4);
    EXPECT_EQ(work("smoothstep(0.0, 1.0, x)"), 7);
}

TEST(Work, of_constants_is_done_by_the_compiler) {
    EXPECT_EQ(work_of_statements("float a = 2.0; c = vec4(sin(a) * p.x);"), 1);
    EXPECT_EQ(work_of_statements("float a = 2.0; a += p.x; c = vec4(sin(a));"), 17);
    EXPECT_EQ(work_of_statements("c = vec4(sin(fold) * p.x);", "float fold = 2.0;"), 1) << "nothing sets it";
    EXPECT_EQ(work_of_statements("c = vec4(sin(iTime) * p.x);", "uniform float iTime;"), 17);
    const WorkText turned = counted("float turn(float a) { float s = sin(a); return s * s; }\n"
                                    "void mainImage(out vec4 c, in vec2 p) { c = vec4(turn(0.3) + p.x); }");
    for (const WorkSite& site : turned.sites)
        EXPECT_TRUE(site.calls.empty()) << "a constant, too";
}

TEST(Work, that_nothing_reads_is_left_out) {
    EXPECT_EQ(work_of_statements("float a = sin(p.x); c = vec4(p.y + 1.0);"), 1);
    EXPECT_EQ(work_of_statements("float a = sin(p.x); a += cos(p.y); c = vec4(0.0);"), 0);
    EXPECT_EQ(work_of_statements("float a = sin(p.x), b = a + 1.0; c = vec4(b);"), 17);
    EXPECT_EQ(work_of_statements("float a; if (sin(p.x) > 0.0) a = cos(p.y); c = vec4(0.0);"), 0);
    EXPECT_EQ(work_of_statements("if (sin(p.x) > 0.0) c = vec4(1.0);"), 17) << "the condition decides";
    EXPECT_EQ(work_of_statements("if (sin(p.x) > 0.0) return; c = vec4(1.0);"), 17);
    EXPECT_EQ(work_of_statements(
                  "float a; for (int i = 0; i < 9; ++i) { if (a > 1.0) break; a += p.x; } c = vec4(0.0);"),
              0);
    EXPECT_EQ(work_of_statements("for (int i = 0; i < 9; ++i) { if (c.x > 1.0) break; c += p.x; }"), 7);
}

TEST(Work, of_a_call_is_needed_for_its_effects) {
    const std::string global = "float seen; float f(float x) { seen = sin(x); return x; }\n";
    EXPECT_EQ(work_of_statements("f(p.x); c = vec4(seen);", global), 17) << "a call and a sine";
    EXPECT_EQ(work_of_statements("f(p.x); c = vec4(0.0);", global), 0);
    const std::string written = "void f(inout float x) { x = sin(x); }\n";
    EXPECT_EQ(work_of_statements("float a = p.x; f(a); c = vec4(a);", written), 17);
    EXPECT_EQ(work_of_statements("float a = p.x; f(a); c = vec4(0.0);", written), 0);
}

TEST(Work, of_values_that_are_known_by_their_calls) {
    EXPECT_EQ(
        work_of_statements("c = vec4(f(p.x, 2.0));", "float f(float x, float k) { return x * exp(k); }\n"),
        2);
    EXPECT_EQ(work_of_statements("c = vec4(f(p.x, 2.0) + f(p.x, p.y));",
                                 "float f(float x, float k) { return x * exp(k); }\n"),
              20)
        << "two calls, a sum, and a function that is counted once";
    const std::string text = "float slow; float f(float x) { return x * sin(slow); }\n";
    EXPECT_EQ(work_of_statements("slow = cos(iTime); c = vec4(f(p.x));", text), 34);
    WorkWeights measured;
    measured.device = "some device";
    EXPECT_EQ(sum_of(counted(
                  text + "void mainImage(out vec4 c, in vec2 p) { slow = cos(iTime); c = vec4(f(p.x)); }",
                  measured)),
              2)
        << "a uniform has one value for the frame";
}

TEST(Work, that_is_repeated_counts_once) {
    EXPECT_EQ(work_of_statements("c = vec4(sin(p.x), cos(p.x), sin(p.x), cos(p.x));"), 32);
    EXPECT_EQ(work_of_statements("float x = p.x, a = sin(x); c = vec4(a + sin(x));"), 17);
    EXPECT_EQ(work_of_statements("float x = p.x, a = sin(x); x += 1.0; c = vec4(a + sin(x));"), 34);
    EXPECT_EQ(
        work_of_statements("float a = sin(p.x); for (int i = 0; i < 3; ++i) a += sin(p.x); c = vec4(a);"),
        19);
    EXPECT_EQ(
        work_of_statements("float a = p.x; for (int i = 0; i < 3; ++i) a += sin(a); c = vec4(a + sin(a));"),
        36);
    const WorkText calls =
        counted("float f(float x) { return sin(x); }\n"
                "float g(float x) { for (int i = 0; i < 3; ++i) x += sin(x); return x; }\n"
                "void mainImage(out vec4 c, in vec2 p) { c = vec4(f(p.x), f(p.x), g(p.x), g(p.x)); }");
    size_t called = 0;
    for (const WorkSite& site : calls.sites)
        called += site.calls.size();
    EXPECT_EQ(called, 3u) << "loops are not merged";
}

TEST(Work, of_a_sine_includes_the_cosine_where_both_are_computed) {
    WorkWeights weights;
    EXPECT_EQ(work("sin(x) - cos(x)", weights), 33);
    weights.both_sides = true;
    EXPECT_EQ(work("sin(x) - cos(x)", weights), 17);
    EXPECT_EQ(work("sin(x) - cos(2.0 * x)", weights), 34);
}

TEST(Work, follows_the_weights) {
    WorkWeights weights;
    weights.of[size_t(Operation::sine)] = 2.5;
    weights.of[size_t(Operation::root)] = 7;
    EXPECT_EQ(work("cos(x)", weights), 2.5);
    EXPECT_EQ(work("sqrt(v)", weights), 21);
}

TEST(Work, blocks_are_functions_and_loops) {
    const WorkText text = counted(R"(float f(float x) { return sin(x); }
float f(vec2 v) { return cos(v.x); }
void mainImage(out vec4 c, in vec2 p) {
    float x = f(p);
    for (int i = 0; i < 9; ++i) {
        if (x > 1.0)
            x = f(x);
    }
    c = vec4(x);
}
)");
    ASSERT_EQ(text.blocks.size(), 4u);
    EXPECT_EQ(text.blocks[2].function, text.main_image);
    EXPECT_EQ(text.blocks[3].around, 2u);
    EXPECT_TRUE(text.sites[text.blocks[3].site].lines.empty()) << "it counts runs of the body only";
    std::vector<std::pair<size_t, NodeId>> calls;
    for (const WorkSite& site : text.sites)
        for (const NodeId called : site.calls)
            calls.emplace_back(site.block, called);
    std::ranges::sort(calls);
    EXPECT_EQ(calls, (std::vector<std::pair<size_t, NodeId>>{{2, text.blocks[1].function},
                                                             {3, text.blocks[0].function}}))
        << "the overloads are told apart by their arguments";
}

TEST(Work, iterations_weigh_where_the_loop_begins) {
    WorkWeights weights;
    weights.of[size_t(Operation::iteration)] = 10;
    const WorkText text = counted(
        "void mainImage(out vec4 c, in vec2 p) {\n for (int i = 0; i < 9; ++i)\n  c += p.x;\n}\n", weights);
    double second = 0;
    for (const WorkSite& site : text.sites)
        for (const auto& [where, each] : site.lines)
            second += where.line == 2 ? each : 0;
    EXPECT_EQ(second, 12) << "with its condition and its step";
}

/// Does the line twice; nothing if that is not possible.
std::optional<LineTwice> twice(const std::string& text, int line, const WorkWeights& weights = {}) {
    const auto read = parsed(text);
    const TreeFacts facts = find_facts(*read);
    const WorkText work = *count_operations(*read, facts, WorkAnswer::sites, weights);
    auto made = do_line_twice(*read, facts, work, {"a.glsl", line}, weights);
    return made ? std::optional(*std::move(made)) : std::nullopt;
}

/// The author's part of the text, without blanks.
std::string authors_part(const std::string& made) {
    std::string text = made.substr(std::min(made.size(), made.find("tmw0_add(mat4")));
    text.erase(0, std::min(text.size(), text.find('\n')));
    std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
    return text;
}

std::string changed(const std::optional<LineTwice>& made) {
    return made ? authors_part(made->text) : std::string();
}

TEST(Twice, an_expression_is_computed_again_of_shifted_operands) {
    const auto made =
        twice("void mainImage(out vec4 c, in vec2 p) {\nfloat x = sin(p.x);\nc = vec4(x);\n}", 2);
    ASSERT_TRUE(made);
    EXPECT_EQ(changed(made), "voidmainImage(outvec4c,invec2p){floatx=tmw0_add(sin(p.x),tmw0_keep(sin("
                             "tmw0_shift(p.x))));c=vec4(x);}");
    EXPECT_EQ(made->work, 16);
    EXPECT_EQ(made->repeated, 16);
}

TEST(Twice, the_control_has_the_shifted_operands_without_the_operations) {
    const auto made = twice("float f(float a) {\nreturn a * a;\n}\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                            "float x = atan(p.x, p.y) * f(p.x);\nc = vec4(x);\n}",
                            5);
    ASSERT_TRUE(made);
    const std::string control = authors_part(made->control);
    EXPECT_NE(control.find("x=tmw0_add(atan(p.x,p.y)*(tmw0_t0=f(p.x)),tmw0_keep(tmw0_shift(p.x))+"
                           "tmw0_keep(tmw0_shift(p.y)));"),
              std::string::npos)
        << control;
    EXPECT_EQ(made->work, 18);
    EXPECT_EQ(made->repeated, 17) << "the call is made once";
}

TEST(Twice, one_operand_of_a_sum_is_shifted_and_both_of_a_quotient) {
    const std::string before = "void mainImage(out vec4 c, in vec2 p) {\n", after = "\nc = vec4(x);\n}";
    EXPECT_NE(
        changed(twice(before + "float x = p.x + p.y;" + after, 2)).find("keep((tmw0_shift(p.x)+(p.y)))"),
        std::string::npos);
    EXPECT_NE(changed(twice(before + "float x = p.x / p.y;" + after, 2))
                  .find("keep((tmw0_shift(p.x)/tmw0_shift(p.y)))"),
              std::string::npos);
    EXPECT_NE(changed(twice(before + "float x = 1.0; x *= p.x;" + after, 2)).find("x*=tmw0_add(p.x,"),
              std::string::npos)
        << "a compound assignment";
}

TEST(Twice, a_call_is_made_once_and_its_value_is_an_operand) {
    const std::string text = "float f(float a) {\nreturn a * a;\n}\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                             "c = vec4(sin(f(p.x * p.y)));\n}";
    const std::string made = changed(twice(text, 5));
    EXPECT_NE(made.find("sin((tmw0_t0=f(tmw0_add(p.x*p.y,"), std::string::npos) << made;
    EXPECT_NE(made.find("keep(sin(tmw0_shift(tmw0_t0)))"), std::string::npos) << made;
}

TEST(Twice, constants_and_repeated_values_are_not_computed_again) {
    const std::string text = "void mainImage(out vec4 c, in vec2 p) {\nfloat a = sin(p.x);\n"
                             "float b = cos(sin(p.x)) * sin(2.0);\nc = vec4(a + b);\n}";
    const std::string made = changed(twice(text, 3));
    EXPECT_NE(made.find("cos((tmw0_t0=sin(p.x)))"), std::string::npos) << made;
    EXPECT_NE(made.find("keep((cos(tmw0_shift(tmw0_t0))*(sin(2.0))))"), std::string::npos) << made;
}

TEST(Twice, heads_of_loops_and_lone_calls_are_refused) {
    const std::string text = "float f(float a) {\nreturn a * a;\n}\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                             "for (int i = 0; i < 9; ++i)\np.x++;\nfloat a = f(p.x);\nc = vec4(a);\n}";
    EXPECT_TRUE(twice(text, 2));
    EXPECT_FALSE(twice(text, 5));
    EXPECT_FALSE(twice(text, 6));
    EXPECT_FALSE(twice(text, 7));
    EXPECT_FALSE(twice(text, 8)) << "no operation";
}

TEST(Twice, a_counter_of_a_loop_keeps_its_known_values) {
    const std::string text = "void mainImage(out vec4 c, in vec2 p) {\nfor (int i = 0; i < 9; ++i)\n"
                             "c.x += exp(p.x) * float(i);\n}";
    const std::string made = changed(twice(text, 3));
    EXPECT_NE(made.find("shift(p.x)"), std::string::npos) << made;
    EXPECT_EQ(made.find("shift(i)"), std::string::npos) << made;
}

} // namespace tidemark::glsl::lens_work_test
