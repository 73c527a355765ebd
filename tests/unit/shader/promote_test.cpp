// Covers what the cases (tests/cases/glsl/promote_*) do not show: which functions are added, and that no text
// takes more than linear time.
#include "glsl_support.hpp"
#include "shader/double_functions.hpp"
#include "shader/promote.hpp"

#include <gmock/gmock.h>

namespace tidemark::glsl::promote_test {

using testing::HasSubstr;
using testing::Not;

Promoted promoted(const std::string& text, bool hashes_too = false) {
    text::MappedText body;
    body.append(text, "a.glsl", 1);
    auto result = promote(std::move(body), hashes_too);
    EXPECT_TRUE(result) << to_string(result.error());
    return result ? *std::move(result) : Promoted{};
}

TEST(Promote, a_text_without_calls_adds_no_functions) {
    EXPECT_EQ(promoted("float f(float x) { return mod(sqrt(x), 2.0); }").functions, "");
}

TEST(Promote, called_functions_are_added_with_their_dependencies) {
    const std::string functions = promoted("float f(float x) { return tanh(x); }").functions;
    for (const char* needed :
         {"tidemark_scale(", "tidemark_exp_kernel(", "tidemark_exp_scaled(", "tidemark_small_sinh(",
          "double tidemark_tanh(double a0)", "dvec4 tidemark_tanh(dvec4"})
        EXPECT_THAT(functions, HasSubstr(needed));
    EXPECT_THAT(functions, Not(HasSubstr("tidemark_angle")));
    EXPECT_EQ(count(functions, "double tidemark_scale("), 1);
}

TEST(Promote, a_dead_call_adds_no_functions) {
    EXPECT_EQ(promoted("#if 0\nfloat a = sin(1.0);\n#endif\n").functions, "");
}

TEST(Promote, the_authors_overload_replaces_ours) {
    const std::string functions =
        promoted("float sinh(float x) { return x; }\nvec2 pow(vec2 a, vec2 b) { return a; }\n"
                 "vec4 texture(sampler2D s, vec2 p) { return vec4(0); }\n"
                 "vec3 f(vec3 x) { return sinh(pow(x, x)); }")
            .functions;
    EXPECT_THAT(functions, Not(HasSubstr("double tidemark_sinh(double a0)")));
    EXPECT_THAT(functions, HasSubstr("dvec3 tidemark_sinh(dvec3 a0)"));
    EXPECT_THAT(functions, Not(HasSubstr("dvec2 tidemark_pow(")));
    EXPECT_THAT(functions, HasSubstr("dvec3 tidemark_pow("));
    EXPECT_THAT(functions, Not(HasSubstr("tidemark_texture(sampler2D a0,dvec2 a1) ")));
}

/// Each function follows those that it needs, and these exist.
TEST(Promote, the_table_of_functions_lists_dependencies_first) {
    std::set<std::string_view> known;
    for (const DoubleFunction& function : all_double_functions()) {
        for (const std::string_view need : function.needs)
            EXPECT_TRUE(known.contains(need)) << function.name << " needs " << need;
        EXPECT_TRUE(known.insert(function.name).second) << function.name;
        EXPECT_TRUE(function.text.starts_with('\n') && function.text.ends_with('\n')) << function.name;
    }
}

TEST(Promote, a_hash_that_changes_the_callers_variables_stays_a_double_function) {
    const Promoted result =
        promoted("float s;\nfloat f(inout float x) { x += 1.; return fract(sin(x) * 43758.5); }\n"
                 "float g() { s = fract(sin(s) * 43758.5); return s; }\n");
    EXPECT_EQ(result.body.text(), "double s;\ndouble f(inout double x) { x += 1.lf; return "
                                  "fract(sin(tidemark_single(x)) * 43758.5); }\n"
                                  "double g() { s = fract(sin(tidemark_single(s)) * 43758.5); return s; }\n");
}

TEST(Promote, the_large_number_of_a_hash_may_have_a_name) {
    for (const char* number : {"#define M 43758.54\n", "const float M = 43758.54;\n"})
        EXPECT_EQ(
            promoted(number + std::string("float f(float x) { return fract(sin(x) * M); }\n")).hashes.size(),
            1u);
    EXPECT_TRUE(promoted("#define M 2.\nfloat f(float x) { return fract(sin(x) * M); }\n").hashes.empty());
}

TEST(Promote, non_hashes_are_promoted) {
    for (const char* text :
         {"float f(float x) { return fract(sin(x) * 2.0); }\n",
          "float f(float x) { return fract(x * 1000.0); }\n",
          "vec2 f(vec2 x) { return fract(x) * fract(x.yx); }\n",
          "float fract(float x) { return x; }\nfloat f(float x) { return fract(sin(x) * 43758.5); }\n"})
        EXPECT_TRUE(promoted(text).hashes.empty()) << text;
}

} // namespace tidemark::glsl::promote_test
